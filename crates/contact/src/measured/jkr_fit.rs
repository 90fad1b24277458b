//! The fit of JKR for a bare half-space to a coated contact, and the error that the film causes in
//! its results.

use std::f64::consts::PI;

use crate::Contact;
use crate::Error;
use interp::check::{number_of_points, work_of_adhesion};

/// A point of the reduced "JKR plot" of eq. 9, a straight line for a homogeneous system.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JkrPoint {
    /// `a^{3/2} / (sqrt(pi) R)`, m^{1/2}.
    pub abscissa: f64,
    /// `F / (sqrt(6 pi) a^{3/2})`, N m^{-3/2}.
    pub ordinate: f64,
}

impl JkrPoint {
    /// Makes the point of a measured contact radius `a` (m) and `load` (N) under a sphere of radius
    /// `sphere_radius` (m).
    ///
    /// Nothing is checked. Unless `a` and `sphere_radius` are positive, the coordinates are not
    /// finite, and [`JkrFit::through`] refuses them.
    pub fn new(a: f64, load: f64, sphere_radius: f64) -> Self {
        let power = a * a.sqrt();
        Self {
            abscissa: power / (PI.sqrt() * sphere_radius),
            ordinate: load / ((6.0 * PI).sqrt() * power),
        }
    }
}

/// The works of adhesion that an error can be relative to.
const RELATIVE_TO_W: &str =
    "> 0, and so large that an error relative to it is finite: `Contact::jkr_fit` takes any";

/// The straight line of least squares through a JKR plot, interpreted by eq. 1:
/// `y = 4 E*/(3 sqrt 6) x - sqrt(4 w E*/3)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JkrFit {
    /// The modulus `E*` that follows from the slope, Pa.
    pub modulus: f64,
    /// The ordinate at abscissa 0, N m^{-3/2}. It is negative with adhesion.
    pub intercept: f64,
}

impl JkrFit {
    /// Fits measured or computed points.
    ///
    /// # Errors
    /// [`interp::Error::InvalidArgument`] unless at least two of the `points` differ in their abscissa and
    /// all abscissas are finite; [`interp::Error::Unphysical`] unless the slope is positive, and slope and
    /// intercept are finite.
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
        interp::Error::argument(
            spread > 0.0,
            "spread of the JKR plot's abscissas",
            spread,
            "> 0: give points at two different contact radii at least, all finite",
        )?;
        let slope = moment(&|point| point.ordinate - y) / spread;
        let fit = Self {
            modulus: 0.75 * 6.0_f64.sqrt() * slope,
            intercept: y - slope * x,
        };
        let finite = fit.modulus.is_finite() && fit.intercept.is_finite();
        interp::Error::unless(
            slope > 0.0 && finite,
            "slope of the JKR plot",
            slope,
            "> 0, with a finite modulus and intercept: check the units and signs of the loads",
        )?;
        Ok(fit)
    }

    /// Returns the work of adhesion (J/m^2) that follows from the intercept and the fitted modulus.
    ///
    /// It is negative if the intercept is positive, as in no contact that JKR describes.
    pub fn work_of_adhesion(&self) -> f64 {
        self.work_of_adhesion_with(self.modulus)
    }

    /// Returns the work of adhesion (J/m^2) that follows from the intercept and a known `modulus`
    /// (Pa).
    pub fn work_of_adhesion_with(&self, modulus: f64) -> f64 {
        -0.75 * self.intercept * self.intercept.abs() / modulus
    }
}

/// The relative errors of a JKR fit that ignores the film of a coated substrate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilmBias {
    /// The fit to the JKR plot of the coated contact.
    pub fit: JkrFit,
    /// The error of its modulus, relative to that of sphere and bare substrate: `E*/Einf* - 1`.
    pub modulus: f64,
    /// The error of its work of adhesion, relative to the true one: `w_fit/w - 1`.
    pub work_of_adhesion: f64,
    /// The error of the work of adhesion that follows from the intercept with `Einf*` in place of
    /// the fitted modulus, for an experiment in which sphere and substrate are known.
    pub work_of_adhesion_at_known_modulus: f64,
}

impl FilmBias {
    /// Tells whether the film matters: whether any of the three biases is larger than a relative
    /// `tolerance`, such as that of the measurement.
    ///
    /// It is true for a `tolerance` of NaN.
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
    /// Fits JKR to this contact with work of adhesion `w` (J/m^2), at a number of `points` contact
    /// radii that are evenly spaced between two (m).
    ///
    /// The result holds the apparent modulus and work of adhesion: those that are found if the film
    /// is ignored.
    ///
    /// # Errors
    /// As [`Contact::load`] and [`JkrFit::through`]; [`interp::Error::InvalidArgument`] unless `points` is
    /// 2 to 1,000,000; [`interp::Error::OtherProbe`] for a probe without a radius of curvature.
    pub fn jkr_fit(&self, w: f64, [from, to]: [f64; 2], points: usize) -> Result<JkrFit, Error> {
        number_of_points(points)?;
        self.with_radius_of_curvature("a JKR plot")?;
        let sphere_radius = self.mechanics().sphere_radius();
        let radius = |i: usize| from + (to - from) * (i as f64 / (points - 1) as f64);
        let point = |a: f64| Ok(JkrPoint::new(a, self.load(a, w)?, sphere_radius));
        let points = (0..points)
            .map(|i| point(radius(i)))
            .collect::<Result<Vec<_>, Error>>()?;
        JkrFit::through(&points)
    }

    /// Computes the errors of a JKR fit that ignores the film: those of [`Contact::jkr_fit`] with
    /// work of adhesion `w` (J/m^2), at `points` contact radii between two (m).
    ///
    /// The errors are relative to `w` and to the compound modulus `Einf*` of a compliant sphere and
    /// the bare substrate. A rigid sphere on a film is refused: film and substrate alone deform,
    /// and no modulus of the sphere is left for the fitted modulus to be compared with. Use
    /// [`Contact::jkr_fit`] there, which gives the fitted values themselves.
    ///
    /// # Errors
    /// As [`Contact::jkr_fit`]; [`interp::Error::InvalidArgument`] for a rigid sphere on a film, and for a
    /// `w` of 0, or a `w` or a modulus so small that an error relative to it overflows an f64.
    ///
    /// ```
    /// # fn main() -> Result<(), contact::Error> {
    /// # use contact::Contact;
    /// # use interp::{Elastic, Probe, System, Table};
    /// # let (film, substrate) = (Elastic::new(3.5e6, 0.5)?, Elastic::new(2e11, 0.25)?);
    /// let bias = |film_thickness| {
    ///     let system = System { probe: Probe::Paraboloid { radius: 1e-3 }, sphere_modulus: 2e6, film, film_thickness, substrate };
    ///     Contact::in_table(Table::embedded(), &system)?.film_bias(0.04, [39.4e-6, 131.3e-6], 15)
    /// };
    /// assert!(!bias(1e-6)?.exceeds(0.03)); // a film of 1 um makes less than 3 %
    /// assert!(bias(1e-4)?.exceeds(0.2)); // one of 100 um more than 20 %
    /// # Ok(()) }
    /// ```
    pub fn film_bias(&self, w: f64, radii: [f64; 2], points: usize) -> Result<FilmBias, Error> {
        work_of_adhesion(w)?;
        self.compliant_sphere()?;
        let relative = |holds| interp::Error::argument(holds, "work of adhesion", w, RELATIVE_TO_W);
        relative(w > 0.0)?;
        let fit = self.jkr_fit(w, radii, points)?;
        let bare = self.mechanics().sphere_substrate_modulus();
        let modulus = fit.modulus / bare - 1.0;
        let allowed = "so large that the ratio of moduli is finite";
        interp::Error::argument(
            modulus.is_finite(),
            "modulus of sphere and substrate",
            bare,
            allowed,
        )?;
        let work_of_adhesion = fit.work_of_adhesion() / w - 1.0;
        let work_of_adhesion_at_known_modulus = fit.work_of_adhesion_with(bare) / w - 1.0;
        relative(work_of_adhesion.is_finite() && work_of_adhesion_at_known_modulus.is_finite())?;
        Ok(FilmBias {
            fit,
            modulus,
            work_of_adhesion,
            work_of_adhesion_at_known_modulus,
        })
    }

    /// Accepts a probe with a radius of curvature, which JKR needs. `question` is what is asked for.
    pub(crate) fn with_radius_of_curvature(&self, question: &'static str) -> Result<f64, Error> {
        let radius = self.mechanics().sphere_radius();
        if radius.is_finite() {
            return Ok(radius);
        }
        Err(interp::Error::OtherProbe {
            question,
            probe: self.mechanics().probe(),
            reason: "it needs the radius of curvature at the tip; use a paraboloid, a sphere or a \
                     rounded cone",
        }
        .into())
    }

    /// Accepts a contact unless its sphere is rigid and it has a film.
    fn compliant_sphere(&self) -> Result<(), Error> {
        let Some(system) = self.system() else {
            return Ok(());
        };
        Ok(interp::Error::argument(
            system.sphere_modulus.is_finite(),
            "sphere_modulus",
            system.sphere_modulus,
            "finite for a film bias, which is relative to a compliant sphere on the bare substrate: \
             under a rigid sphere use `Contact::jkr_fit`, which gives the fitted modulus itself",
        )?)
    }
}
