//! The choice of the method, and its refinement until two refinements agree.

use super::approach::Place;
use super::elastic::{self, ElasticCurve, Node};
use super::elements::{Elements, LONGEST};
use super::exponentials::Exponentials;
use super::measured::{MeasuredHistory, follow};
use super::program::{Instant, Program};
use super::setting::Setting;
use super::{History, TimedContact, growing_load};
use crate::{Control, Error, State};

/// The tolerances where none is given: of the integrals, and of elements.
const DIGITS: f64 = 1e-8;
const BY_ELEMENTS: f64 = 1e-5;
/// The largest error that is answered with where no tolerance is given.
const COARSEST: f64 = 0.5;
/// The part of the time of growth in which the load of the first contacts arises, and after which it has relaxed.
const EARLY: f64 = 0.01;
/// The most runs of the integrals, and the tolerance of the law in one over that in the one before.
const RUNS: u32 = 5;
const FINER: f64 = 0.1;
/// The stated error over the difference of the last two runs, of which the coarser one may be right by chance.
const SAFETY: f64 = 4.0;
/// The least error that is stated: rounding.
const ROUNDING: f64 = 1e-13;
/// The part of the tolerance for each of the sources of error.
const PART: f64 = 0.25;
/// The most times that both are refined by 2.
const REFINEMENTS: usize = 7;
/// A change of the states from one refinement to the next that is a smaller part of the one before may be small by
/// chance. The first change has none before it, and is divided by the square of this part.
const CHANCE: f64 = 0.25;
/// The largest number of elements, steps and exponentials of one run.
const MOST_WORK: f64 = 2e10;
/// The parts of a step from which on a ring in contact outside the contact is taken to be one.
const MOST_PARTS: usize = 64;
/// The radius of the last element over that of the largest contact of the first run.
const WIDER: f64 = 1.05;

/// States, and their error as [`Course::error`](super::Course::error) states it.
type States = (Vec<TimedContact>, f64);

/// One question about a history.
pub(super) struct Run<'a> {
    pub history: &'a History<'a>,
    pub control: Control,
    pub program: &'a Program,
    /// The program at its points and at all times asked for, and the latter.
    pub instants: &'a [Instant],
    pub asked: &'a [f64],
    pub tolerance: Option<f64>,
}

impl Run<'_> {
    /// Returns the states at the times asked for, and their error.
    pub fn course(&self) -> Result<States, Error> {
        let contact = self.history.contact;
        let largest = self.program.largest();
        if largest <= 0.0 {
            let apart = self.instants.iter().map(|at| at.apart(self.control));
            return Ok((apart.collect(), 0.0));
        }
        match self.control {
            Control::Displacement => match self.integrals(|run| self.one_turn(run))? {
                Some(course) => Ok(course),
                None => {
                    self.refuse_adhesion("here the contact grows again after its first turn")?;
                    let depth = |node: &Node| node.penetration;
                    self.elements(elastic::radius_of(contact, "penetration", largest, depth)?)
                }
            },
            Control::Load if growing_load::grows(self.program) => {
                self.refuse_adhesion("here the load is imposed")?;
                let course = self.integrals(|run| self.growing_load(run).map(Some))?;
                Ok(course.expect("it grows"))
            }
            Control::Load => {
                self.refuse_adhesion("here the load is imposed")?;
                let law = self.law_of_elements();
                // No elastic load is larger than that of the largest load held all the time.
                let most = largest * law.creep().value(self.program.duration());
                self.elements(elastic::radius_of(contact, "load", most, |node| node.load)?)
            }
            Control::Spring { stiffness } => {
                self.refuse_adhesion("here the position of a spring is imposed")?;
                let law = self.law_of_elements();
                let most = largest * stiffness * law.creep().value(self.program.duration());
                self.elements(elastic::radius_on_spring(contact, most, largest)?)
            }
        }
    }

    /// Follows the program by integrals whose parts are finer from run to run, until the error is within the
    /// tolerance; `None` where the integrals do not hold.
    ///
    /// `follow` takes the number of the run, and returns the states and the error of the parts that a comparison of two runs
    /// may not show.
    fn integrals(
        &self,
        follow: impl Fn(u32) -> Result<Option<States>, Error>,
    ) -> Result<Option<States>, Error> {
        let mut coarse: Option<Vec<TimedContact>> = None;
        let mut error = f64::INFINITY;
        for run in 0..RUNS {
            let Some((states, hidden)) = follow(run)? else {
                return Ok(None);
            };
            if let Some(coarse) = &coarse {
                error = SAFETY * difference(&states, coarse, None) + hidden + ROUNDING;
                let is_last = run + 1 == RUNS && self.tolerance.is_none();
                if error <= self.digits() || is_last && error <= COARSEST {
                    return Ok(Some((states, error)));
                }
            }
            coarse = Some(states);
        }
        Err(unreached(self.digits(), error))
    }

    /// Returns the tolerance of integrals.
    fn digits(&self) -> f64 {
        self.tolerance.unwrap_or(DIGITS)
    }

    /// Follows a penetration with at most one turn.
    fn one_turn(&self, run: u32) -> Result<Option<States>, Error> {
        let contact = self.history.contact;
        let relaxation = &self.history.relaxation;
        let tolerance = PART * self.digits();
        let finer = tolerance * FINER.powi(run as i32);
        let law = Exponentials::of_steps(relaxation, self.scales(), finer);
        let deepest = self.program.largest();
        let instants = self.instants;
        let falls = |pair: &[Instant]| pair[1].value < pair[0].value;
        let turn = instants.windows(2).position(falls);
        let rises = |pair: &[Instant]| pair[1].value > pair[0].value;
        if turn.is_some_and(|turn| instants[turn..].windows(2).any(rises)) {
            return Ok(None);
        }
        let setting = Setting {
            contact,
            curve: ElasticCurve::to_penetration(contact, deepest, tolerance, run)?,
            law,
            variations: Vec::new(),
            inputs: &[],
            compliance: 0.0,
            receding: self.history.receding,
            width: 0,
        };
        let mut found = MeasuredHistory {
            states: Vec::with_capacity(instants.len()),
            derivatives: Vec::new(),
        };
        match follow(&setting, &places(&setting.curve, instants), &mut found) {
            Err(Error::GrowsAgain { .. }) => return Ok(None),
            followed => followed?,
        }
        let (law, states) = (&setting.law, found.states);
        let curve = &setting.curve;
        let loads = states.iter().map(|at| at.state.load.abs());
        let largest = loads.fold(f64::MIN_POSITIVE, f64::max);
        // The modulus has been higher when the load of the smallest contacts arose.
        let early = relaxation.modulus(EARLY * self.time_of_growth())?;
        let first = early * curve.first_error / largest;
        Ok(Some((states, first + law.error)))
    }

    /// Follows a load that grows or is held.
    fn growing_load(&self, run: u32) -> Result<States, Error> {
        let law = self.exponentials(PART * self.digits() * FINER.powi(run as i32));
        let loads = growing_load::elastic_loads(&law.creep(), self.instants);
        let (states, error) = growing_load::states(self.history.contact, &loads, self.instants)?;
        Ok((states, error + law.error))
    }

    /// Returns the time until the largest value, s.
    fn time_of_growth(&self) -> f64 {
        let Program { times, values, .. } = self.program;
        let largest = self.program.largest();
        let turn = values.iter().position(|&value| value == largest);
        times[turn.expect("it is one of the values")]
    }

    fn refuse_adhesion(&self, reason: &'static str) -> Result<(), Error> {
        match self.history.receding {
            Some(_) => Error::refused(format!(
                "adhesion is computed for a penetration that grows, may be held, and falls: {reason}; use such a program, \
                 or a contact without adhesion"
            )),
            None => Ok(()),
        }
    }

    /// Returns the law as exponentials for all times between those of the program and those asked for.
    fn exponentials(&self, tolerance: f64) -> Exponentials {
        Exponentials::new(&self.history.relaxation, self.scales(), tolerance)
    }

    fn law_of_elements(&self) -> Exponentials {
        // The error of the sum may be three times as large as is asked for.
        self.exponentials(PART / 3.0 * self.tolerance.unwrap_or(BY_ELEMENTS))
    }

    /// Returns the shortest step and the duration, s.
    fn scales(&self) -> [f64; 2] {
        let pairs = self.instants.windows(2);
        let shortest = pairs
            .map(|pair| pair[1].time - pair[0].time)
            .fold(f64::INFINITY, f64::min);
        [shortest, self.program.duration()]
    }

    /// Follows the program by elements up to a contact radius (m).
    fn elements(&self, most: f64) -> Result<States, Error> {
        let contact = self.history.contact;
        let law = self.law_of_elements().without_negligible();
        let tolerance = self.tolerance.unwrap_or(BY_ELEMENTS);
        let mut most = most;
        let mut earlier: Option<Vec<TimedContact>> = None;
        let mut extrapolated: Option<Vec<TimedContact>> = None;
        let [mut reached, mut change] = [f64::INFINITY; 2];
        let instants = self.instants.len() as f64;
        for level in 0..REFINEMENTS {
            let refined = 1 << level;
            // Between the points of a penetration the elements need no steps, but for the moment at which one touches.
            let mut parts = match self.control {
                Control::Displacement => 1 << (level / 2),
                _ => refined,
            };
            let steps = (1.0 / LONGEST + instants) * parts as f64;
            let nodes = elastic::elements(contact, most, refined)?;
            if level > 2 && steps * (nodes.len() * (1 + law.len())) as f64 > MOST_WORK {
                break;
            }
            let own = Elements {
                nodes: &nodes,
                law: &law,
                control: self.control,
            };
            let (states, grown) = loop {
                match own.follow(self.instants, parts) {
                    // An element that touches and is released within one step may look like a ring.
                    Err(Error::NotOneDisc { .. }) if parts < MOST_PARTS => parts *= 4,
                    found => break found?,
                }
            };
            if level == 0 && grown > 0.0 {
                // Elements beyond the largest contact would do nothing.
                most = most.min(WIDER * grown);
            }
            let before = change;
            change = f64::INFINITY;
            let better = earlier
                .as_ref()
                .map(|earlier| extrapolate(earlier, &states));
            if let (Some(better), Some(coarser)) = (&better, &extrapolated) {
                change = difference(better, coarser, Some(self.asked));
            }
            let likely = if before.is_finite() {
                change.max(CHANCE * before)
            } else {
                change / (CHANCE * CHANCE)
            };
            reached = likely + law.error;
            earlier = Some(states);
            extrapolated = better;
            if reached <= tolerance {
                break;
            }
        }
        match extrapolated {
            Some(states) if reached <= self.tolerance.unwrap_or(COARSEST) => Ok((states, reached)),
            _ => Err(unreached(tolerance, reached / (1.0 - PART))),
        }
    }
}

/// Returns the instants as places, with those between them at which a rising penetration passes from one piece of the
/// elastic curve to the next one: on a piece the load is a cubic polynomial of the penetration.
fn places(curve: &ElasticCurve, instants: &[Instant]) -> Vec<Place> {
    /// The part of a step next to its ends in which the passage does not matter.
    const CLOSE: f64 = 1e-6;
    let mut before = instants[0].time;
    let place = |time, value, point| Place { time, value, point };
    let mut places = vec![place(instants[0].time, instants[0].value, Some(0))];
    for (pair, point) in instants.windows(2).zip(1..) {
        let (from, to) = (&pair[0], &pair[1]);
        let first = curve
            .nodes
            .partition_point(|node| node.penetration <= from.value);
        let past = curve
            .nodes
            .partition_point(|node| node.penetration < to.value);
        for node in &curve.nodes[first..past.max(first)] {
            let part = (node.penetration - from.value) / (to.value - from.value);
            let time = from.time + (to.time - from.time) * part;
            let matters = (CLOSE..1.0 - CLOSE).contains(&part) || node.penetration == 0.0;
            // Times may not resolve a sudden step.
            if matters && time > before && time < to.time {
                places.push(place(time, node.penetration, None));
                before = time;
            }
        }
        before = to.time;
        places.push(place(to.time, to.value, Some(point)));
    }
    places
}

/// Returns the error of a tolerance that is not reached, and one that would be. Printed with two digits it is not rounded
/// down.
fn unreached(tolerance: f64, needed: f64) -> Error {
    const UPWARDS: f64 = 1.05;
    Error::Unreached {
        tolerance,
        reached: UPWARDS * needed,
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

/// Returns the largest difference of loads, radii and penetrations at some times or at all, each in parts of the largest
/// one at all; infinity where one of them is not finite.
fn difference(a: &[TimedContact], b: &[TimedContact], times: Option<&[f64]>) -> f64 {
    let of = |of: fn(&State) -> f64| {
        let largest = a.iter().map(|at| of(&at.state).abs()).fold(0.0, f64::max);
        let pairs = a.iter().zip(b);
        let counts = |(at, _): &(&TimedContact, _)| {
            let next = |times: &[f64]| times.partition_point(|&time| time < at.time);
            times.is_none_or(|times| times.get(next(times)) == Some(&at.time))
        };
        let changes = pairs.filter(counts).map(|(a, b)| {
            let change = (of(&a.state) - of(&b.state)).abs();
            if change.is_finite() {
                change
            } else {
                f64::INFINITY
            }
        });
        match changes.fold(0.0, f64::max) {
            0.0 => 0.0,
            f64::INFINITY => f64::INFINITY,
            change => change / largest,
        }
    };
    of(|state| state.load)
        .max(of(|state| state.contact_radius))
        .max(of(|state| state.penetration))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_finite_never_agrees() {
        let of = |loads: [f64; 2]| {
            loads.map(|load| TimedContact {
                state: State {
                    contact_radius: 1.0,
                    load,
                    penetration: 1.0,
                },
                ..TimedContact::separated(0.0, 0.0)
            })
        };
        assert_eq!(
            difference(&of([1.0, 4.0]), &of([2.0, 4.0]), Some(&[0.0])),
            0.25
        );
        assert_eq!(difference(&of([1.0, 4.0]), &of([2.0, 4.0]), Some(&[])), 0.0);
        for bad in [f64::NAN, f64::INFINITY] {
            for (a, b) in [([bad, 1.0], [1.0, 1.0]), ([1.0, 1.0], [bad, 2.0])] {
                let change = difference(&of(a), &of(b), Some(&[0.0]));
                assert_eq!(change, f64::INFINITY, "{a:?} {b:?}");
            }
        }
    }
}
