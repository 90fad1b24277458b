//! Contacts in time where one relaxation function rules all bodies that deform.
//!
//! Lee and Radok's and Ting's reduction of the half-space is exact on films of any thickness, and so
//! is any number of turning points: the contact is arithmetic on the elastic curve. `relaxation`
//! holds the laws, `exponentials` writes them as sums of exponentials, `elastic` is the elastic
//! curve, `program` what is imposed. `one_turn` and `growing_load` have many digits, `elements` serves
//! any history. `moments` and `gamma` are functions for them.

mod elastic;
mod elements;
mod error;
mod exponentials;
mod gamma;
mod growing_load;
mod moments;
mod one_turn;
mod program;
mod relaxation;

pub use self::error::HistoryError;
pub use self::relaxation::Relaxation;

use self::elastic::ElasticCurve;
use self::elements::Elements;
use self::exponentials::Exponentials;
use self::one_turn::Adhesion;
use self::program::Program;
use crate::{Contact, Control, CrackTip, State};

/// The tolerances where none is given: of the integrals, and of elements.
const DIGITS: f64 = 1e-8;
const BY_ELEMENTS: f64 = 1e-5;
/// The part of the tolerance for each of the sources of error.
const PART: f64 = 0.25;
/// The number of elements and the longest step, in parts of the duration, of the first run.
const ELEMENTS: usize = 50;
const LONGEST: f64 = 0.02;
/// The most times that both are refined by 2.
const REFINEMENTS: usize = 7;
/// The largest number of elements, steps and exponentials of one run.
const MOST_WORK: f64 = 2e10;
/// The radius of the last element over that of the largest contact of the first run.
const WIDER: f64 = 1.05;
/// The bound of the error by bodies that relax differently above which it is refused.
const UNLIKE: f64 = 2e-2;

/// What the contact does at a time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// There is no contact.
    Separated,
    /// The contact grows.
    Advancing,
    /// The contact keeps its radius.
    Resting,
    /// The contact shrinks.
    Receding,
}

impl Phase {
    /// Returns the name of the phase in files.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Separated => "separated",
            Self::Advancing => "advancing",
            Self::Resting => "resting",
            Self::Receding => "receding",
        }
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
    const fn separated(time: f64, penetration: f64) -> Self {
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
    /// one of the course. That of the elastic curve itself adds.
    pub error: f64,
    /// The bound of the error by bodies that do not relax, in parts of the largest load; 0 unless
    /// [`History::beside`] is told of them.
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
pub struct History<'a, L = f64> {
    contact: &'a Contact,
    relaxation: Relaxation,
    rigid: Option<&'a Contact>,
    receding: Option<L>,
}

impl Contact {
    /// Returns this contact in time: all bodies that deform relax by one function, and the modulus
    /// of the contact is its `E_ref`.
    ///
    /// # Errors
    /// As [`Relaxation::check`]; [`Error::OtherProbe`](interp::Error::OtherProbe) for a flat punch,
    /// whose load is the stiffness times `int phi d delta`.
    pub fn history(&self, relaxation: &Relaxation) -> Result<History<'_>, HistoryError> {
        relaxation.check()?;
        if self.is_punch() {
            return Err(self
                .makes_no_sense("a history of the contact radius")
                .into());
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
    ) -> Result<[f64; 2], HistoryError> {
        let stiffness = self.stiffness(a)?;
        Ok(relaxation.complex(omega)?.map(|part| stiffness * part))
    }
}

impl<'a, L: CrackTip> History<'a, L> {
    /// States that only the film relaxes, and gives the contact of the same film between a rigid
    /// probe and a rigid base.
    ///
    /// For bodies that relax differently no reduction to the elastic contact exists. The error of
    /// treating all as relaxing is below `chi (1 - phi(T)/phi(first step))`, where `chi` is the
    /// relative rise of the elastic load at the largest penetration when the elastic bodies are made
    /// rigid (24 full simulations: by a factor of 2.5 or more). [`Course::unlike_bodies`] states
    /// it; above 2e-2 it is an error.
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
    /// [`HistoryError::GrowingAdhesion`] for a law with an advancing energy.
    pub fn receding<M: CrackTip>(self, law: M) -> Result<History<'a, M>, HistoryError> {
        let [advancing, _] = crate::crack_tip::energies_in_order(law.at_rest())?;
        if advancing != 0.0 {
            return Err(HistoryError::GrowingAdhesion { advancing });
        }
        Ok(History {
            contact: self.contact,
            relaxation: self.relaxation,
            rigid: self.rigid,
            receding: Some(law),
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
    ) -> Result<Course, HistoryError> {
        let times: Vec<f64> = program.iter().map(|point| point.0).collect();
        self.at(control, program, &times, tolerance)
    }

    /// Follows a program and returns the states at `times` (s, ascending). The last value of the
    /// program is held as long as a time is asked for.
    ///
    /// A penetration that grows, may be held, and falls, and a load that grows or is held take
    /// integrals with many digits; every other program is followed by elements, whose steps are
    /// refined until two refinements agree.
    ///
    /// `tolerance` is that of loads, radii and penetrations, relative to the largest one of each, from
    /// 1e-10 to 1e-2. Without one it is 1e-8 for the integrals, and 1e-5 for elements.
    ///
    /// # Errors
    /// [`HistoryError`] says which number of the program is wrong; [`HistoryError::BeginsInContact`] unless
    /// the first value is 0 or less; [`HistoryError::NotOneDisc`] where a dent has not recovered;
    /// [`HistoryError::Unreached`] for a tolerance that takes too many steps;
    /// [`Error::OutsideRadii`](interp::Error::OutsideRadii) where the curve does not hold the contact
    /// radius.
    pub fn at(
        &self,
        control: Control,
        program: &[(f64, f64)],
        times: &[f64],
        tolerance: Option<f64>,
    ) -> Result<Course, HistoryError> {
        control.check()?;
        if let Some(value) = tolerance.filter(|value| !(1e-10..=1e-2).contains(value)) {
            return Err(HistoryError::Tolerance { value });
        }
        if let Some(i) = times.windows(2).position(|pair| pair[1] < pair[0]) {
            return Err(HistoryError::Order {
                number: i + 2,
                time: times[i + 1],
                before: times[i],
            });
        }
        let program = Program::new(program, times)?;
        if program.values[0] > 0.0 {
            return Err(HistoryError::BeginsInContact {
                name: control.name(),
                value: program.values[0],
            });
        }
        let run = Run {
            history: self,
            control,
            program: &program,
            times,
            tolerance,
        };
        let mut course = run.course()?;
        if let Some(rigid) = self.rigid {
            course.unlike_bodies = self.unlike(rigid, &program, &course)?;
        }
        Ok(course)
    }

    /// Returns the bound of the error by bodies that do not relax.
    fn unlike(
        &self,
        rigid: &Contact,
        program: &Program,
        course: &Course,
    ) -> Result<f64, HistoryError> {
        let penetrations = course.states.iter().map(|at| at.state.penetration);
        let largest = penetrations.fold(0.0, f64::max);
        if largest == 0.0 {
            return Ok(0.0);
        }
        let load = |contact: &Contact| -> Result<f64, HistoryError> {
            let a = elastic::radius_of(contact, "penetration", largest, |node| node.penetration)?;
            Ok(contact.load(a, 0.0)?)
        };
        let chi = load(rigid)? / load(self.contact)? - 1.0;
        // Of a program with few points the first step of a simulation would be shorter.
        let first = (program.times[1] - program.times[0]).min(1e-3 * program.duration());
        let falls =
            1.0 - self.relaxation.modulus(program.duration())? / self.relaxation.modulus(first)?;
        let bound = chi.max(0.0) * falls;
        if bound > UNLIKE {
            return Err(HistoryError::UnlikeBodies { bound, chi });
        }
        Ok(bound)
    }
}

/// One question about a history.
struct Run<'a, L> {
    history: &'a History<'a, L>,
    control: Control,
    program: &'a Program,
    times: &'a [f64],
    tolerance: Option<f64>,
}

impl<L: CrackTip> Run<'_, L> {
    fn course(&self) -> Result<Course, HistoryError> {
        let contact = self.history.contact;
        let largest = self.program.largest();
        if largest <= 0.0 {
            let at = |&time: &f64| {
                let penetration = if self.control == Control::Load {
                    0.0
                } else {
                    self.value_at(time)
                };
                TimedContact::separated(time, penetration)
            };
            return Ok(Course {
                states: self.times.iter().map(at).collect(),
                error: 0.0,
                unlike_bodies: 0.0,
            });
        }
        let tolerance = PART * self.tolerance.unwrap_or(DIGITS);
        match self.control {
            Control::Displacement => {
                let curve = ElasticCurve::to_penetration(contact, largest, tolerance)?;
                let law = self.exponentials(tolerance);
                let receding = self.history.receding.as_ref();
                let adhesion = receding.map(|law| Adhesion {
                    contact,
                    work: law.at_rest()[1],
                });
                let found = one_turn::follow(&curve, &law, self.program, self.times, adhesion)?;
                if let Some(states) = found {
                    let error = curve.load_error.max(curve.radius_error) + law.error;
                    return Ok(Course {
                        states,
                        error,
                        unlike_bodies: 0.0,
                    });
                }
                self.refuse_adhesion("here the contact grows again after its first turn")?;
                self.elements(curve.last().radius)
            }
            Control::Load if growing_load::grows(self.program) => {
                self.refuse_adhesion("here the load is imposed")?;
                let law = self.exponentials(tolerance);
                let loads = growing_load::elastic_loads(&law.creep(), self.program, self.times);
                let most = loads.iter().map(|load| load.1).fold(0.0, f64::max);
                let radius = elastic::radius_of(contact, "load", most, |node| node.load)?;
                let curve = ElasticCurve::up_to(contact, radius, tolerance)?;
                let states = growing_load::states(&curve, &loads, self.program, self.times);
                let error = curve.load_error.max(curve.radius_error) + law.error;
                Ok(Course {
                    states,
                    error,
                    unlike_bodies: 0.0,
                })
            }
            Control::Load => {
                self.refuse_adhesion("here the load is imposed")?;
                let law = self.exponentials(tolerance);
                // No elastic load is larger than that of the largest load held all the time.
                let most = largest * law.creep().value(self.program.duration());
                self.elements(elastic::radius_of(contact, "load", most, |node| node.load)?)
            }
            Control::Spring { stiffness } => {
                self.refuse_adhesion("here the position of a spring is imposed")?;
                let law = self.exponentials(tolerance);
                let most = largest * stiffness * law.creep().value(self.program.duration());
                let [_, to] = contact.contact_radius_range();
                let [a, b] = [
                    elastic::radius_of(contact, "load", most, |node| node.load).unwrap_or(to),
                    elastic::radius_of(contact, "penetration", largest, |node| node.penetration)
                        .unwrap_or(to),
                ];
                self.elements(a.min(b))
            }
        }
    }

    fn value_at(&self, time: f64) -> f64 {
        let end = self
            .program
            .times
            .partition_point(|&t| t < time)
            .clamp(1, self.program.times.len() - 1);
        self.program.on_segment(end, time)
    }

    fn refuse_adhesion(&self, reason: &'static str) -> Result<(), HistoryError> {
        match self.history.receding {
            Some(_) => Err(HistoryError::AdhesiveProgram { reason }),
            None => Ok(()),
        }
    }

    /// Returns the law as exponentials for all times between those of the program and those asked for.
    fn exponentials(&self, tolerance: f64) -> Exponentials {
        let all = self.program.with(self.times);
        let shortest = all
            .windows(2)
            .map(|pair| pair[1].time - pair[0].time)
            .fold(f64::INFINITY, f64::min);
        Exponentials::new(
            &self.history.relaxation,
            [shortest, self.program.duration()],
            tolerance,
        )
    }

    /// Follows the program by elements up to a contact radius (m).
    fn elements(&self, most: f64) -> Result<Course, HistoryError> {
        let contact = self.history.contact;
        let law = self.exponentials(PART * self.tolerance.unwrap_or(BY_ELEMENTS));
        let tolerance = self.tolerance.unwrap_or(BY_ELEMENTS);
        let mut most = most;
        let mut earlier: Option<Vec<TimedContact>> = None;
        let mut extrapolated: Option<Vec<TimedContact>> = None;
        let mut reached = f64::INFINITY;
        let instants = self.program.with(self.times).len() as f64;
        for level in 0..REFINEMENTS {
            let refined = 1 << level;
            let elements = ELEMENTS * refined;
            let steps = (1.0 / LONGEST + instants) * refined as f64;
            if level > 2 && steps * (elements * (1 + law.len())) as f64 > MOST_WORK {
                break;
            }
            let nodes = elastic::evenly(contact, most, elements)?;
            let own = Elements {
                nodes: &nodes,
                law: &law,
                control: self.control,
            };
            let (states, grown) = own.follow(self.program, self.times, LONGEST, refined)?;
            if level == 0 && grown > 0.0 {
                // Elements beyond the largest contact would do nothing.
                most = most.min(WIDER * grown);
            }
            let mut change = f64::INFINITY;
            let better = earlier
                .as_ref()
                .map(|earlier| extrapolate(earlier, &states));
            if let (Some(better), Some(before)) = (&better, &extrapolated) {
                change = difference(better, before);
            }
            reached = change + law.error;
            if change <= tolerance * (1.0 - PART) {
                let states = better.expect("there were two runs");
                return Ok(Course {
                    states,
                    error: reached,
                    unlike_bodies: 0.0,
                });
            }
            earlier = Some(states);
            extrapolated = better;
        }
        Err(HistoryError::Unreached { tolerance, reached })
    }
}

/// Extrapolates from steps and half steps to steps of length 0, at an error of second order.
fn extrapolate(coarse: &[TimedContact], fine: &[TimedContact]) -> Vec<TimedContact> {
    let pairs = coarse.iter().zip(fine);
    let of = |(coarse, fine): (&TimedContact, &TimedContact)| {
        if coarse.state.contact_radius == 0.0 || fine.state.contact_radius == 0.0 {
            return *fine;
        }
        let limit =
            |of: fn(&State) -> f64| of(&fine.state) + (of(&fine.state) - of(&coarse.state)) / 3.0;
        let state = State {
            contact_radius: limit(|state| state.contact_radius),
            load: limit(|state| state.load),
            penetration: limit(|state| state.penetration),
        };
        TimedContact { state, ..*fine }
    };
    pairs.map(of).collect()
}

/// Returns the largest difference of loads, radii and penetrations, each relative to the largest.
fn difference(a: &[TimedContact], b: &[TimedContact]) -> f64 {
    let of = |of: fn(&State) -> f64| {
        let largest = a.iter().map(|at| of(&at.state).abs()).fold(0.0, f64::max);
        let pairs = a.iter().zip(b);
        let change = pairs
            .map(|(a, b)| (of(&a.state) - of(&b.state)).abs())
            .fold(0.0, f64::max);
        if change == 0.0 { 0.0 } else { change / largest }
    };
    of(|state| state.load)
        .max(of(|state| state.contact_radius))
        .max(of(|state| state.penetration))
}
