//! The area function of an indenter.

use crate::Error;
use crate::statistics::zero;

/// The most coefficients: those of `h^2, h, h^(1/2), h^(1/4), .. h^(1/128)`.
pub const MOST_COEFFICIENTS: usize = 9;

/// A nanometre, m, in powers of which the coefficients of area functions are published.
const NANOMETRE: f64 = 1e-9;
/// The least size of a coefficient but the first: a smaller one adds less than 1e-4 nm^2 to the area at 1 nm, and is
/// probably one in powers of metres or micrometres.
const LEAST: f64 = 1e-4;

/// The contact area of an indenter as a function of the contact depth,
/// `A = C0 h^2 + C1 h + C2 h^(1/2) + C3 h^(1/4) + .. + C8 h^(1/128)` (Oliver and Pharr, J. Mater.
/// Res. 7, 1564, 1992).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AreaFunction {
    /// The coefficients, in powers of nanometres.
    coefficients: [f64; MOST_COEFFICIENTS],
}

impl AreaFunction {
    /// A perfect Berkovich pyramid, `A = 24.56 h^2`.
    pub const BERKOVICH: Self = Self {
        coefficients: [24.56, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    };

    /// Takes one to nine coefficients `C0, C1, ..` in powers of nanometres: with the depth in nm they
    /// give the area in nm^2.
    ///
    /// # Errors
    /// [`Error::Setting`] for another number of coefficients, for one that is not finite, for coefficients of
    /// which none is positive, and for one but the first that is so small that it is none in powers of nanometres.
    pub fn new(nanometres: &[f64]) -> Result<Self, Error> {
        let refused = |value, allowed| Error::setting("the area function", value, allowed);
        if !(1..=MOST_COEFFICIENTS).contains(&nanometres.len()) {
            return Err(refused(
                nanometres.len() as f64,
                "of 1 to 9 coefficients, those of h^2, h, h^(1/2) to h^(1/128)",
            ));
        }
        if let Some(&wrong) = nanometres.iter().find(|value| !value.is_finite()) {
            return Err(refused(wrong, "of finite coefficients"));
        }
        if !nanometres.iter().any(|&value| value > 0.0) {
            return Err(refused(
                nanometres[0],
                "of coefficients of which one at least is positive",
            ));
        }
        let is_small = |value: &&f64| **value != 0.0 && value.abs() < LEAST;
        if let Some(&small) = nanometres[1..].iter().find(is_small) {
            return Err(refused(
                small,
                "of coefficients in powers of nanometres, of which those but the first are 0 or at least 1e-4 in size: \
                 C1 = 2e-6 m is 2000",
            ));
        }
        let mut coefficients = [0.0; MOST_COEFFICIENTS];
        coefficients[..nanometres.len()].copy_from_slice(nanometres);
        Ok(Self { coefficients })
    }

    /// Returns the coefficients `C0, C1, ..` in powers of nanometres, without those of 0 at the end.
    pub fn coefficients(&self) -> &[f64] {
        let is_set = |value: &f64| *value != 0.0;
        let count = self.coefficients.iter().rposition(is_set).unwrap_or(0) + 1;
        &self.coefficients[..count]
    }

    /// Returns the contact radius `sqrt(A/pi)` (m) at a contact depth (m); NaN where there is no
    /// positive area.
    pub fn radius(&self, depth: f64) -> f64 {
        let nanometres = depth / NANOMETRE;
        if nanometres.is_nan() || nanometres <= 0.0 {
            return f64::NAN;
        }
        let [square, rest @ ..] = self.coefficients;
        let mut area = square * nanometres * nanometres;
        let mut power = nanometres;
        for coefficient in rest {
            area += coefficient * power;
            power = power.sqrt();
        }
        NANOMETRE * (area / std::f64::consts::PI).sqrt()
    }

    /// Returns the contact depth (m) at a contact radius (m); NaN where no depth up to
    /// 1 m has it.
    pub(super) fn depth(&self, radius: f64) -> f64 {
        /// The depths (m) among which the first one that is too deep is looked for, and the factor from one to
        /// the next: an area with negative coefficients ends at some depth.
        const DEPTHS: [f64; 2] = [1e-15, 1.0];
        const STEP: f64 = 1.1;
        let [least, most] = DEPTHS;
        let depths = (0..).map(|i| least * STEP.powi(i));
        let mut depths = depths.take_while(|depth| *depth <= most);
        // A depth without an area, of which the radius is NaN, is too small.
        let excess = |depth: f64| self.radius(depth).max(0.0) - radius;
        let Some(first) = depths.find(|depth| excess(*depth) >= 0.0) else {
            return f64::NAN;
        };
        let depth = zero(excess, first / STEP, first);
        let is_it = (self.radius(depth) / radius - 1.0).abs() < 1e-9;
        if is_it { depth } else { f64::NAN }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn areas_are_sums_of_powers_of_the_depth() {
        let area = |coefficients: &[f64], depth: f64| {
            let of = AreaFunction::new(coefficients).expect("allowed");
            std::f64::consts::PI * of.radius(depth * 1e-9).powi(2) * 1e18
        };
        for (coefficients, depth, expected) in [
            (&[24.56][..], 100.0, 24.56e4),
            (&[24.56, 300.0], 100.0, 24.56e4 + 3e4),
            (&[24.5, -10.0, 700.0], 64.0, 24.5 * 4096.0 - 640.0 + 5600.0),
            (&[0.0, 0.0, 0.0, 5.0], 16.0, 10.0),
            (&[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 3.0], 1.0, 3.0),
        ] {
            let found = area(coefficients, depth);
            assert!((found / expected - 1.0).abs() < 1e-13, "{found} {expected}");
        }
        let two_to_128 = 2_f64.powi(128);
        let last = area(&[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 3.0], two_to_128);
        assert!((last / 6.0 - 1.0).abs() < 1e-12, "{last}");
        assert!(AreaFunction::BERKOVICH.radius(-1e-9).is_nan());
        assert!(
            AreaFunction::new(&[1.0, -1e3])
                .expect("allowed")
                .radius(1e-9)
                .is_nan()
        );
    }

    #[test]
    fn other_coefficients_are_refused() {
        // The last but one is that of a sphere of 1 um in metres.
        let metres = [-3.1, 6.2e-6];
        for wrong in [&[][..], &[1.0; 10], &[f64::NAN], &[-1.0], &metres, &[0.0]] {
            let error = AreaFunction::new(wrong).expect_err("refused").to_string();
            assert!(error.contains("area function"), "{error}");
        }
    }

    /// The area of a sphere of 1 um has a largest depth, its radius; a depth of more has no area.
    #[test]
    fn depths_are_found_where_the_area_ends() {
        let pi = std::f64::consts::PI;
        let sphere = AreaFunction::new(&[-pi, 2e3 * pi]).expect("allowed");
        for depth in [1e-9, 1e-8, 3e-7, 8e-7] {
            let found = sphere.depth(sphere.radius(depth));
            assert!((found / depth - 1.0).abs() < 1e-9, "{found} {depth}");
        }
        assert!(sphere.depth(2e-6).is_nan());
    }
}
