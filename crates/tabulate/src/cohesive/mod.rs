//! An attraction of finite range: a constant traction `sigma0` wherever the gap is below `h0`, in an
//! annulus around the contact.
//!
//! JKR lets the attraction act at a distance of 0. Here the work of adhesion is `w = sigma0 h0`
//! (Dugdale's law; Maugis, J. Colloid Interface Sci. 150, 243, 1992, solved the half-space). The
//! contact has the radius `a`, the traction acts in `a < r < c`, the gap is `h0` at `r = c`, and no
//! stress is singular. Everything else is as in the solver: the same kernel, any film and any stack of
//! layers. Long ranges give DMT's `-2 pi w R` as the pull-off load on every film, short ones JKR.
//!
//! `fixed_radius` solves one contact radius with any annulus (`annulus`), linear in the curvature of
//! the sphere and in the traction; here the outer radius is found at which the gap is `h0`. `checks`
//! refuses what would not be a contact, `before_contact` is the attraction across a gap, `search`
//! finds the pull-off.
//!
//! ```
//! # fn main() -> Result<(), tabulate::Error> {
//! use interp::{Control, Elastic, Probe, System};
//! use tabulate::cohesive::Cohesive;
//!
//! let system = System {
//!     probe: Probe::Paraboloid { radius: 1e-5 },
//!     sphere_modulus: 7.5e10,
//!     film: Elastic::new(1e6, 0.5)?,
//!     film_thickness: 1e-6,
//!     substrate: Elastic::new(2e11, 0.25)?,
//! };
//! // 0.05 J/m^2, acting over 10 nm.
//! let cohesive = Cohesive::new(&system, 0.05, 10e-9)?;
//! let pull_off = cohesive.pull_off(Control::Load)?;
//! println!("{:.3e} N at a = {:.3e} m", pull_off.load, pull_off.contact_radius);
//! # Ok(()) }
//! ```
//!
//! # Accuracy
//!
//! Measured (`tests/truth/cohesive.rs`): load, penetration and outer radius of 24 contacts and 17
//! pull-offs within 4.4e-14 of values by two other programs, Maugis' closed form on a half-space
//! within 1.2e-14, and the energy balance `dU/d(delta) = F` within 2e-10.

mod annulus;
mod before_contact;
mod checks;
mod fixed_radius;
mod search;
mod surface;
mod waves;

use std::f64::consts::PI;

use interp::{Control, Normalisation, Probe, System, root};

use crate::Error;
use crate::cohesive::annulus::Annulus;
use crate::cohesive::checks::Solution;
use crate::cohesive::fixed_radius::{FixedRadius, Part};
use crate::cohesive::search::Point;
use crate::cohesive::surface::Surface;
use crate::solve::compliance::Compliance;
use crate::solve::layered::LayeredCompliance;
use crate::solve::symbol::Symbol;
use crate::stack::Stack;

pub use interp::CohesiveState;

/// The radii, over the thickness of the top layer, of contacts and of annuli that are solved.
pub const REACH: f64 = 120.0;

/// The step of `ln a` in the search of the pull-off.
const STEP: f64 = 0.25;

/// The smallest radius of a contact, over the thickness of the top layer, that is solved.
pub const SMALLEST: f64 = 1e-12;

/// A sphere on a coated substrate with an attraction of finite range.
#[derive(Clone, Debug)]
pub struct Cohesive {
    symbol: Symbol<Surface>,
    sphere_radius: f64,
    /// The thickness of the top layer, m: the unit of length.
    thickness: f64,
    /// The modulus that normalises, Pa: the unit of moduli.
    modulus: f64,
    /// `1/R`.
    curvature: f64,
    /// `tau = 2 sigma0`.
    traction: f64,
    /// `h0`.
    range: f64,
}

impl Cohesive {
    /// Takes a film on a substrate, the work of adhesion `w` (J/m^2) and the range `h0` (m) of the
    /// attraction, whose traction is `sigma0 = w/h0`. The probe is a paraboloid.
    ///
    /// # Errors
    /// As [`System::material`]; [`Error::Domain`] unless `w` and `h0` are positive, and for a range
    /// that is not below the radius of the sphere; [`Error::OnlyParaboloid`] for another probe.
    pub fn new(system: &System, work_of_adhesion: f64, range: f64) -> Result<Self, Error> {
        let surface = Surface::Film(Compliance::new(&system.material()?));
        Self::of_surface(surface, system, work_of_adhesion, range)
    }

    /// Takes a stack of layers under a sphere of the radius `sphere_radius` (m) and the reduced
    /// modulus `sphere_modulus` (Pa; infinity is rigid).
    ///
    /// # Errors
    /// As [`Cohesive::new`].
    pub fn on_stack(
        stack: &Stack,
        sphere_radius: f64,
        sphere_modulus: f64,
        work_of_adhesion: f64,
        range: f64,
    ) -> Result<Self, Error> {
        let merged = stack.merged().of_top_layer();
        let system = System {
            film_thickness: merged.top().thickness,
            ..merged.system(sphere_radius, sphere_modulus)
        };
        let surface = match merged.layers() {
            [_] => Surface::Film(Compliance::new(&system.material()?)),
            _ => Surface::Layers(LayeredCompliance::new(&merged)),
        };
        Self::of_surface(surface, &system, work_of_adhesion, range)
    }

    /// Takes the surface of a system whose film is the top layer.
    fn of_surface(
        surface: Surface,
        system: &System,
        work_of_adhesion: f64,
        range: f64,
    ) -> Result<Self, Error> {
        let material = system.material()?;
        let modulus = match material.normalisation() {
            Normalisation::Sphere => system.sphere_modulus,
            Normalisation::Film => system.film.reduced(),
        };
        let Probe::Paraboloid {
            radius: sphere_radius,
        } = system.probe
        else {
            return Err(Error::OnlyParaboloid {
                probe: system.probe.name(),
            });
        };
        let thickness = system.film_thickness;
        let positive = [f64::MIN_POSITIVE, f64::MAX];
        Error::check("work of adhesion", work_of_adhesion, positive)?;
        Error::check(
            "interaction range",
            range,
            [f64::MIN_POSITIVE, sphere_radius],
        )?;
        Ok(Self {
            symbol: Symbol::with_compliance(surface, &material),
            sphere_radius,
            thickness,
            modulus,
            curvature: thickness / sphere_radius,
            traction: 2.0 * (work_of_adhesion / range) / modulus,
            range: range / thickness,
        })
    }

    /// Returns the state at the contact radius `a`, m.
    ///
    /// Of several outer radii at which the gap is `h0`, it is the smallest.
    ///
    /// # Errors
    /// [`Error::Domain`] for a radius below [`SMALLEST`] or beyond [`REACH`];
    /// [`Error::AnnulusReach`] for one whose annulus is beyond it;
    /// [`Error::NotAContact`] where the contact would open inside, or the gap in the annulus is not
    /// between 0 and `h0`.
    pub fn state(&self, contact_radius: f64) -> Result<CohesiveState, Error> {
        let mut contact = self.fixed(contact_radius)?;
        let solution = self.solution(&mut contact, contact_radius, None)?;
        self.check(&solution)?;
        Ok(self.in_si(&solution.annulus, &solution.part))
    }

    /// Returns the pressure (Pa, positive in compression) at the radii `r` (m) inside the contact of
    /// radius `a`, m. It falls to `-sigma0` at `r = a`.
    ///
    /// # Errors
    /// As [`Cohesive::state`], and [`Error::Domain`] for a radius outside the contact.
    pub fn pressure(&self, contact_radius: f64, radii: &[f64]) -> Result<Vec<f64>, Error> {
        for &r in radii {
            Error::check("radius", r, [0.0, contact_radius])?;
        }
        let mut contact = self.fixed(contact_radius)?;
        let solution = self.solution(&mut contact, contact_radius, None)?;
        let stress = 0.5 * self.traction * self.modulus;
        let pressure = |r: &f64| stress * solution.pressure(r / self.thickness);
        Ok(radii.iter().map(pressure).collect())
    }

    /// Returns the gap (m) at the radii `r` (m) outside the contact of radius `a`, m.
    ///
    /// # Errors
    /// As [`Cohesive::state`], and [`Error::Domain`] for a radius inside the contact or beyond twice
    /// the outer radius of the attraction.
    pub fn gap(&self, contact_radius: f64, radii: &[f64]) -> Result<Vec<f64>, Error> {
        let mut contact = self.fixed(contact_radius)?;
        let solution = self.solution(&mut contact, contact_radius, None)?;
        let farthest = 2.0 * solution.annulus.outer * self.thickness;
        for &r in radii {
            Error::check("radius", r, [contact_radius, farthest])?;
        }
        let scaled: Vec<f64> = radii.iter().map(|r| r / self.thickness).collect();
        let gaps = solution.gaps(&scaled);
        Ok(gaps.into_iter().map(|gap| gap * self.thickness).collect())
    }

    /// Returns the state before the contact in which the attraction acts within the radius `c`, m.
    ///
    /// # Errors
    /// [`Error::Domain`] for a radius that is not positive, beyond the one at which the contact
    /// begins, or beyond [`REACH`]; [`Error::NotAContact`] for a result that overflows an f64.
    pub fn without_contact(&self, outer_radius: f64) -> Result<CohesiveState, Error> {
        let last = self.first_contact()?.unwrap_or_else(|| self.reach());
        Error::check(
            "outer radius",
            outer_radius,
            [f64::MIN_POSITIVE, last * self.thickness],
        )?;
        let (state, _) = self.before_contact(outer_radius / self.thickness);
        if state.load.is_finite() && state.penetration.is_finite() {
            return Ok(state);
        }
        let what = "its load or penetration overflows an f64: check the units";
        Err(self.no_contact(outer_radius / self.thickness, what))
    }

    /// Returns the states at `count` radii, evenly spaced in their logarithm between the ends of
    /// `contact_radii`.
    ///
    /// # Errors
    /// As [`Cohesive::state`], and [`Error::Domain`] for fewer than two radii.
    pub fn branch(
        &self,
        contact_radii: [f64; 2],
        count: usize,
    ) -> Result<Vec<CohesiveState>, Error> {
        Error::check("number of radii", count as f64, [2.0, 1e6])?;
        let [from, to] = contact_radii;
        let radius = |i: usize| match i {
            0 => from,
            _ if i == count - 1 => to,
            _ => from * (to / from).powf(i as f64 / (count - 1) as f64),
        };
        (0..count).map(|i| self.state(radius(i))).collect()
    }

    /// Returns the last stable state of a separation: the lowest imposed value of the branch that
    /// comes from large contacts.
    ///
    /// Under an imposed displacement or a soft spring it may be a state before the contact, of radius
    /// 0: a long range holds the surface up after the contact has closed.
    ///
    /// # Errors
    /// As [`Cohesive::state`], and [`Error::Domain`] for a pull-off beyond [`REACH`] or a spring that
    /// is not positive.
    pub fn pull_off(&self, control: Control) -> Result<CohesiveState, Error> {
        /// The smallest contact radius over that of JKR.
        const SMALLEST: f64 = 1e-3;
        if let Control::Spring { stiffness } = control {
            Error::check("stiffness of the spring", stiffness, [1e-100, 1e100])?;
        }
        let imposed = |state: &CohesiveState| control.imposed(state.load, state.penetration);
        // The contact radius of JKR without load on a half-space like the surface, in its units.
        let es = self.symbol.modulus();
        let scale =
            (4.5 * PI * 0.5 * self.traction * self.range / (es * self.curvature.powi(2))).cbrt();
        let largest = (0.9 * REACH).min(8.0 * scale);
        // The width of the last annulus, near which the next one is sought.
        let mut width = None;
        let mut value = |log: f64| {
            let radius = log.exp();
            let mut contact = FixedRadius::new(radius, &self.symbol)
                .ok_or_else(|| self.no_contact(radius, "rounding has left no digits"))?;
            let solution = self.solution(&mut contact, radius * self.thickness, width)?;
            width = Some(solution.annulus.outer - solution.annulus.inner);
            Ok(imposed(&self.in_si(&solution.annulus, &solution.part)))
        };
        let end = (SMALLEST * scale).ln();
        let start = self.start(&mut value, (0.8 * scale).ln(), largest.ln())?;
        if let Some(bracket) = search::bracket(&mut value, start, end)? {
            let (log, _) = search::minimum(&mut value, bracket)?;
            return self.state(log.exp() * self.thickness);
        }
        // The imposed value falls until the contact has closed.
        let first = self.first_contact()?.ok_or_else(|| Error::AnnulusReach {
            contact_radius: 0.0,
            reach: self.reach() * self.thickness,
        })?;
        let mut value = |log: f64| Ok(imposed(&self.before_contact(log.exp()).0));
        let start = [first.ln(), first.ln() - STEP];
        let start = [(start[0], value(start[0])?), (start[1], value(start[1])?)];
        match search::bracket(&mut value, start, (1e-3 * first).ln())? {
            Some(bracket) => {
                let (log, _) = search::minimum(&mut value, bracket)?;
                Ok(self.before_contact(log.exp()).0)
            }
            None => Ok(self.before_contact(first).0),
        }
    }

    /// Returns two values of `ln a`, the larger one first, between which the imposed value falls,
    /// looking from `from` up to `largest`.
    fn start(
        &self,
        value: &mut impl FnMut(f64) -> Result<f64, Error>,
        from: f64,
        largest: f64,
    ) -> Result<[Point; 2], Error> {
        let log = from.min(largest - STEP);
        let mut here = (log, value(log)?);
        while here.0 < largest {
            let next = (here.0 + STEP, value(here.0 + STEP)?);
            if next.1 > here.1 {
                return Ok([next, here]);
            }
            here = next;
        }
        Err(self.no_contact(
            here.0.exp(),
            "the pull-off is at a larger contact than is solved",
        ))
    }

    /// Prepares a contact radius, m.
    fn fixed(&self, contact_radius: f64) -> Result<FixedRadius<'_>, Error> {
        let reach = (REACH * self.thickness).min(self.sphere_radius);
        let reach = if self.symbol.contrast() == 0.0 {
            self.sphere_radius
        } else {
            reach
        };
        let smallest = SMALLEST * self.thickness;
        Error::check("contact radius", contact_radius, [smallest, reach])?;
        let radius = contact_radius / self.thickness;
        FixedRadius::new(radius, &self.symbol)
            .ok_or_else(|| self.no_contact(radius, "rounding has left no digits"))
    }

    /// Solves a contact radius, m, with an annulus near a `width` if one is given.
    fn solution<'a>(
        &self,
        contact: &'a mut FixedRadius<'_>,
        contact_radius: f64,
        width: Option<f64>,
    ) -> Result<Solution<'a>, Error> {
        let annulus = self.annulus(contact, contact_radius, width)?;
        let (parts, q) = contact.parts(&annulus);
        Ok(Solution {
            annulus,
            curvature: self.curvature,
            traction: self.traction,
            modulus: self.symbol.modulus(),
            part: Part::sum(&parts, [self.curvature, self.traction]),
            q,
        })
    }

    /// Finds the smallest annulus at whose outer radius the gap is `h0`.
    fn annulus(
        &self,
        contact: &mut FixedRadius<'_>,
        contact_radius: f64,
        width: Option<f64>,
    ) -> Result<Annulus, Error> {
        /// The largest growth of `tan(phi)^2` from one trial to the next.
        const GROWTH: f64 = 2.5;
        /// The first growth near a known width.
        const NEAR: f64 = 1.2;
        let radius = contact_radius / self.thickness;
        let reach = self.reach();
        // The square of tan(phi), with which the gap grows almost linearly: for a known width, or
        // for a short range, (pi/4) es w/sigma0^2 beside a long crack, and a long one, in which the
        // bodies keep their shapes. Either alone would open the gap, and the inverse squares add.
        let square = |width: f64| width * (width + 2.0 * radius) / (radius * radius);
        let farthest = ((reach / radius).powi(2) - 1.0).max(0.0);
        let (first, mut growth) = if let Some(width) = width {
            (square(width) / NEAR.sqrt(), NEAR)
        } else {
            let short = square(0.5 * PI * self.symbol.modulus() * self.range / self.traction);
            let long = 2.0 * self.range / (self.curvature * radius * radius);
            (short * long / (short + long) / GROWTH, GROWTH)
        };
        let mut low = first.min(farthest);
        let weights = [self.curvature, self.traction];
        let mut excess = |square: f64| {
            let (parts, _) = contact.parts(&Annulus::new(radius, square.sqrt()));
            weights[0] * parts[0].opening + weights[1] * parts[1].opening - self.range
        };
        let mut value = excess(low);
        let mut high = None;
        while value > 0.0 && low >= f64::MIN_POSITIVE {
            high = Some((low, value));
            low /= growth;
            growth = GROWTH;
            value = excess(low);
        }
        if low < f64::MIN_POSITIVE {
            let what = "its annulus is so narrow that rounding has left no digits";
            return Err(self.no_contact(radius, what));
        }
        let high = loop {
            if let Some(high) = high {
                break high;
            }
            if low >= farthest {
                return Err(Error::AnnulusReach {
                    contact_radius,
                    reach: reach * self.thickness,
                });
            }
            let next = (growth * low).min(farthest);
            growth = GROWTH;
            let there = excess(next);
            if there < 0.0 {
                (low, value) = (next, there);
            } else {
                high = Some((next, there));
            }
        };
        let square = search::crossing(excess, (low, value), high);
        Ok(Annulus::new(radius, square.sqrt()))
    }

    /// Refuses a solution that is not a contact.
    fn check(&self, solution: &Solution<'_>) -> Result<(), Error> {
        /// The accuracy of the pressures and gaps that are compared.
        const ACCURACY: f64 = 1e-6;
        let Annulus { inner, outer, .. } = solution.annulus;
        let (least, _) = solution.least_pressure();
        if least < -1.0 - ACCURACY {
            let what = "the attraction inside would be larger than its largest stress: the contact would open there";
            return Err(self.no_contact(inner, what));
        }
        let within = [0.1, 0.3, 0.5, 0.7, 0.9].map(|part| inner + part * (outer - inner));
        let beyond = [1.05, 1.2, 1.5].map(|factor| factor * outer);
        let radii: Vec<f64> = within.into_iter().chain(beyond).collect();
        let gaps = solution.gaps(&radii);
        let tolerance = ACCURACY * self.range;
        let inside = gaps[..within.len()]
            .iter()
            .all(|gap| (-tolerance..self.range + tolerance).contains(gap));
        let outside = gaps[within.len()..]
            .iter()
            .all(|gap| *gap > self.range - tolerance);
        if inside && outside {
            return Ok(());
        }
        let what = "the gap is not between 0 and the range of the attraction in the annulus, and beyond it outside";
        Err(self.no_contact(inner, what))
    }

    /// Returns the state before the contact in which the attraction acts within `c`, and the gap in
    /// the middle.
    fn before_contact(&self, c: f64) -> (CohesiveState, f64) {
        let [middle, edge] = before_contact::rise(c, &self.symbol).map(|u| -self.traction * u);
        let penetration = 0.5 * self.curvature * c * c + edge - self.range;
        let part = Part {
            penetration,
            load: -0.5 * PI * self.traction * c * c,
            opening: self.range,
            field: Vec::new(),
            spectrum: Vec::new(),
        };
        (
            self.in_si(&Annulus::without_contact(c), &part),
            middle - penetration,
        )
    }

    /// Returns the radius of the attraction at which the contact begins; `None` if it is beyond the
    /// reach.
    fn first_contact(&self) -> Result<Option<f64>, Error> {
        let gap = |c: f64| self.before_contact(c).1;
        // Where nothing moves the gap in the middle is 0 at the first of these radii.
        let mut high = (2.0 * self.range / self.curvature).sqrt().min(self.reach());
        if high == self.reach() && gap(high) > 0.0 {
            return Ok(None);
        }
        while gap(high) < 0.0 && gap(0.5 * high) < 0.0 {
            high *= 0.5;
        }
        root(|c| Ok::<f64, Error>(gap(c)), 0.25 * high, high).map(Some)
    }

    /// Returns the largest radius of an attraction that is solved.
    fn reach(&self) -> f64 {
        if self.symbol.contrast() == 0.0 {
            self.sphere_radius / self.thickness
        } else {
            REACH
        }
    }

    /// Returns a state in SI units.
    fn in_si(&self, annulus: &Annulus, part: &Part) -> CohesiveState {
        CohesiveState {
            contact_radius: annulus.inner * self.thickness,
            outer_radius: annulus.outer * self.thickness,
            load: part.load * self.modulus * self.thickness * self.thickness,
            penetration: part.penetration * self.thickness,
        }
    }

    fn no_contact(&self, radius: f64, what: &'static str) -> Error {
        Error::NotAContact {
            contact_radius: radius * self.thickness,
            what,
        }
    }
}
