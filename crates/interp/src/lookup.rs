//! Interpolation: a table's spline coefficients, and the curve of one material.

use splines::{Interpolate, Interpolation, Key, Spline};

use crate::schema::Parameter;
use crate::spline::{Basis, DEGREE, Weights};
use crate::table::{REASONABLE, Table, locate, too_close};
use crate::{Error, Material, Quantities, Quantity};

/// One number for each of the four quantities.
#[derive(Clone, Copy, Debug, Default)]
struct Four([f64; 4]);

impl Four {
    fn each(value: impl Fn(usize) -> f64) -> Self {
        Self(std::array::from_fn(value))
    }

    /// `self + factor other`.
    fn plus(self, factor: f64, other: Self) -> Self {
        Self::each(|i| self.0[i] + factor * other.0[i])
    }
}

/// Component by component, so that one search in the spline serves all four.
impl Interpolate<f64> for Four {
    fn step(t: f64, threshold: f64, a: Self, b: Self) -> Self {
        Self::each(|i| f64::step(t, threshold, a.0[i], b.0[i]))
    }
    fn lerp(t: f64, a: Self, b: Self) -> Self {
        Self::each(|i| f64::lerp(t, a.0[i], b.0[i]))
    }
    fn cosine(t: f64, a: Self, b: Self) -> Self {
        Self::each(|i| f64::cosine(t, a.0[i], b.0[i]))
    }
    fn cubic_hermite(t: f64, x: (f64, Self), a: (f64, Self), b: (f64, Self), y: (f64, Self)) -> Self {
        Self::each(|i| f64::cubic_hermite(t, (x.0, x.1.0[i]), (a.0, a.1.0[i]), (b.0, b.1.0[i]), (y.0, y.1.0[i])))
    }
    fn quadratic_bezier(t: f64, a: Self, u: Self, b: Self) -> Self {
        Self::each(|i| f64::quadratic_bezier(t, a.0[i], u.0[i], b.0[i]))
    }
    fn cubic_bezier(t: f64, a: Self, u: Self, v: Self, b: Self) -> Self {
        let [p, q, r, s] = bernstein(t);
        Self::each(|i| p * a.0[i] + q * u.0[i] + r * v.0[i] + s * b.0[i])
    }
    fn cubic_bezier_mirrored(t: f64, a: Self, u: Self, v: Self, b: Self) -> Self {
        Self::each(|i| f64::cubic_bezier_mirrored(t, a.0[i], u.0[i], v.0[i], b.0[i]))
    }
}

/// The cubic Bernstein polynomials at `t`: the weights of the ends and handles of a Bezier piece.
fn bernstein(t: f64) -> [f64; 4] {
    let s = 1.0 - t;
    [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t]
}

/// The tensor B-spline of a table along its material axes.
///
/// What is splined is `ln(Pi0/es)`, `ln(Eeq/es)`, `ln(Gamma/es)` and `ln Delta0` over `ln(E1/E2)`, `c(nu1)` and `ln(E0/E2)`.
#[derive(Clone, Debug)]
pub(crate) struct Coefficients {
    /// The bases of `e1_over_e2`, `nu1` and `e0_over_e2`.
    bases: [Basis; 3],
    /// One row for each combination of material coefficients, `e1_over_e2` slowest; a row holds the four
    /// logarithms for each `a_over_t`.
    rows: Vec<f64>,
}

impl Coefficients {
    pub(crate) fn new(table: &Table) -> Self {
        let [n_a, n_e1, n_nu, n_e0] = table.shape();
        let materials = n_e1 * n_nu * n_e0;
        let nodes =
            |parameter: Parameter| -> Vec<f64> { table.axis(parameter).iter().map(|&value| parameter.coordinate(value)).collect() };
        let bases = [Parameter::E1OverE2, Parameter::Nu1, Parameter::E0OverE2].map(|p| Basis::new(&nodes(p), DEGREE));

        // Material-major, so that a curve sums whole rows.
        let mut rows = vec![0.0; 4 * n_a * materials];
        for quantity in Quantity::ALL {
            let Some(values) = table.values(quantity) else { continue };
            for (material, row) in rows.chunks_exact_mut(4 * n_a).enumerate() {
                let (e1, nu) = (material / (n_nu * n_e0), material / n_e0 % n_nu);
                let scale = scale(quantity, film_limit(table, e1, nu));
                for (a, group) in row.chunks_exact_mut(4).enumerate() {
                    group[quantity as usize] = (values[a * materials + material] / scale).ln();
                }
            }
        }
        let row = 4 * n_a;
        bases[0].interpolate(&mut rows, n_nu * n_e0 * row);
        for slab in rows.chunks_exact_mut(n_nu * n_e0 * row) {
            bases[1].interpolate(slab, n_e0 * row);
            slab.chunks_exact_mut(n_e0 * row).for_each(|slab| bases[2].interpolate(slab, row));
        }
        Self { bases, rows }
    }

    pub(crate) fn curve(&self, table: &Table, material: &Material) -> Result<Curve, Error> {
        let (table_unit, unit) = (table.description().normalisation, material.normalisation());
        if table_unit != unit {
            return Err(Error::Normalisation { table: table_unit.symbol(), query: unit.symbol() });
        }
        let table_nu0 = table.description().nu0;
        let place = || {
            let material = material.with_substrate_poisson_ratio(table_nu0)?;
            let e1 = table.locate(Parameter::E1OverE2, material.e1_over_e2())?;
            let nu = table.locate(Parameter::Nu1, material.nu1())?;
            let e0 = table.locate(Parameter::E0OverE2, material.e0_over_e2())?;
            Ok((material, self.bases[0].weights(e1), self.bases[1].weights(nu), self.bases[2].weights(e0)))
        };
        let (nu1, nu0) = (material.nu1(), material.nu0());
        let (material, e1, nu, e0) = place().map_err(|error| match error {
            error if nu0 == table_nu0 => error,
            error => Error::Equivalent { nu1, nu0, table_nu0, source: Box::new(error) },
        })?;
        let values = self.contract(table.shape(), &e1, &nu, &e0);
        let held = Quantity::ALL.map(|quantity| table.values(quantity).is_some());
        Ok(Curve::from_logarithms(table.axis(Parameter::AOverT), &values, material, held))
    }

    /// Sums the rows around one material: the logarithms at each node of `a_over_t`.
    fn contract(&self, [n_a, _, n_nu, n_e0]: [usize; 4], e1: &Weights, nu: &Weights, e0: &Weights) -> Vec<Four> {
        let mut sum = vec![Four::default(); n_a];
        for i in 0..e1.count {
            for j in 0..nu.count {
                for k in 0..e0.count {
                    let weight = e1.values[i] * nu.values[j] * e0.values[k];
                    let row = ((e1.first + i) * n_nu + nu.first + j) * n_e0 + e0.first + k;
                    let values = self.rows[4 * row * n_a..][..4 * n_a].chunks_exact(4);
                    for (sum, c) in sum.iter_mut().zip(values) {
                        *sum = sum.plus(weight, Four([c[0], c[1], c[2], c[3]]));
                    }
                }
            }
        }
        sum
    }
}

/// `es` at a node of `e1_over_e2` and one of `nu1`.
fn film_limit(table: &Table, e1: usize, nu: usize) -> f64 {
    let (e1, nu1) = (table.axis(Parameter::E1OverE2)[e1], table.axis(Parameter::Nu1)[nu]);
    let e0 = table.axis(Parameter::E0OverE2)[0];
    let material = Material::new(e1, nu1, e0, table.description().nu0).expect("a table's axes are checked when it is made");
    material.sphere_film_modulus()
}

/// What a quantity is divided by before its logarithm is taken.
fn scale(quantity: Quantity, es: f64) -> f64 {
    if quantity == Quantity::Delta0 { 1.0 } else { es }
}

/// The four quantities as functions of `a/t` for one material.
///
/// Made once, by [`Table::curve`] or [`Curve::through`]; each evaluation is then a one-dimensional cubic spline over `ln(a/t)`, so finely
/// resampled from the quintic spline through the logarithms at the nodes that it adds less than 1e-7 to the error.
#[derive(Clone, Debug)]
pub struct Curve {
    spline: Spline<f64, Four>,
    /// Keys per unit of `ln(a/t)` if they are uniform, so that the right one is found without a search.
    density: Option<f64>,
    /// The nodes of `a/t`, first and last.
    range: [f64; 2],
    material: Material,
    held: [bool; 4],
}

impl Curve {
    /// The curve through quantities from elsewhere than a table, `(a/t, quantities)` with `a/t` ascending.
    ///
    /// What is splined between these nodes is `ln(Pi0/es)`, `ln(Eeq/es)`, `ln(Gamma/es)` and `ln Delta0` over `ln(a/t)`, by the quintic
    /// not-a-knot spline, whose error falls like the sixth power of the nodes' distance. The cubic pieces that replace it are no
    /// longer than 0.025 in `ln(a/t)`, nor than the distance of the nodes: nodes closer than that bound their error, below 1e-7 otherwise, by
    /// their fourth power. Equally spaced nodes make the fastest curve.
    ///
    /// The quantities are not compared with the material; the crate `tabulate` makes a curve of stated accuracy from a material alone.
    ///
    /// # Errors
    /// [`Error::Unphysical`] if there is no node, an `a/t` or a quantity is not in `[1e-30, 1e30]`, or an `a/t` is not larger than the one before
    /// by 1e-7 of the nodes' range in `ln(a/t)`.
    ///
    /// ```
    /// # fn main() -> Result<(), interp::Error> {
    /// use interp::{Curve, Material};
    ///
    /// let material = Material::new(1.75, 0.5, 1e5, 0.25)?;
    /// let nodes = [1e-5, 2e-5, 4e-5].map(|a_over_t| (a_over_t, material.thick_film_limit()));
    /// let curve = Curve::through(&nodes, material)?;
    /// assert!((curve.quantities(3e-5)?.eeq - 0.7).abs() < 1e-15);
    /// # Ok(()) }
    /// ```
    pub fn through(nodes: &[(f64, Quantities)], material: Material) -> Result<Self, Error> {
        Error::unless(!nodes.is_empty(), "the number of nodes", 0.0, "at least 1")?;
        let reasonable = |name, value| Error::unless(REASONABLE.contains(&value), name, value, "in [1e-30, 1e30]");
        for (a_over_t, quantities) in nodes {
            reasonable(Parameter::AOverT.name(), *a_over_t)?;
            Quantity::ALL.into_iter().try_for_each(|quantity| reasonable(quantity.name(), quantities.get(quantity)))?;
        }
        let a_over_t: Vec<f64> = nodes.iter().map(|node| node.0).collect();
        if let Some([_, close]) = too_close(Parameter::AOverT, &a_over_t) {
            let allowed = "larger than the one before, by at least 1e-7 of the nodes' range in ln(a/t)";
            Error::unless(false, Parameter::AOverT.name(), close, allowed)?;
        }
        let es = material.sphere_film_modulus();
        let logarithm = |quantities: &Quantities| Four(Quantity::ALL.map(|q| (quantities.get(q) / scale(q, es)).ln()));
        let logarithms: Vec<Four> = nodes.iter().map(|node| logarithm(&node.1)).collect();
        Ok(Self::from_logarithms(&a_over_t, &logarithms, material, [true; 4]))
    }

    /// The curve through what is splined, the logarithms of the scaled quantities at the nodes of `a/t`.
    fn from_logarithms(nodes: &[f64], values: &[Four], material: Material, held: [bool; 4]) -> Self {
        let spline = Spline::from_vec(keys(nodes, values, material.sphere_film_modulus()));
        let density = uniform_density(spline.keys());
        Self { spline, density, range: [nodes[0], nodes[nodes.len() - 1]], material, held }
    }

    /// The material; if from a table, on a substrate with its Poisson ratio.
    pub fn material(&self) -> &Material {
        &self.material
    }

    /// The smallest and the largest `a/t`.
    pub fn range(&self) -> [f64; 2] {
        self.range
    }

    /// One quantity at `a_over_t`.
    ///
    /// # Errors
    /// [`Error::OutsideTable`] outside the curve's `a/t`, NaN included; [`Error::MissingQuantity`] if the table does not hold it.
    pub fn quantity(&self, quantity: Quantity, a_over_t: f64) -> Result<f64, Error> {
        self.require(quantity)?;
        let i = quantity as usize;
        Ok(match self.piece(a_over_t)? {
            Piece::Cubic { t, ends: [a, b], handles: [u, v] } => {
                let [p, q, r, s] = bernstein(t);
                p * a.0[i] + q * u.0[i] + r * v.0[i] + s * b.0[i]
            }
            Piece::Value(value) => value.0[i],
        })
    }

    /// All four quantities at `a_over_t`.
    ///
    /// # Errors
    /// As [`Curve::quantity`].
    pub fn quantities(&self, a_over_t: f64) -> Result<Quantities, Error> {
        Quantity::ALL.into_iter().try_for_each(|quantity| self.require(quantity))?;
        Ok(Quantities::from_array(self.values(a_over_t)?.0))
    }

    /// `Pi0` and `Eeq/Gamma`, all that the force of eq. 9 needs.
    pub(crate) fn load_factors(&self, a_over_t: f64) -> Result<(f64, f64), Error> {
        [Quantity::Pi0, Quantity::Eeq, Quantity::Gamma].into_iter().try_for_each(|quantity| self.require(quantity))?;
        let Four([pi0, eeq, gamma, _]) = self.values(a_over_t)?;
        Ok((pi0, eeq / gamma))
    }

    fn require(&self, quantity: Quantity) -> Result<(), Error> {
        if self.held[quantity as usize] { Ok(()) } else { Err(Error::MissingQuantity(quantity.name())) }
    }

    fn values(&self, a_over_t: f64) -> Result<Four, Error> {
        Ok(match self.piece(a_over_t)? {
            Piece::Cubic { t, ends: [a, b], handles: [u, v] } => Four::cubic_bezier(t, *a, *u, *v, *b),
            Piece::Value(value) => value,
        })
    }

    /// Finds the piece of the spline at `a_over_t`: by index on uniform keys, because the search would double the
    /// time (`benches/lookup.rs`).
    fn piece(&self, a_over_t: f64) -> Result<Piece<'_>, Error> {
        let u = locate(Parameter::AOverT, &self.range, a_over_t)?;
        let keys = self.spline.keys();
        if let Some(density) = self.density {
            let i = ((u - keys[0].t) * density) as usize;
            let i = i.min(keys.len() - 2);
            let [a, b] = [&keys[i], &keys[i + 1]];
            if let (Interpolation::StrokeBezier(_, after), Interpolation::StrokeBezier(before, _)) =
                (&a.interpolation, &b.interpolation)
            {
                let t = (u - a.t) * density;
                return Ok(Piece::Cubic { t, ends: [&a.value, &b.value], handles: [after, before] });
            }
        }
        let value = self.spline.clamped_sample(u);
        Ok(Piece::Value(value.expect("a table has at least one a_over_t, and u is in range and no NaN")))
    }
}

/// What a curve is at one `a/t`.
enum Piece<'a> {
    /// A cubic at `t` of the way between two keys.
    Cubic { t: f64, ends: [&'a Four; 2], handles: [&'a Four; 2] },
    /// The value found by the spline's own search.
    Value(Four),
}

/// The inverse of the keys' common distance, if there are several and they have one.
fn uniform_density(keys: &[Key<f64, Four>]) -> Option<f64> {
    let (first, last) = (keys.first()?.t, keys.last()?.t);
    let step = (last - first) / (keys.len() - 1) as f64;
    let expected = |i: usize| first + i as f64 * step;
    let even = keys.iter().enumerate().all(|(i, key)| (key.t - expected(i)).abs() <= 1e-9 * step);
    (keys.len() > 1 && even).then_some(1.0 / step)
}

/// The largest distance of two keys in `ln(a/t)`. A cubic piece this long follows the steepest quantity, a stiffness that grows like
/// `(a/t)^3`, to `3^4 h^4 / 384 = 8e-8`.
const KEY_DISTANCE: f64 = 0.025;

/// The quintic not-a-knot spline through the logarithms over `ln(a/t)`, as cubic Bezier pieces of the quantities themselves.
fn keys(nodes: &[f64], logarithms: &[Four], es: f64) -> Vec<Key<f64, Four>> {
    let u: Vec<f64> = nodes.iter().map(|&node| Parameter::AOverT.coordinate(node)).collect();
    let basis = Basis::new(&u, DEGREE);
    let mut coefficients: Vec<f64> = logarithms.iter().flat_map(|value| value.0).collect();
    basis.interpolate(&mut coefficients, 4);
    let sum = |first: usize, weights: &[f64]| {
        let coefficients = coefficients[4 * first..].chunks_exact(4);
        coefficients.zip(weights).fold(Four::default(), |sum, (c, &w)| sum.plus(w, Four([c[0], c[1], c[2], c[3]])))
    };
    let mut knots = Vec::new();
    for pair in u.windows(2) {
        let pieces = ((pair[1] - pair[0]) / KEY_DISTANCE).ceil();
        knots.extend((0..pieces as usize).map(|k| pair[0] + (pair[1] - pair[0]) * (k as f64 / pieces)));
    }
    knots.push(u[u.len() - 1]);
    let key = |i: usize| {
        let weights = basis.weights(knots[i]);
        let (values, slopes) = (&weights.values[..weights.count], &weights.slopes[..weights.count]);
        let (logarithm, logarithmic_slope) = (sum(weights.first, values), sum(weights.first, slopes));
        let value = Four(Quantity::ALL.map(|quantity| scale(quantity, es) * logarithm.0[quantity as usize].exp()));
        let slope = Four::each(|i| value.0[i] * logarithmic_slope.0[i]);
        // The Bezier handles of a cubic lie a third of the neighbouring intervals away.
        let before = if i > 0 { knots[i] - knots[i - 1] } else { 0.0 };
        let after = if i + 1 < knots.len() { knots[i + 1] - knots[i] } else { 0.0 };
        let handles = Interpolation::StrokeBezier(value.plus(-before / 3.0, slope), value.plus(after / 3.0, slope));
        Key::new(knots[i], value, handles)
    };
    (0..knots.len()).map(key).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curve(nodes: &[f64]) -> Curve {
        let value = |&x: &f64| Four([x.ln().sin(), (x / (1.0 + x)).ln(), 1.0 / (1.0 + x), 0.1 * x.ln()]);
        let values: Vec<Four> = nodes.iter().map(value).collect();
        let material = Material::new(1.75, 0.5, 1e5, 0.25).expect("physical");
        Curve::from_logarithms(nodes, &values, material, [true; 4])
    }

    /// The index on uniform keys finds the same piece as the search of `splines`, and the piece has the same value.
    #[test]
    fn index_and_search_agree_to_rounding() {
        let nodes: Vec<f64> = (0..=60).map(|i| 10_f64.powf(-3.0 + 0.1 * f64::from(i))).collect();
        let curve = curve(&nodes);
        assert!(curve.density.is_some());
        let at_keys = curve.spline.keys().iter().map(|key| key.t.exp().clamp(nodes[0], nodes[60]));
        let between = (0..10_000).map(|i| 10_f64.powf(-3.0 + 6.0 * (f64::from(i) * 0.618_034 % 1.0)));
        for x in at_keys.chain(between) {
            let found = curve.spline.clamped_sample(x.ln()).expect("in range");
            let indexed = curve.values(x).expect("in range");
            for quantity in Quantity::ALL {
                let (found, indexed) = (found.0[quantity as usize], indexed.0[quantity as usize]);
                assert!((indexed / found - 1.0).abs() < 1e-14, "{x}: {indexed} by index, {found} by search");
                assert_eq!(curve.quantity(quantity, x).expect("in range"), indexed);
            }
        }
    }

    #[test]
    fn uneven_nodes_are_searched_and_met() {
        let nodes = [0.1, 0.13, 0.3, 0.31, 0.7, 2.0, 2.5];
        let curve = curve(&nodes);
        assert!(curve.density.is_none());
        for x in nodes {
            let expected = curve.material.sphere_film_modulus() * x / (1.0 + x);
            assert!((curve.quantity(Quantity::Eeq, x).expect("in range") / expected - 1.0).abs() < 1e-13);
        }
    }
}
