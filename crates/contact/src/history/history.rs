//! The history of one contact, its course and its states.

use super::program::Program;
use super::relaxation::Relaxation;
use super::run::Run;
use crate::{Contact, Control, CrackTip, Error, State};

/// The bound of the error by bodies that relax differently above which it is refused.
pub(super) const UNLIKE: f64 = 2e-2;

named! {
    /// What the contact does at a time.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Phase {
        /// There is no contact.
        Separated = "separated",
        /// The contact grows.
        Advancing = "advancing",
        /// The contact keeps its radius.
        Resting = "resting",
        /// The contact shrinks.
        Receding = "receding",
    }
}

/// A contact at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimedContact {
    /// Time, s.
    pub time: f64,
    /// What the contact does.
    pub phase: Phase,
    /// Radius, load and penetration. Radius and load are 0 without contact.
    pub state: State,
}

impl TimedContact {
    /// The surfaces at a distance.
    pub(super) const fn separated(time: f64, penetration: f64) -> Self {
        Self {
            time,
            phase: Phase::Separated,
            state: State {
                contact_radius: 0.0,
                load: 0.0,
                penetration,
            },
        }
    }
}

/// The states of a contact in time, and their error.
#[derive(Clone, Debug, PartialEq)]
pub struct Course {
    /// The states, in the order of their times.
    pub states: Vec<TimedContact>,
    /// The estimated largest error of the loads, the contact radii and the penetrations, each in parts of the largest
    /// one of the program. That of the elastic curve itself adds.
    ///
    /// Under adhesion the contact may separate suddenly. Next to that time loads and radii may be those of the other side.
    ///
    /// `tests/truth/viscoelastic/errors.rs` compares it with the same histories to smaller tolerances.
    pub error: f64,
    /// The bound of the error by bodies that do not relax: of the loads, in parts of the largest one, or where loads are
    /// imposed of the penetrations, in parts of the largest one. 0 unless [`History::beside`] is told of them.
    pub unlike_bodies: f64,
}

/// A contact whose deforming bodies relax by one function.
///
/// Made by [`Contact::history`].
///
/// ```
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// use contact::{Contact, Control, Relaxation};
/// use interp::{Elastic, HalfSpace, Probe};
///
/// let gel = Elastic::new(1e3, 0.5)?; // the modulus after 1 s
/// let system = HalfSpace { probe: Probe::Paraboloid { radius: 1e-5 }, sphere_modulus: f64::INFINITY, solid: gel };
/// let contact = Contact::half_space(&system)?;
/// let law = Relaxation::PowerLaw { exponent: 0.2, time: 1.0 };
/// let program = [(0.0, 0.0), (1.0, 1e-6), (2.0, 0.0)];
/// let course = contact.history(&law)?.at(Control::Displacement, &program, &[0.5, 1.0, 1.5], None)?;
/// assert!(course.states[2].state.load < course.states[0].state.load); // hysteresis
/// # Ok(()) }
/// ```
#[derive(Clone, Debug)]
pub struct History<'a> {
    pub(super) contact: &'a Contact,
    pub(super) relaxation: Relaxation,
    pub(super) rigid: Option<&'a Contact>,
    /// The energy of the receding line, J/m^2.
    pub(super) receding: Option<f64>,
}

impl Contact {
    /// Returns this contact in time: all bodies that deform relax by one function, and the modulus
    /// of the contact is its `E_ref`.
    ///
    /// With full friction an approach and a retract are exact. Where the contact grows again, its points are taken to stick
    /// where they would stick at a first touch: up to `a/t` of 1.4 a simulation without this found loads within 5e-4 of the
    /// largest one.
    ///
    /// # Errors
    /// As [`Relaxation::check`]; [`interp::Error::OtherProbe`] for a flat punch,
    /// whose load is the stiffness times `int phi d delta`.
    pub fn history(&self, relaxation: &Relaxation) -> Result<History<'_>, Error> {
        relaxation.check()?;
        if self.is_punch() {
            return Err(self.makes_no_sense("a history of the contact radius"));
        }
        Ok(History {
            contact: self,
            relaxation: relaxation.clone(),
            rigid: None,
            receding: None,
        })
    }

    /// Returns the storage and the loss part (N/m) of the contact stiffness under a small
    /// oscillation of angular frequency `omega` (rad/s) at contact radius `a` (m).
    ///
    /// The contact radius is constant, or the amplitude small. Both parts are the elastic stiffness
    /// times [`Relaxation::complex`], exactly, under every probe.
    ///
    /// # Errors
    /// As [`Contact::stiffness`] and [`Relaxation::complex`].
    pub fn complex_stiffness(
        &self,
        a: f64,
        relaxation: &Relaxation,
        omega: f64,
    ) -> Result<[f64; 2], Error> {
        let stiffness = self.stiffness(a)?;
        Ok(relaxation.complex(omega)?.map(|part| stiffness * part))
    }
}

impl<'a> History<'a> {
    /// States that only the film relaxes, and gives the contact of the same film between a rigid
    /// probe and a rigid base.
    ///
    /// For bodies that relax differently no reduction to the elastic contact exists. All are followed as relaxing by
    /// `phi`. To first order the error of a load `F` is at most `chi` times the largest difference of `F` and
    /// `int phi(t-s) dF(s)`, where `chi` is the relative rise of the elastic load when the other bodies are made rigid.
    /// [`Course::unlike_bodies`] states this bound; above 2e-2 it is an error.
    #[must_use]
    pub fn beside(self, rigid: &'a Contact) -> Self {
        Self {
            rigid: Some(rigid),
            ..self
        }
    }

    /// Adds adhesion that acts on the receding line alone. The energies of the law are those of the
    /// crack tip with the modulus `E_ref`.
    ///
    /// The contact advances without adhesion. The line rests after the turn until the edge singularity reaches
    /// the energy at which the law recedes.
    ///
    /// # Errors
    /// [`Error::Refused`] for a law with an advancing energy, or whose energy depends on the speed of the line.
    pub fn receding(self, law: impl CrackTip) -> Result<Self, Error> {
        let [advancing, receding] = crate::line::energies_in_order(law.at_rest())?;
        if advancing != 0.0 {
            return Error::refused(format!(
                "the advancing energy is {advancing:?} J/m^2 and must be 0: how much a growing contact gains from adhesion \
                 while the bodies relax depends on the process at the crack tip, for which no law is known here; give the \
                 energy of the receding line alone, `Hysteresis::new(0.0, w)`"
            ));
        }
        if law.speed(2.0 * receding + f64::MIN_POSITIVE).is_finite() {
            return Error::refused(
                "the energy of the receding line depends on its speed, and a history takes one energy for all \
                 speeds: give `Hysteresis::new(0.0, w)`",
            );
        }
        Ok(Self {
            receding: Some(receding),
            ..self
        })
    }

    /// Follows a program of penetrations (m), loads (N) or positions of the spring (m) in time (s), joined by straight
    /// lines, and returns the states at its points.
    ///
    /// # Errors
    /// As [`History::at`].
    pub fn run(
        &self,
        control: Control,
        program: &[(f64, f64)],
        tolerance: Option<f64>,
    ) -> Result<Course, Error> {
        let times: Vec<f64> = program.iter().map(|point| point.0).collect();
        self.at(control, program, &times, tolerance)
    }

    /// Follows a program and returns the states at `times` (s, ascending). The last value of the
    /// program is held as long as a time is asked for.
    ///
    /// A penetration that grows, may be held, and falls, and a load that grows or is held take
    /// integrals with many digits; every other program is followed by elements. Both are refined until two runs agree.
    ///
    /// `tolerance` is that of loads, radii and penetrations, relative to the largest one of each, from
    /// 1e-10 to 1e-2. Bodies that nearly flow may not reach the smallest ones. Without one, integrals aim at 1e-8 and elements
    /// at 1e-5; the error that is reached is stated, and more than 0.5 is an error.
    ///
    /// # Errors
    /// [`Error::Refused`] says what is wrong with the program or the times, as with a first value that is not 0 or
    /// less, or with adhesion under such a program; [`Error::NotOneDisc`] where a dent has not recovered;
    /// [`Error::Unreached`] for a tolerance that is not reached; [`Error::OutsideRadii`] where the curve does not hold
    /// the contact radius; [`Error::UnlikeBodies`] after [`History::beside`]; [`interp::Error::InvalidArgument`] for a
    /// `tolerance` outside `[1e-10, 1e-2]`; [`interp::Error::Unphysical`] for a stiffness outside `[1e-100, 1e100]`.
    pub fn at(
        &self,
        control: Control,
        program: &[(f64, f64)],
        times: &[f64],
        tolerance: Option<f64>,
    ) -> Result<Course, Error> {
        control.check()?;
        tolerance.map_or(Ok(()), crate::line::check_tolerance)?;
        if let Some(i) = times.windows(2).position(|pair| pair[1] < pair[0]) {
            return Error::refused(format!(
                "time {} of those asked for is {:?} s and the one before it {:?} s: give them in ascending order",
                i + 2,
                times[i + 1],
                times[i]
            ));
        }
        let program = Program::new(control.name(), program, times)?;
        let origin = program.origin;
        let asked: Vec<f64> = times.iter().map(|time| time - origin).collect();
        // Errors are parts of the largest values of the program, whatever is asked for.
        let mut all = asked.clone();
        if self.rigid.is_some() {
            all.extend(program.between());
            all.sort_by(f64::total_cmp);
        }
        let run = Run {
            history: self,
            control,
            program: &program,
            instants: &program.with(&all),
            asked: &asked,
            tolerance,
        };
        let (states, error) = run.course().map_err(|error| error.later_by(origin))?;
        let unlike_bodies = match self.rigid {
            Some(rigid) => self.unlike(rigid, control, &states)?,
            None => 0.0,
        };
        let mut states = states.into_iter().peekable();
        let asked = asked.iter().zip(times).map(|(&from_origin, &time)| {
            while states.next_if(|at| at.time < from_origin).is_some() {}
            let at = *states.peek().expect("the program holds all times");
            TimedContact { time, ..at }
        });
        Ok(Course {
            states: asked.collect(),
            error,
            unlike_bodies,
        })
    }
}
