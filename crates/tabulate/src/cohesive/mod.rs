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
//! Measured (`tests/truth/cohesive.rs`): load and penetration of 12 contacts within 1e-11 of values by
//! two other programs, Maugis' closed form on a half-space within 1e-12, and the energy balance
//! `dU/d(delta) = F`.

mod annulus;
mod before_contact;
mod checks;
mod fixed_radius;
mod search;
mod surface;

use std::cell::RefCell;
use std::f64::consts::PI;

use interp::{Control, Material, Normalisation, Probe, System, root};

use crate::Error;
use crate::cohesive::annulus::Annulus;
use crate::cohesive::checks::Solution;
use crate::cohesive::fixed_radius::{FixedRadius, Part};
use crate::cohesive::surface::Surface;
use crate::solve::compliance::Compliance;
use crate::solve::layered::LayeredCompliance;
use crate::solve::symbol::Symbol;
use crate::stack::Stack;

/// The radii, over the thickness of the top layer, of contacts and of annuli that are solved.
pub const REACH: f64 = 120.0;

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

/// A state with an annulus of attraction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CohesiveState {
    /// Contact radius `a`, m; 0 before the contact.
    pub contact_radius: f64,
    /// Outer radius `c` of the attraction, m.
    pub outer_radius: f64,
    /// Load `F`, N, positive in compression.
    pub load: f64,
    /// Penetration `delta`, m, positive when the sphere has moved in.
    pub penetration: f64,
}

impl Cohesive {
    /// Takes a film on a substrate, the work of adhesion `w` (J/m^2) and the range `h0` (m) of the
    /// attraction, whose traction is `sigma0 = w/h0`. The probe is a paraboloid.
    ///
    /// # Errors
    /// As [`System::material`]; [`Error::Domain`] unless `w` and `h0` are positive, and for a range
    /// that is not below the radius of the sphere; [`Error::OnlyParaboloid`] for another probe.
    pub fn new(system: &System, work_of_adhesion: f64, range: f64) -> Result<Self, Error> {
        let material = system.material()?;
        let surface = Surface::Film(Compliance::new(&material));
        let unit = match material.normalisation() {
            Normalisation::Sphere => system.sphere_modulus,
            Normalisation::Film => system.film.reduced(),
        };
        let bodies = (surface, &material, unit, system.film_thickness);
        let Probe::Paraboloid { radius } = system.probe else {
            return Err(Error::OnlyParaboloid {
                probe: system.probe.name(),
            });
        };
        Self::of_surface(bodies, radius, work_of_adhesion, range)
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
        let system = merged.system(sphere_radius, sphere_modulus);
        if let [layer] = merged.layers() {
            let system = System {
                film_thickness: layer.thickness,
                ..system
            };
            return Self::new(&system, work_of_adhesion, range);
        }
        let material = system.material()?;
        let unit = match material.normalisation() {
            Normalisation::Sphere => sphere_modulus,
            Normalisation::Film => system.film.reduced(),
        };
        let surface = Surface::Layers(LayeredCompliance::new(&merged));
        let bodies = (surface, &material, unit, merged.top().thickness);
        Self::of_surface(bodies, sphere_radius, work_of_adhesion, range)
    }

    fn of_surface(
        (surface, material, modulus, thickness): (Surface, &Material, f64, f64),
        sphere_radius: f64,
        work_of_adhesion: f64,
        range: f64,
    ) -> Result<Self, Error> {
        let positive = [f64::MIN_POSITIVE, f64::MAX];
        Error::check("work of adhesion", work_of_adhesion, positive)?;
        Error::check(
            "interaction range",
            range,
            [f64::MIN_POSITIVE, sphere_radius],
        )?;
        Ok(Self {
            symbol: Symbol::with_compliance(surface, material),
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
        let solution = self.solution(&mut contact, contact_radius)?;
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
        let solution = self.solution(&mut contact, contact_radius)?;
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
        let solution = self.solution(&mut contact, contact_radius)?;
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
    /// [`Error::Domain`] for a radius that is not positive or beyond the one at which the contact
    /// begins.
    pub fn without_contact(&self, outer_radius: f64) -> Result<CohesiveState, Error> {
        let first = self.first_contact()?;
        Error::check(
            "outer radius",
            outer_radius,
            [f64::MIN_POSITIVE, first * self.thickness],
        )?;
        Ok(self.before_contact(outer_radius / self.thickness).0)
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
        /// The step of `ln a`.
        const STEP: f64 = 0.25;
        /// The smallest contact radius over that of JKR.
        const SMALLEST: f64 = 1e-3;
        let imposed: fn(f64, &CohesiveState) -> f64 = match control {
            Control::Load => |_, state| state.load,
            Control::Displacement => |_, state| state.penetration,
            Control::Spring { stiffness } => {
                Error::check("stiffness of the spring", stiffness, [1e-100, 1e100])?;
                |stiffness, state| state.penetration + state.load / stiffness
            }
        };
        let stiffness = if let Control::Spring { stiffness } = control {
            stiffness
        } else {
            f64::INFINITY
        };
        // The contact radius of JKR without load on a half-space like the surface, in its units.
        let es = self.symbol.modulus();
        let scale =
            (4.5 * PI * 0.5 * self.traction * self.range / (es * self.curvature.powi(2))).cbrt();
        let largest = (0.9 * REACH).min(8.0 * scale);
        let mut value = |log: f64| {
            let radius = log.exp();
            let mut contact = FixedRadius::new(radius, &self.symbol)
                .ok_or_else(|| self.no_contact(radius, "rounding has left no digits"))?;
            let solution = self.solution(&mut contact, radius * self.thickness)?;
            Ok(imposed(
                stiffness,
                &self.in_si(&solution.annulus, &solution.part),
            ))
        };
        let end = (SMALLEST * scale).ln();
        let start = self.start(&mut value, (0.8 * scale).ln(), largest.ln())?;
        if let Some(bracket) = search::bracket(&mut value, start, -STEP, end)? {
            let (log, _) = search::minimum(&mut value, bracket)?;
            return self.state(log.exp() * self.thickness);
        }
        // The imposed value falls until the contact has closed.
        let first = self.first_contact()?;
        let mut value = |log: f64| Ok(imposed(stiffness, &self.before_contact(log.exp()).0));
        match search::bracket(&mut value, first.ln(), -STEP, (1e-3 * first).ln())? {
            Some(bracket) => {
                let (log, _) = search::minimum(&mut value, bracket)?;
                Ok(self.before_contact(log.exp()).0)
            }
            None => Ok(self.before_contact(first).0),
        }
    }

    /// Returns a `ln a` from which the imposed value falls towards smaller contacts, looking from
    /// `from` up to `largest`.
    fn start(
        &self,
        value: &mut impl FnMut(f64) -> Result<f64, Error>,
        from: f64,
        largest: f64,
    ) -> Result<f64, Error> {
        const STEP: f64 = 0.25;
        let mut log = from.min(largest - STEP);
        let mut here = value(log)?;
        while log < largest {
            log += STEP;
            let next = value(log)?;
            if next > here {
                return Ok(log);
            }
            here = next;
        }
        Err(self.no_contact(
            log.exp(),
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

    /// Solves a contact radius, m.
    fn solution<'a>(
        &self,
        contact: &'a mut FixedRadius<'_>,
        contact_radius: f64,
    ) -> Result<Solution<'a>, Error> {
        let annulus = self.annulus(contact, contact_radius)?;
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
    ) -> Result<Annulus, Error> {
        /// The growth of `tan(phi)` from one trial to the next.
        const STEP: f64 = 1.6;
        let radius = contact_radius / self.thickness;
        let reach = if self.symbol.contrast() == 0.0 {
            self.sphere_radius / self.thickness
        } else {
            REACH
        };
        // The annulus of a short range, (pi/4) es w/sigma0^2 beside a long crack, and of a long
        // one, in which the bodies keep their shapes.
        let length = 0.5 * PI * self.symbol.modulus() * self.range / self.traction;
        let short = (length * (length + 2.0 * radius)).sqrt();
        let long = (2.0 * self.range / self.curvature).sqrt();
        let farthest = ((reach / radius).powi(2) - 1.0).max(0.0).sqrt();
        let mut low = (0.4 * short.min(long) / radius).min(farthest);
        let weights = [self.curvature, self.traction];
        let contact = RefCell::new(contact);
        let excess = |tangent: f64| {
            let annulus = Annulus::new(radius, tangent);
            let mut contact = contact.borrow_mut();
            let (parts, _) = contact.parts(&annulus);
            weights[0] * parts[0].opening + weights[1] * parts[1].opening - self.range
        };
        let mut value = excess(low);
        while value > 0.0 && low >= f64::MIN_POSITIVE {
            low *= 0.25;
            value = excess(low);
        }
        if low < f64::MIN_POSITIVE {
            let what = "its annulus is so narrow that rounding has left no digits";
            return Err(self.no_contact(radius, what));
        }
        let mut high = low;
        while value < 0.0 {
            if high >= farthest {
                return Err(Error::AnnulusReach {
                    contact_radius,
                    reach: reach * self.thickness,
                });
            }
            low = high;
            high = (STEP * high).min(farthest);
            value = excess(high);
        }
        let tangent = root(|tangent| Ok::<f64, Error>(excess(tangent)), low, high)?;
        Ok(Annulus::new(radius, tangent))
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

    /// Returns the radius of the attraction at which the contact begins.
    fn first_contact(&self) -> Result<f64, Error> {
        let gap = |c: f64| self.before_contact(c).1;
        let mut high = (2.0 * self.range / self.curvature).sqrt();
        while gap(high) < 0.0 && gap(0.5 * high) < 0.0 {
            high *= 0.5;
        }
        root(|c| Ok::<f64, Error>(gap(c)), 0.25 * high, high)
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
