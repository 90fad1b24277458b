//! The exchange format of a curve: a cubic spline of the crate `splines`.

use splines::{Interpolation, Key, Spline};

use crate::{Curve, Error, Parameter, Quantity};

impl Curve {
    /// Returns the curve of `quantity` as a cubic spline of the crate `splines`: the exchange
    /// format of a curve, for programs that do not use this crate.
    ///
    /// The spline is a function of `ln(a/t)` between the ends of [`Curve::range`]. It has `pieces`
    /// Bezier pieces of equal length (`pieces + 1` keys with handles) with the values and the
    /// slopes of the curve at their ends. Its error falls with the fourth power of `pieces`: on six
    /// decades, 600 pieces of an ordinary quantity have an error of some 1e-9 (measured by the unit
    /// test `the_cubic_spline_of_the_curve_converges_to_it_with_its_order`).
    ///
    /// # Errors
    /// As [`Curve::slope`]; [`Error::InvalidArgument`] unless `pieces` is 1 to 1,000,000.
    ///
    /// ```
    /// # #[cfg(feature = "embedded")]
    /// # fn main() -> Result<(), interp::Error> {
    /// use interp::{Material, Quantity, Table};
    ///
    /// let curve = Table::embedded().curve(&Material::new(1.75, 0.5, 1e5, 0.25)?)?;
    /// let spline = curve.spline(Quantity::Eeq, 600)?;
    /// assert_eq!(spline.len(), 601);
    ///
    /// // Sampled as in a program that depends on the crate `splines` only.
    /// let eeq = spline.sample(0.5_f64.ln()).expect("inside the range of the curve");
    /// assert!((eeq / curve.quantity(Quantity::Eeq, 0.5)? - 1.0).abs() < 1e-9);
    /// # Ok(()) }
    /// # #[cfg(not(feature = "embedded"))]
    /// # fn main() {}
    /// ```
    pub fn spline(&self, quantity: Quantity, pieces: usize) -> Result<Spline<f64, f64>, Error> {
        Error::argument(
            (1..=1_000_000).contains(&pieces),
            "the number of pieces",
            pieces as f64,
            "1 to 1000000",
        )?;
        let range = self.range();
        let [from, to] = range.map(|x| Parameter::AOverT.coordinate(x));
        let step = (to - from) / pieces as f64;
        let key = |i: usize| {
            let u = from + step * i as f64;
            let x = Parameter::AOverT.value(u).clamp(range[0], range[1]);
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
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curve::test_curve::{curve, even};

    /// Two independent ways to a value: the pieces of the curve are found by the bits of `a/t`,
    /// those of the crate `splines` by a search in the keys.
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
                Err(Error::InvalidArgument { .. })
            ));
        }
    }
}
