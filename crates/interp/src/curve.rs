//! The curve of one material: the quantities as functions of `a/t`, as cubic pieces.

use splines::{Interpolate, Interpolation, Key, Spline};

use crate::schema::Parameter;
use crate::spline::{Basis, TABLE_DEGREE};
use crate::table::{REASONABLE, locate, too_close};
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

/// The four quantities as functions of `a/t` for one material.
///
/// Made once, by [`Table::curve`](crate::Table::curve) or [`Curve::through`]; each evaluation is then a one-dimensional cubic spline over
/// `ln(a/t)`, so finely resampled from the spline through the logarithms at the nodes that it adds less than a tenth of the table's tolerance
/// to the error.
#[derive(Clone, Debug)]
pub struct Curve {
    spline: Spline<f64, Four>,
    /// For equal buckets of `ln(a/t)`, the last key at or before each one's beginning: evenly spaced or not, keys are found without a search.
    buckets: Vec<u32>,
    /// Buckets per unit of `ln(a/t)`.
    density: f64,
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
    /// their fourth power.
    ///
    /// The quantities are not compared with the material; the crate `tabulate` makes a curve of stated accuracy from a material alone.
    ///
    /// # Errors
    /// [`Error::Unphysical`] if there is no node, an `a/t` or a quantity is not in `[1e-30, 1e30]`, or an `a/t` is not larger than the one before
    /// by 1e-7 of the nodes' range in `ln(a/t)`; or if the spline through the quantities, or the handle of a cubic, leaves that range between them.
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
        let logarithm = |quantities: &Quantities| Four(Quantity::ALL.map(|q| q.logarithm(quantities.get(q), es)));
        let logarithms: Vec<Four> = nodes.iter().map(|node| logarithm(&node.1)).collect();
        let curve = Self::from_logarithms(&a_over_t, &logarithms, Resampling::THROUGH, material, [true; 4]);
        match curve.unreasonable() {
            None => Ok(curve),
            Some((quantity, value, _)) => {
                Err(Error::Unphysical { name: quantity.name(), value, allowed: "in [1e-30, 1e30] between the nodes, too" })
            }
        }
    }

    /// The curve of a table that holds the given quantities, from the logarithms of the scaled ones at the nodes of `a/t`, node after node.
    ///
    /// # Errors
    /// [`Error::Malformed`] if a quantity leaves `[1e-30, 1e30]`, as those of a sound table do not.
    pub(crate) fn of_table(
        nodes: &[f64],
        logarithms: &[f64],
        held: &[Quantity],
        tolerance: f64,
        material: Material,
    ) -> Result<Self, Error> {
        let four = |group: &[f64]| {
            let mut four = Four::default();
            held.iter().zip(group).for_each(|(&quantity, &value)| four.0[quantity as usize] = value);
            four
        };
        let values: Vec<Four> = logarithms.chunks_exact(held.len()).map(four).collect();
        let held = Quantity::ALL.map(|quantity| held.contains(&quantity));
        let curve = Self::from_logarithms(nodes, &values, Resampling::table(tolerance), material, held);
        match curve.unreasonable() {
            None => Ok(curve),
            Some((quantity, value, x)) => {
                Err(Error::Malformed(format!("{} reaches {value:?} near a_over_t = {x:?}", quantity.name())))
            }
        }
    }

    /// A quantity held that is not in `[1e-30, 1e30]` somewhere, with a bound of it and the key next to it. A cubic stays between the least and the
    /// largest of its ends and handles, so that there is none unless one of them is out.
    fn unreasonable(&self) -> Option<(Quantity, f64, f64)> {
        let held = || Quantity::ALL.into_iter().filter(|&quantity| self.held[quantity as usize]);
        self.spline.keys().iter().find_map(|key| {
            let [before, after] = handles(key);
            held().find_map(|quantity| {
                let values = [before, &key.value, after].map(|four| four.0[quantity as usize]);
                let out = values.into_iter().find(|value| !REASONABLE.contains(value))?;
                Some((quantity, out, key.t.exp()))
            })
        })
    }

    /// The curve through what is splined, the logarithms of the scaled quantities at the nodes of `a/t`.
    fn from_logarithms(nodes: &[f64], values: &[Four], resampling: Resampling, material: Material, held: [bool; 4]) -> Self {
        let keys = resampling.keys(nodes, values, material.sphere_film_modulus());
        let (first, last) = (keys[0].t, keys[keys.len() - 1].t);
        // Several buckets for each key of average distance, so that hardly any holds two keys.
        let count = 3 * keys.len();
        let length = (last - first).max(f64::MIN_POSITIVE);
        let start = |bucket: usize| first + length * (bucket as f64 / count as f64);
        // The last key begins no piece, unless it is the only one.
        let before = |u: f64| keys.partition_point(|key| key.t <= u).clamp(1, (keys.len() - 1).max(1)) - 1;
        let buckets = (0..=count).map(|bucket| before(start(bucket)) as u32).collect();
        let density = count as f64 / length;
        Self { spline: Spline::from_vec(keys), buckets, density, range: [nodes[0], nodes[nodes.len() - 1]], material, held }
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
        let piece = self.piece(a_over_t)?;
        Ok(piece.sum(bernstein(piece.t), quantity as usize))
    }

    /// The logarithmic slope of one quantity, `x dQ/dx` at `x = a_over_t`: the derivative of what [`Curve::quantity`] returns. Its error is some ten
    /// times that of the quantity: the identities of a certificate, which take slopes, are broken by 5 to 30 times its largest error. On a curve of
    /// a single node it is 0.
    ///
    /// # Errors
    /// As [`Curve::quantity`].
    pub fn slope(&self, quantity: Quantity, a_over_t: f64) -> Result<f64, Error> {
        self.require(quantity)?;
        let piece = self.piece(a_over_t)?;
        let (s, t) = (1.0 - piece.t, piece.t);
        let weights = [-s * s, s * (s - 2.0 * t), t * (2.0 * s - t), t * t];
        Ok(3.0 * piece.inverse_length * piece.sum(weights, quantity as usize))
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
        let piece = self.piece(a_over_t)?;
        let weights = bernstein(piece.t);
        Ok(Four::each(|i| piece.sum(weights, i)))
    }

    /// Finds the piece of the spline at `a_over_t`: by the buckets, because the search of `splines` would double the time (`benches/lookup.rs`).
    fn piece(&self, a_over_t: f64) -> Result<Piece<'_>, Error> {
        let u = locate(Parameter::AOverT, &self.range, a_over_t)?;
        let keys = self.spline.keys();
        let bucket = ((u - keys[0].t) * self.density) as usize;
        let mut i = self.buckets[bucket.min(self.buckets.len() - 1)] as usize;
        while i + 2 < keys.len() && keys[i + 1].t <= u {
            i += 1;
        }
        let (a, b) = (&keys[i], &keys[(i + 1).min(keys.len() - 1)]);
        // A single key is a piece without length.
        let inverse_length = if b.t > a.t { 1.0 / (b.t - a.t) } else { 0.0 };
        let t = (u - a.t) * inverse_length;
        Ok(Piece { corners: [&a.value, handles(a)[1], handles(b)[0], &b.value], t, inverse_length })
    }
}

/// The Bezier handles before and after a key. Other kinds of keys, of which a curve has none, have theirs in themselves.
fn handles(key: &Key<f64, Four>) -> [&Four; 2] {
    match &key.interpolation {
        Interpolation::StrokeBezier(before, after) => [before, after],
        _ => [&key.value; 2],
    }
}

/// A cubic between two keys, and a place on it.
struct Piece<'a> {
    /// The ends and, between them, the handles.
    corners: [&'a Four; 4],
    /// How much of the way from the first end to the last.
    t: f64,
    /// Of the piece, in `ln(a/t)`.
    inverse_length: f64,
}

impl Piece<'_> {
    /// The weighted sum of the corners, for one quantity.
    fn sum(&self, weights: [f64; 4], quantity: usize) -> f64 {
        let [p, q, r, s] = weights;
        let [a, u, v, b] = self.corners;
        p * a.0[quantity] + q * u.0[quantity] + r * v.0[quantity] + s * b.0[quantity]
    }
}

/// How the cubic pieces of a curve follow from values at nodes.
#[derive(Clone, Copy, Debug)]
struct Resampling {
    /// The degree of the not-a-knot spline through the logarithms.
    degree: usize,
    /// The length of the pieces.
    pieces: Pieces,
}

/// How long the cubic pieces are.
#[derive(Clone, Copy, Debug)]
enum Pieces {
    /// In `ln(a/t)`, at most. A piece of length `h` follows the steepest quantity, a stiffness that grows like `(a/t)^3`, to `3^4 h^4 / 384`.
    Length(f64),
    /// As long as they follow the spline to this relative error.
    Error(f64),
}

impl Resampling {
    /// Of samples from elsewhere, which may be few. The pieces add 8e-8 to the error at most.
    const THROUGH: Self = Self { degree: 5, pieces: Pieces::Length(0.025) };

    /// Of a table: the pieces add a tenth of its tolerance, or 1e-11 where that is more.
    fn table(tolerance: f64) -> Self {
        Self { degree: TABLE_DEGREE, pieces: Pieces::Error((0.1 * tolerance).max(1e-11)) }
    }

    /// The spline through the logarithms over `ln(a/t)`, as cubic Bezier pieces of the quantities themselves. Every node is a key.
    fn keys(self, nodes: &[f64], logarithms: &[Four], es: f64) -> Vec<Key<f64, Four>> {
        let u: Vec<f64> = nodes.iter().map(|&node| Parameter::AOverT.coordinate(node)).collect();
        let basis = Basis::new(&u, self.degree);
        let mut coefficients: Vec<f64> = logarithms.iter().flat_map(|value| value.0).collect();
        basis.interpolate(&mut coefficients, 4);
        let sum = |first: usize, weights: &[f64]| {
            let coefficients = coefficients[4 * first..].chunks_exact(4);
            coefficients.zip(weights).fold(Four::default(), |sum, (c, &w)| sum.plus(w, Four([c[0], c[1], c[2], c[3]])))
        };
        let value_and_slope = |u: f64| {
            let weights = basis.weights(u);
            let (values, slopes) = (&weights.values[..weights.count], &weights.slopes[..weights.count]);
            let (logarithm, logarithmic_slope) = (sum(weights.first, values), sum(weights.first, slopes));
            let value = Four(Quantity::ALL.map(|quantity| quantity.scale(es) * logarithm.0[quantity as usize].exp()));
            (value, Four::each(|i| value.0[i] * logarithmic_slope.0[i]))
        };
        let mut knots = Vec::new();
        for (pair, pieces) in u.windows(2).zip(self.pieces.counts(&u, value_and_slope)) {
            knots.extend((0..pieces).map(|k| pair[0] + (pair[1] - pair[0]) * (k as f64 / pieces as f64)));
        }
        knots.push(u[u.len() - 1]);
        let key = |i: usize| {
            let (value, slope) = value_and_slope(knots[i]);
            // The Bezier handles of a cubic lie a third of the neighbouring intervals away.
            let before = if i > 0 { knots[i] - knots[i - 1] } else { 0.0 };
            let after = if i + 1 < knots.len() { knots[i + 1] - knots[i] } else { 0.0 };
            let handles = Interpolation::StrokeBezier(value.plus(-before / 3.0, slope), value.plus(after / 3.0, slope));
            Key::new(knots[i], value, handles)
        };
        (0..knots.len()).map(key).collect()
    }
}

impl Pieces {
    /// How many there are at most on a curve whose nodes are fewer; a sound table takes thousands.
    const MOST: usize = 1_000_000;

    /// The number of pieces between each node and the next.
    fn counts(self, nodes: &[f64], value_and_slope: impl Fn(f64) -> (Four, Four)) -> Vec<usize> {
        let error = match self {
            Self::Length(longest) => {
                return nodes.windows(2).map(|pair| ((pair[1] - pair[0]) / longest).ceil() as usize).collect();
            }
            Self::Error(error) => error,
        };
        let ends: Vec<(Four, Four)> = nodes.iter().map(|&node| value_and_slope(node)).collect();
        // By how much a single cubic misses the spline in its middle.
        let misses: Vec<f64> = (1..nodes.len())
            .map(|i| {
                let length = nodes[i] - nodes[i - 1];
                let middle = value_and_slope(nodes[i].midpoint(nodes[i - 1])).0;
                let [(a, slope_a), (b, slope_b)] = [ends[i - 1], ends[i]];
                let cubic = |q: usize| 0.5 * (a.0[q] + b.0[q]) + 0.125 * length * (slope_a.0[q] - slope_b.0[q]);
                (0..4).map(|q| (cubic(q) / middle.0[q] - 1.0).abs()).fold(0.0, f64::max)
            })
            .collect();
        // The miss of one middle may be small by chance; those of the neighbours are not, too.
        let largest = |i: usize| misses[i.saturating_sub(1)..misses.len().min(i + 2)].iter().copied().fold(0.0, f64::max);
        // The error falls with the fourth power of the length. Of a forged table NaN gives one piece, and noise on all nodes no more than fit in memory.
        let most = (Self::MOST / misses.len().max(1)).clamp(1, 1000);
        (0..misses.len()).map(|i| ((largest(i) / error).powf(0.25).ceil() as usize).clamp(1, most)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curve(nodes: &[f64]) -> Curve {
        let value = |&x: &f64| Four([x.ln().sin(), (x / (1.0 + x)).ln(), 1.0 / (1.0 + x), 0.1 * x.ln()]);
        let values: Vec<Four> = nodes.iter().map(value).collect();
        let material = Material::new(1.75, 0.5, 1e5, 0.25).expect("physical");
        Curve::from_logarithms(nodes, &values, Resampling::THROUGH, material, [true; 4])
    }

    fn even(n: i32) -> Vec<f64> {
        (0..=n).map(|i| 10_f64.powf(-3.0 + 6.0 / f64::from(n) * f64::from(i))).collect()
    }

    /// Nodes as a table has them, and nodes at all distances.
    fn uneven() -> [Vec<f64>; 2] {
        let crowded = (0..=60).map(|i| (-6.9 * (f64::from(i) * std::f64::consts::PI / 60.0).cos()).exp()).collect();
        [crowded, vec![1e-3, 0.1, 0.13, 0.130001, 0.3, 0.31, 0.7, 2.0, 2.5, 1e3]]
    }

    /// The buckets lead to the same piece as the search of `splines`, and the piece has the same value.
    #[test]
    fn buckets_and_search_agree_to_rounding() {
        for nodes in [even(60)].into_iter().chain(uneven()) {
            let curve = curve(&nodes);
            let [from, to] = curve.range;
            let at_keys = curve.spline.keys().iter().map(|key| key.t.exp().clamp(from, to));
            let between = (0..10_000).map(|i| 10_f64.powf(-3.0 + 6.0 * (f64::from(i) * 0.618_034 % 1.0)).clamp(from, to));
            for x in at_keys.chain(between) {
                let found = curve.spline.clamped_sample(x.ln()).expect("in range");
                let indexed = curve.values(x).expect("in range");
                for quantity in Quantity::ALL {
                    let (found, indexed) = (found.0[quantity as usize], indexed.0[quantity as usize]);
                    assert!((indexed / found - 1.0).abs() < 1e-13, "{x}: {indexed} by buckets, {found} by search");
                    assert_eq!(curve.quantity(quantity, x).expect("in range"), indexed);
                }
            }
        }
    }

    #[test]
    fn nodes_at_any_distance_are_met() {
        for nodes in [even(7)].into_iter().chain(uneven()) {
            let curve = curve(&nodes);
            for x in nodes {
                let expected = curve.material.sphere_film_modulus() * x / (1.0 + x);
                assert!((curve.quantity(Quantity::Eeq, x).expect("in range") / expected - 1.0).abs() < 1e-13);
            }
        }
    }

    /// As a forged table may have them, a thousand pieces or more between any two.
    #[test]
    fn noise_on_many_nodes_does_not_take_all_memory() {
        let nodes = even(5000);
        let noise = |i: usize| Four::each(|quantity| 20.0 * (1e3 * (i * (quantity + 3)) as f64).sin());
        let values: Vec<Four> = (0..nodes.len()).map(noise).collect();
        let material = Material::new(1.75, 0.5, 1e5, 0.25).expect("physical");
        let curve = Curve::from_logarithms(&nodes, &values, Resampling::table(1e-10), material, [true; 4]);
        let keys = curve.spline.keys().len();
        assert!((500_000..=Pieces::MOST + 1).contains(&keys), "{keys} keys");
        assert!(curve.quantity(Quantity::Eeq, 1.0).is_ok());
    }

    #[test]
    fn the_slope_is_the_derivative_of_the_curve() {
        let curve = curve(&even(60));
        let [from, to] = curve.range;
        for i in 0..=1000 {
            let x = (from * (to / from).powf(f64::from(i) / 1000.0)).clamp(from, to);
            let step = 1e-5;
            for quantity in Quantity::ALL {
                let at = |u: f64| curve.quantity(quantity, (x * u.exp()).clamp(from, to)).expect("in range");
                let expected = match (x > from, x < to) {
                    (true, true) => (at(step) - at(-step)) / (2.0 * step),
                    (false, _) => (4.0 * at(step) - 3.0 * at(0.0) - at(2.0 * step)) / (2.0 * step),
                    (_, false) => (3.0 * at(0.0) - 4.0 * at(-step) + at(-2.0 * step)) / (2.0 * step),
                };
                let slope = curve.slope(quantity, x).expect("in range");
                // A kink of the second derivative between two pieces may lie between the two values.
                assert!((slope - expected).abs() <= 1e-8 * at(0.0), "{x}: {slope}, not {expected}");
            }
        }
        let single = Curve::from_logarithms(&[2.0], &[Four::default()], Resampling::THROUGH, curve.material, [true; 4]);
        assert_eq!(single.slope(Quantity::Pi0, 2.0).expect("the node"), 0.0);
    }
}
