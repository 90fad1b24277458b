//! The curve of one material: the quantities as functions of `a/t`.

use std::sync::Arc;

use fearless_simd::{Level, dispatch};
use splines::{Interpolation, Key, Spline};

use crate::curve::asymptotics::{Edge, Expansion};
use crate::curve::bspline::Basis;
use crate::curve::nodes::{REASONABLE, too_close};
use crate::curve::piecewise::{
    Grid, Resampler, Values, all, derivatives, first_outside, one, one_fused,
};
use crate::curve::sensitivity::{QuantityGradient, Sensitivities};
use crate::material::ROUNDING;
use crate::{Error, Material, Parameter, Quantities, Quantity};

/// The four quantities as functions of `a/t` for one material.
///
/// Made once, by [`Table::curve`](crate::Table::curve) or [`Curve::through`]. Each evaluation is
/// then a polynomial of degree 9 in `a/t` on one of some forty pieces (one to four in an octave of
/// the embedded table, as many as it needs), which follow the spline through the logarithms at the
/// nodes so closely that they add less than a tenth of the table's tolerance to the error, or
/// 1e-11. Nothing is allocated; a clone shares the pieces.
///
/// A curve of a table goes beyond its `a/t` by the first terms of the expansions about the exact
/// limits, as far as these are as accurate as the table ([`Curve::error`] says how accurate that
/// is). Elsewhere there is an error.
#[derive(Clone, Debug)]
pub struct Curve {
    grid: Arc<Grid>,
    pieces: Arc<[Values]>,
    /// The nodes of `a/t`, first and last.
    range: [f64; 2],
    material: Material,
    held: [bool; 4],
    sensitivities: Option<Arc<Sensitivities>>,
    accuracy: Option<Accuracy>,
}

/// The accuracy of the table that a curve is of.
#[derive(Clone, Copy, Debug)]
struct Accuracy {
    /// The largest error that its certificate states.
    error: f64,
    /// The largest estimated error that an expansion beyond the nodes may have.
    tolerance: f64,
}

impl Curve {
    /// The curve through quantities from elsewhere than a table, `(a/t, quantities)` with `a/t`
    /// ascending.
    ///
    /// What is splined between these nodes is `ln(Pi0/es)`, `ln(Eeq/es)`, `ln(Gamma/es)` and
    /// `ln Delta0` over `ln(a/t)`, by the quintic not-a-knot spline, whose error falls like the
    /// sixth power of the nodes' distance. The pieces that replace it add 1e-13, unless the nodes
    /// are no smooth curve's.
    ///
    /// The quantities are not compared with the material; the crate `tabulate` makes a curve of
    /// stated accuracy from a material alone. Beyond the nodes, and with respect to the material,
    /// such a curve knows nothing.
    ///
    /// # Errors
    /// [`Error::Unphysical`] if there is no node, an `a/t` or a quantity is not in `[1e-30, 1e30]`,
    /// or an `a/t` is not larger than the one before by 1e-7 of the nodes' range in `ln(a/t)` and
    /// by 1e-9 of itself; or if the spline leaves that range between the nodes, or is too steep to
    /// tell.
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
        const DEGREE: usize = 5;
        const ERROR: f64 = 1e-13;
        Error::unless(!nodes.is_empty(), "the number of nodes", 0.0, "at least 1")?;
        let reasonable = |name, value| {
            Error::unless(REASONABLE.contains(&value), name, value, "in [1e-30, 1e30]")
        };
        for (a_over_t, quantities) in nodes {
            reasonable(Parameter::AOverT.name(), *a_over_t)?;
            Quantity::ALL
                .into_iter()
                .try_for_each(|quantity| reasonable(quantity.name(), quantities.get(quantity)))?;
        }
        let a_over_t: Vec<f64> = nodes.iter().map(|node| node.0).collect();
        if let Some([_, close]) = too_close(Parameter::AOverT, &a_over_t) {
            let allowed = "larger than the one before, by at least 1e-7 of the nodes' range in ln(a/t) and 1e-9";
            Error::unless(false, Parameter::AOverT.name(), close, allowed)?;
        }
        let es = material.sphere_film_modulus();
        let logarithms =
            |quantities: &Quantities| Quantity::ALL.map(|q| q.logarithm(quantities.get(q), es));
        let mut coefficients: Vec<f64> =
            nodes.iter().flat_map(|node| logarithms(&node.1)).collect();
        let places: Vec<f64> = a_over_t
            .iter()
            .map(|&x| Parameter::AOverT.coordinate(x))
            .collect();
        let basis = Basis::new(&places, DEGREE);
        basis.interpolate(&mut coefficients, 4);
        let range = [a_over_t[0], a_over_t[a_over_t.len() - 1]];
        let resampler =
            Resampler::fitting(&basis, range, &Quantity::ALL, 1, |_| &coefficients, ERROR);
        let curve = Self::of_splines(&resampler, range, &coefficients, &Quantity::ALL, material);
        match curve.unreasonable() {
            None => Ok(curve),
            Some((quantity, value)) => Err(Error::Unphysical {
                name: quantity.name(),
                value,
                allowed: "in [1e-30, 1e30] between the nodes, too",
            }),
        }
    }

    /// The curve of the splines over `ln(a/t)` with these coefficients, of the quantities held.
    pub(crate) fn of_splines(
        resampler: &Resampler,
        range: [f64; 2],
        coefficients: &[f64],
        quantities: &[Quantity],
        material: Material,
    ) -> Self {
        let pieces = resampler.values(coefficients, quantities, material.sphere_film_modulus());
        let held = Quantity::ALL.map(|quantity| quantities.contains(&quantity));
        Self {
            grid: resampler.grid.clone(),
            pieces,
            range,
            material,
            held,
            sensitivities: None,
            accuracy: None,
        }
    }

    /// A quantity held that may leave `[1e-30, 1e30]`, with its value in the middle of such a
    /// piece.
    pub(crate) fn unreasonable(&self) -> Option<(Quantity, f64)> {
        let outside = first_outside(&REASONABLE, &self.pieces, self.held);
        outside.map(|(piece, quantity)| (quantity, piece[0][quantity as usize]))
    }

    /// With what is known of the derivatives with respect to the material.
    pub(crate) fn with_sensitivities(self, sensitivities: Sensitivities) -> Self {
        Self {
            sensitivities: Some(Arc::new(sensitivities)),
            ..self
        }
    }

    /// With the expansions beyond the nodes of a table, whose error at the nodes and tolerance are
    /// given.
    pub(crate) fn with_expansions(self, error: f64, tolerance: f64) -> Self {
        Self {
            accuracy: Some(Accuracy { error, tolerance }),
            ..self
        }
    }

    /// The material; if from a table, on a substrate with its Poisson ratio.
    pub fn material(&self) -> &Material {
        &self.material
    }

    /// The smallest and the largest `a/t` of the nodes.
    pub fn range(&self) -> [f64; 2] {
        self.range
    }

    /// One quantity at `a_over_t`.
    ///
    /// # Errors
    /// [`Error::OutsideTable`] outside the curve's `a/t`, NaN included, and
    /// [`Error::Extrapolation`] where the expansion about the limit is not accurate enough;
    /// [`Error::MissingQuantity`] if the table does not hold it.
    #[inline]
    pub fn quantity(&self, quantity: Quantity, a_over_t: f64) -> Result<f64, Error> {
        self.require(quantity)?;
        match self.inside(a_over_t) {
            Some(x) => {
                let place = self.grid.place(x);
                Ok(one(&self.pieces[place.piece], place, quantity as usize))
            }
            None => Ok(self.expanded(a_over_t)?.values.get(quantity)),
        }
    }

    /// One quantity at many `a_over_t`, in the order given: as [`Curve::quantity`] but for
    /// rounding, in two thirds of the time.
    ///
    /// # Errors
    /// As [`Curve::quantity`] at the first point that has one, with the values before it written;
    /// [`Error::Unphysical`] if there is not one value for each `a/t`.
    pub fn quantity_at_all(
        &self,
        quantity: Quantity,
        a_over_t: &[f64],
        values: &mut [f64],
    ) -> Result<(), Error> {
        self.require(quantity)?;
        same_length(a_over_t, values)?;
        let (grid, pieces, [from, to]) = (&*self.grid, &*self.pieces, self.range);
        dispatch!(Level::new(), simd => {
            for (value, &x) in values.iter_mut().zip(a_over_t) {
                *value = if x >= from && x <= to {
                    let place = grid.place(x);
                    one_fused(simd, &pieces[place.piece], place, quantity as usize)
                } else {
                    self.quantity(quantity, x)?
                };
            }
            Ok(())
        })
    }

    /// The logarithmic slope of one quantity, `x dQ/dx` at `x = a_over_t`: the derivative of what
    /// [`Curve::quantity`] returns. Its error is some ten times that of the quantity: the
    /// identities of a certificate, which take slopes, are broken by 5 to 30 times its largest
    /// error. On a curve of a single node it is 0.
    ///
    /// # Errors
    /// As [`Curve::quantity`].
    pub fn slope(&self, quantity: Quantity, a_over_t: f64) -> Result<f64, Error> {
        self.require(quantity)?;
        Ok(self.values_and_slopes(a_over_t)?.1.get(quantity))
    }

    /// All four quantities at `a_over_t`.
    ///
    /// # Errors
    /// As [`Curve::quantity`].
    #[inline]
    pub fn quantities(&self, a_over_t: f64) -> Result<Quantities, Error> {
        self.require_all()?;
        match self.inside(a_over_t) {
            Some(x) => {
                let place = self.grid.place(x);
                Ok(Quantities::from_array(all(
                    &self.pieces[place.piece],
                    place,
                )))
            }
            None => Ok(self.expanded(a_over_t)?.values),
        }
    }

    /// All four quantities at `a_over_t`, and their [slopes](Curve::slope).
    ///
    /// # Errors
    /// As [`Curve::quantity`].
    pub fn quantities_and_slopes(&self, a_over_t: f64) -> Result<(Quantities, Quantities), Error> {
        self.require_all()?;
        self.values_and_slopes(a_over_t)
    }

    /// All four quantities at `a_over_t` and their derivatives with respect to it and to the four
    /// parameters of the material.
    ///
    /// They are the derivatives of the table's splines, to the pieces' error. Those of the embedded
    /// table are within 100 times its tolerance of the true ones, relative to the quantity and per
    /// unit of `ln(a/t)`, `ln e1_over_e2` and `ln e0_over_e2`, and of the Poisson ratios in units
    /// of what changes the contact, `(1 - 2 nu1) + 1/(1 + (a/t)^2)` for the film and
    /// `1/(1 + E1/E0)` for the substrate: stiff films have an equivalent on a narrow range only.
    /// Measured: 3, 6 and 4, 75 and 45. The largest is that of nearly incompressible films at the
    /// soft end, `e1_over_e2` of 1e-3, where the derivative with respect to `nu1` divides errors by
    /// the cube of the distance between nodes: a table that was made otherwise may be off by
    /// hundreds of tolerances there. Below the nodes they are those of the expansion for thick
    /// films.
    ///
    /// # Errors
    /// As [`Curve::quantity`], but always [`Error::OutsideTable`] above the nodes;
    /// [`Error::NoGradient`] on a curve that was made without one.
    pub fn gradient(&self, a_over_t: f64) -> Result<QuantityGradient, Error> {
        self.require_all()?;
        let sensitivities = self.sensitivities.as_ref().ok_or(Error::NoGradient)?;
        let at = |x: f64| {
            let (values, slopes) = self.values_and_slopes(x)?;
            Ok(sensitivities.gradient(self.grid.place(x), values, slopes))
        };
        match self.inside(a_over_t) {
            Some(x) => at(x),
            None if a_over_t < self.range[0] => {
                let Expansion { values, slopes, .. } = self.expanded(a_over_t)?;
                Ok(at(self.range[0])?.continued_to_thicker_films(
                    a_over_t / self.range[0],
                    values,
                    slopes,
                ))
            }
            None => Err(self.outside(a_over_t)),
        }
    }

    /// An estimate of the largest relative error of the quantities at `a_over_t`: what the table's
    /// certificate says between its nodes; beyond them, that of the expansion about the limit.
    ///
    /// # Errors
    /// As [`Curve::quantity`]; [`Error::OutsideTable`] everywhere on a curve that is not of a
    /// table, because its error is not known.
    pub fn error(&self, a_over_t: f64) -> Result<f64, Error> {
        let accuracy = self
            .accuracy
            .as_ref()
            .ok_or_else(|| self.outside(a_over_t))?;
        if self.inside(a_over_t).is_some() {
            return Ok(accuracy.error);
        }
        Ok(self.expanded(a_over_t)?.error)
    }

    /// The curve of one quantity as a cubic spline of the crate `splines`, for programs that work
    /// with these: Bezier pieces over `ln(a/t)`, so many between the ends, with the curve's own
    /// values and slopes there. Their error falls with the fourth power of their number: on six
    /// decades 600 of an ordinary quantity have some 1e-9.
    ///
    /// # Errors
    /// As [`Curve::quantity`]; [`Error::Unphysical`] for no piece, or for more than a million.
    pub fn spline(&self, quantity: Quantity, pieces: usize) -> Result<Spline<f64, f64>, Error> {
        Error::unless(
            (1..=1_000_000).contains(&pieces),
            "the number of pieces",
            pieces as f64,
            "from 1 to 1000000",
        )?;
        let [from, to] = self.range.map(|x| Parameter::AOverT.coordinate(x));
        let step = (to - from) / pieces as f64;
        let key = |i: usize| {
            let u = from + step * i as f64;
            let x = Parameter::AOverT
                .value(u)
                .clamp(self.range[0], self.range[1]);
            let (value, slope) = (self.quantity(quantity, x)?, self.slope(quantity, x)?);
            // The handles of a Bezier cubic are a third of its length away.
            let handles =
                Interpolation::StrokeBezier(value - step / 3.0 * slope, value + step / 3.0 * slope);
            Ok(Key::new(u, value, handles))
        };
        Ok(Spline::from_vec(
            (0..=pieces).map(key).collect::<Result<_, Error>>()?,
        ))
    }

    /// `Pi0` and `Eeq/Gamma`, all that the force of eq. 9 needs.
    #[inline]
    pub(crate) fn load_factors(&self, a_over_t: f64) -> Result<(f64, f64), Error> {
        [Quantity::Pi0, Quantity::Eeq, Quantity::Gamma]
            .into_iter()
            .try_for_each(|quantity| self.require(quantity))?;
        let [pi0, eeq, gamma, _] = match self.inside(a_over_t) {
            Some(x) => {
                let place = self.grid.place(x);
                all(&self.pieces[place.piece], place)
            }
            None => self.expanded(a_over_t)?.values.to_array(),
        };
        Ok((pi0, eeq / gamma))
    }

    #[inline]
    fn require(&self, quantity: Quantity) -> Result<(), Error> {
        if self.held[quantity as usize] {
            Ok(())
        } else {
            Err(Error::MissingQuantity(quantity.name()))
        }
    }

    #[inline]
    fn require_all(&self) -> Result<(), Error> {
        Quantity::ALL
            .into_iter()
            .try_for_each(|quantity| self.require(quantity))
    }

    /// `a_over_t` if it is on the pieces, but for the rounding of a ratio.
    #[inline]
    fn inside(&self, a_over_t: f64) -> Option<f64> {
        let [from, to] = self.range;
        if a_over_t >= from && a_over_t <= to {
            return Some(a_over_t);
        }
        let near = |end: f64| (a_over_t - end).abs() <= ROUNDING * end;
        if near(from) {
            Some(from)
        } else if near(to) {
            Some(to)
        } else {
            None
        }
    }

    fn values_and_slopes(&self, a_over_t: f64) -> Result<(Quantities, Quantities), Error> {
        let Some(x) = self.inside(a_over_t) else {
            let Expansion { values, slopes, .. } = self.expanded(a_over_t)?;
            return Ok((values, slopes));
        };
        let place = self.grid.place(x);
        let piece = &self.pieces[place.piece];
        let speed = self.grid.logarithmic_speed(x);
        let slopes = derivatives(piece, place).map(|derivative| speed * derivative);
        Ok((
            Quantities::from_array(all(piece, place)),
            Quantities::from_array(slopes),
        ))
    }

    /// Whether the expansion below the nodes is accurate enough. It is the less so the nearer it is
    /// to them.
    pub(crate) fn goes_on_to_zero(&self) -> bool {
        self.expanded(self.range[0] * (1.0 - 2.0 * ROUNDING))
            .is_ok()
    }

    /// The expansion beyond the nodes, if it is accurate enough.
    #[cold]
    fn expanded(&self, x: f64) -> Result<Expansion, Error> {
        let [from, to] = self.range;
        let (Some(Accuracy { error, tolerance }), true) =
            (self.accuracy, x > 0.0 && x < f64::INFINITY)
        else {
            return Err(self.outside(x));
        };
        let edge = |a_over_t: f64| -> Result<Edge, Error> {
            Ok(Edge {
                a_over_t,
                quantities: self.values_and_slopes(a_over_t)?.0,
                held: self.held,
                error,
            })
        };
        let expansion = if x < from {
            edge(from)?.thick(&self.material, x)
        } else {
            edge(to)?.thin(&self.material, x)
        };
        let expansion = expansion.ok_or_else(|| self.outside(x))?;
        // Not `>`, which is false of NaN.
        if expansion.error <= tolerance {
            return Ok(expansion);
        }
        let (edge, estimate) = (if x < from { from } else { to }, expansion.error);
        Err(Error::Extrapolation {
            value: x,
            edge,
            estimate,
            tolerance,
        })
    }

    pub(crate) fn outside(&self, value: f64) -> Error {
        let [from, to] = self.range;
        Error::OutsideTable {
            axis: Parameter::AOverT.name(),
            value,
            from,
            to,
        }
    }
}

/// Accepts as many outputs as inputs.
pub(crate) fn same_length(inputs: &[f64], outputs: &[f64]) -> Result<(), Error> {
    Error::unless(
        inputs.len() == outputs.len(),
        "the number of values to write",
        outputs.len() as f64,
        "the number of points given",
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Functions that are no quantities', but have bends, zeros and slopes.
    fn exact(x: f64) -> Quantities {
        Quantities {
            pi0: 0.3 + x.ln().sin().exp(),
            eeq: x / (1.0 + x),
            gamma: (1.0 / (1.0 + x)).exp(),
            delta0: x.powf(0.1),
        }
    }

    fn curve(nodes: &[f64]) -> Curve {
        let material = Material::new(1.75, 0.5, 1e5, 0.25).expect("physical");
        let nodes: Vec<(f64, Quantities)> = nodes.iter().map(|&x| (x, exact(x))).collect();
        Curve::through(&nodes, material).expect("sound nodes")
    }

    fn even(n: i32) -> Vec<f64> {
        (0..=n)
            .map(|i| 10_f64.powf(-3.0 + 6.0 / f64::from(n) * f64::from(i)))
            .collect()
    }

    /// Nodes as a table has them, and nodes at all distances.
    fn uneven() -> [Vec<f64>; 2] {
        let crowded = (0..=60)
            .map(|i| (-6.9 * (f64::from(i) * std::f64::consts::PI / 60.0).cos()).exp())
            .collect();
        [
            crowded,
            vec![1e-3, 0.1, 0.13, 0.130001, 0.3, 0.31, 0.7, 2.0, 2.5, 1e3],
        ]
    }

    #[test]
    fn nodes_at_any_distance_are_met() {
        let close = vec![1.0, 1.0 + 1e-8, 1.0 + 2e-8, 1.0 + 1e-7];
        for nodes in [even(7), close, vec![2.5]].into_iter().chain(uneven()) {
            let curve = curve(&nodes);
            for &x in &nodes {
                for quantity in Quantity::ALL {
                    let (value, expected) = (
                        curve.quantity(quantity, x).expect("in range"),
                        exact(x).get(quantity),
                    );
                    // Between nodes far apart and others close by, a spline has bends that no piece
                    // follows to the last digit.
                    assert!(
                        (value / expected - 1.0).abs() < 1e-10,
                        "{quantity:?} at {x} of {nodes:?}: {value}, not {expected}"
                    );
                }
            }
        }
    }

    #[test]
    fn a_spline_through_enough_nodes_is_the_function() {
        let curve = curve(&even(600));
        for i in 0..10_000 {
            let x = 10_f64
                .powf(-3.0 + 6.0 * (f64::from(i) * 0.618_034 % 1.0))
                .clamp(1e-3, 1e3);
            for quantity in Quantity::ALL {
                let miss =
                    curve.quantity(quantity, x).expect("in range") / exact(x).get(quantity) - 1.0;
                assert!(miss.abs() < 1e-10, "{quantity:?} at {x}: {miss:.1e}");
            }
            assert_eq!(
                curve.quantities(x).expect("in range").to_array(),
                Quantity::ALL.map(|q| curve.quantity(q, x).expect("in range"))
            );
        }
    }

    /// The pieces are found by the bits of `a/t`, and the spline of the crate `splines` by a search
    /// in its keys.
    #[test]
    fn the_cubic_spline_of_the_curve_converges_to_it_with_its_order() {
        let curve = curve(&even(600));
        let miss = |pieces: usize| {
            let spline = curve.spline(Quantity::Eeq, pieces).expect("in range");
            let at = |i: i32| 10_f64.powf(-2.99 + 5.98 * (f64::from(i) * 0.618_034 % 1.0));
            let miss = |x: f64| {
                let value = spline.clamped_sample(x.ln()).expect("there are keys");
                (value / curve.quantity(Quantity::Eeq, x).expect("in range") - 1.0).abs()
            };
            (0..1000).map(at).map(miss).fold(0.0, f64::max)
        };
        let (coarse, fine) = (miss(600), miss(1200));
        println!("{coarse:.1e} with 600 pieces, {fine:.1e} with 1200");
        // Measured: 7.1e-10 and 4.5e-11.
        assert!(
            coarse < 2e-9 && (coarse / fine).log2() > 3.9,
            "{coarse:.1e}, {fine:.1e}"
        );
        for pieces in [0, 1_000_001] {
            assert!(matches!(
                curve.spline(Quantity::Eeq, pieces),
                Err(Error::Unphysical { .. })
            ));
        }
    }

    /// The spline through it does not stay in any range, and polynomials do not follow it.
    #[test]
    fn noise_on_many_nodes_is_an_error() {
        let nodes = even(5000);
        let noise = |i: usize, q: usize| (20.0 * (1e3 * (i * (q + 3)) as f64).sin()).exp();
        let noise = |i: usize| Quantities::from_array(std::array::from_fn(|q| noise(i, q)));
        let nodes: Vec<(f64, Quantities)> = nodes
            .iter()
            .enumerate()
            .map(|(i, &x)| (x, noise(i)))
            .collect();
        let curve = Curve::through(
            &nodes,
            Material::new(1.75, 0.5, 1e5, 0.25).expect("physical"),
        );
        assert!(matches!(curve, Err(Error::Unphysical { .. })), "{curve:?}");
    }

    #[test]
    fn the_slope_is_the_derivative_of_the_curve() {
        let curve = curve(&even(600));
        let [from, to] = curve.range;
        for i in 0..=1000 {
            let x = (from * (to / from).powf(f64::from(i) / 1000.0)).clamp(from, to);
            let step = 1e-5;
            for quantity in Quantity::ALL {
                let at = |u: f64| {
                    curve
                        .quantity(quantity, (x * u.exp()).clamp(from, to))
                        .expect("in range")
                };
                let expected = match (x > from, x < to) {
                    (true, true) => (at(step) - at(-step)) / (2.0 * step),
                    (false, _) => (4.0 * at(step) - 3.0 * at(0.0) - at(2.0 * step)) / (2.0 * step),
                    (_, false) => {
                        (3.0 * at(0.0) - 4.0 * at(-step) + at(-2.0 * step)) / (2.0 * step)
                    }
                };
                let slope = curve.slope(quantity, x).expect("in range");
                assert!(
                    (slope - expected).abs() <= 1e-8 * at(0.0),
                    "{x}: {slope}, not {expected}"
                );
            }
        }
        let single = Curve::through(&[(2.0, exact(2.0))], curve.material).expect("a node");
        assert_eq!(single.slope(Quantity::Pi0, 2.0).expect("the node"), 0.0);
    }

    #[test]
    fn many_values_are_those_of_one_after_the_other() {
        let curve = curve(&even(60));
        let points: Vec<f64> = (0..1000)
            .map(|i| 10_f64.powf(-3.0 + 6.0 * (f64::from(i) * 0.618_034 % 1.0)))
            .collect();
        let mut values = vec![0.0; points.len()];
        curve
            .quantity_at_all(Quantity::Gamma, &points, &mut values)
            .expect("in range");
        for (&x, value) in points.iter().zip(&values) {
            assert_eq!(
                *value,
                curve.quantity(Quantity::Gamma, x).expect("in range")
            );
        }
        assert!(matches!(
            curve.quantity_at_all(Quantity::Gamma, &points, &mut values[1..]),
            Err(Error::Unphysical { .. })
        ));
        assert!(matches!(
            curve.quantity_at_all(Quantity::Gamma, &[1.0, 2e3], &mut [0.0; 2]),
            Err(Error::OutsideTable { .. })
        ));
    }

    #[test]
    fn it_is_shared_between_threads_and_by_clones() {
        fn shared<T: Send + Sync + Clone>(_: &T) {}
        let curve = curve(&even(60));
        shared(&curve);
        assert!(Arc::ptr_eq(&curve.pieces, &curve.clone().pieces));
    }
}
