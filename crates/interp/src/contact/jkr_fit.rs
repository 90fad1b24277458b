//! What a fit of JKR for a bare half-space would report of a coated one, and so whether the film
//! matters.

use crate::contact::mechanics::work_of_adhesion;
use crate::{Contact, Error, JkrPoint};

/// The straight line of least squares through a JKR plot, read by eq. 1:
/// `y = 4 E*/(3 sqrt 6) x - sqrt(4 w E*/3)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JkrFit {
    /// The modulus `E*` of the slope, Pa.
    pub modulus: f64,
    /// The ordinate at abscissa 0, N m^{-3/2}: negative with adhesion.
    pub intercept: f64,
}

impl JkrFit {
    /// Through measured or computed points.
    ///
    /// # Errors
    /// [`Error::Unphysical`] unless the points have two different abscissas at least, finite
    /// coordinates, and a slope above 0 whose line f64 holds.
    pub fn through(points: &[JkrPoint]) -> Result<Self, Error> {
        let count = points.len() as f64;
        let mean =
            |coordinate: fn(&JkrPoint) -> f64| points.iter().map(coordinate).sum::<f64>() / count;
        let (x, y) = (mean(|point| point.abscissa), mean(|point| point.ordinate));
        let moment = |other: &dyn Fn(&JkrPoint) -> f64| {
            points
                .iter()
                .map(|point| (point.abscissa - x) * other(point))
                .sum::<f64>()
        };
        let spread = moment(&|point| point.abscissa - x);
        Error::unless(
            spread > 0.0,
            "spread of the JKR plot's abscissas",
            spread,
            "> 0: two different ones at least, all finite",
        )?;
        let slope = moment(&|point| point.ordinate - y) / spread;
        let fit = Self {
            modulus: 0.75 * 6.0_f64.sqrt() * slope,
            intercept: y - slope * x,
        };
        let held = fit.modulus.is_finite() && fit.intercept.is_finite();
        Error::unless(
            slope > 0.0 && held,
            "slope of the JKR plot",
            slope,
            "> 0, and the line such that f64 holds it",
        )?;
        Ok(fit)
    }

    /// The work of adhesion (J/m^2) of the intercept with the fitted modulus. Negative if the
    /// intercept is positive, as of no JKR contact.
    pub fn work_of_adhesion(&self) -> f64 {
        self.work_of_adhesion_with(self.modulus)
    }

    /// The work of adhesion (J/m^2) of the intercept with a modulus (Pa) known from elsewhere.
    pub fn work_of_adhesion_with(&self, modulus: f64) -> f64 {
        -0.75 * self.intercept * self.intercept.abs() / modulus
    }
}

/// By how much JKR for the bare substrate errs on a coated one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilmBias {
    /// The fit to the JKR plot of the coated contact.
    pub fit: JkrFit,
    /// Its modulus relative to that of sphere and bare substrate, `E*/Einf* - 1`; -1 between rigid
    /// bodies.
    pub modulus: f64,
    /// Its work of adhesion, with the fitted modulus, relative to the true one, `w_fit/w - 1`.
    pub work_of_adhesion: f64,
    /// The same with `Einf*` in place of the fitted modulus, as where sphere and substrate are
    /// known; -1 between rigid bodies.
    pub work_of_adhesion_at_known_modulus: f64,
}

impl FilmBias {
    /// Whether the film matters: whether any of the three biases is larger than a relative
    /// tolerance, as of the measurement.
    pub fn exceeds(&self, tolerance: f64) -> bool {
        let biases = [
            self.modulus,
            self.work_of_adhesion,
            self.work_of_adhesion_at_known_modulus,
        ];
        !biases.into_iter().all(|bias| bias.abs() <= tolerance)
    }
}

impl Contact {
    /// The fit of JKR to this contact with work of adhesion `w` (J/m^2) at `points` contact radii,
    /// evenly spaced between two (m): the apparent modulus and work of adhesion of someone who does
    /// not know of the film.
    ///
    /// # Errors
    /// Those of [`Contact::load`] and [`JkrFit::through`]; [`Error::Unphysical`] unless `points` is
    /// 2 to 1,000,000.
    pub fn jkr_fit(&self, w: f64, [from, to]: [f64; 2], points: usize) -> Result<JkrFit, Error> {
        Error::unless(
            (2..=1_000_000).contains(&points),
            "number of points",
            points as f64,
            "2 to 1000000",
        )?;
        let radius = |i: usize| from + (to - from) * (i as f64 / (points - 1) as f64);
        let point = |a: f64| Ok(self.mechanics().jkr_point(a, self.load(a, w)?));
        let points = (0..points)
            .map(|i| point(radius(i)))
            .collect::<Result<Vec<_>, Error>>()?;
        JkrFit::through(&points)
    }

    /// Does the film matter? What [`Contact::jkr_fit`] reports, relative to the truth.
    ///
    /// # Errors
    /// Those of [`Contact::jkr_fit`], and [`Error::Unphysical`] for a `w` of 0 or next to it, to
    /// which nothing is relative.
    ///
    /// ```
    /// # #[cfg(feature = "embedded")]
    /// # fn main() -> Result<(), interp::Error> {
    /// # use interp::{Elastic, System, Table};
    /// # let (film, substrate) = (Elastic::new(3.5e6, 0.5)?, Elastic::new(2e11, 0.25)?);
    /// let bias = |film_thickness| {
    ///     let system = System { sphere_radius: 1e-3, sphere_modulus: 2e6, film, film_thickness, substrate };
    ///     Table::embedded().contact(&system)?.film_bias(0.04, [39.4e-6, 131.3e-6], 15)
    /// };
    /// assert!(!bias(1e-6)?.exceeds(0.03)); // a film of 1 um makes less than 3 %
    /// assert!(bias(1e-4)?.exceeds(0.2)); // one of 100 um more than 20 %
    /// # Ok(()) }
    /// # #[cfg(not(feature = "embedded"))]
    /// # fn main() {}
    /// ```
    pub fn film_bias(&self, w: f64, radii: [f64; 2], points: usize) -> Result<FilmBias, Error> {
        work_of_adhesion(w)?;
        Error::unless(
            w > 0.0,
            "work of adhesion",
            w,
            "> 0: a bias is relative to it",
        )?;
        let (fit, bare) = (
            self.jkr_fit(w, radii, points)?,
            self.mechanics().sphere_substrate_modulus(),
        );
        let work_of_adhesion = fit.work_of_adhesion() / w - 1.0;
        let work_of_adhesion_at_known_modulus = fit.work_of_adhesion_with(bare) / w - 1.0;
        let held = work_of_adhesion.is_finite() && work_of_adhesion_at_known_modulus.is_finite();
        Error::unless(
            held,
            "work of adhesion",
            w,
            "large enough for a bias relative to it that f64 holds",
        )?;
        Ok(FilmBias {
            fit,
            modulus: fit.modulus / bare - 1.0,
            work_of_adhesion,
            work_of_adhesion_at_known_modulus,
        })
    }
}
