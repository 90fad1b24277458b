//! A measured penetration, or position of a spring, that grows, may be held, and falls: the loads and
//! their derivatives, in fixed steps.
//!
//! The equations are those of `one_turn`. With the total derivatives `A = dF_el/dp` at a fixed place of
//! the program, and `delta_p` of the penetration, that of the load is
//!
//! ```text
//! advancing:  F_p = int_0^t phi dA + int_0^t phi_p dF_el
//! receding:   F_p = int_0^t1 phi dA + int_0^t1 phi_p dF_el + S(t1) [int_t1^t phi d delta_p + int_t1^t phi_p d delta]
//! ```
//!
//! because `int_t1^t phi d delta = 0` at every `p`. Under a spring `delta_p` follows from `F_p`, step by
//! step. `approach` takes the steps up to the turn, `return_steps` those after it.

use super::approach::{Approach, Place};
use super::elastic::{self, ElasticCurve};
use super::exponentials::Exponentials;
use super::program::Program;
use super::return_steps::Return;
use super::setting::Setting;
use super::variation::with_derivatives;
use super::{History, HistoryError, LawParameter, TimedContact};
use crate::{Control, Input};
use interp::check::finite_result;

/// The fewest steps of a history; longer steps between points are divided.
const STEPS: f64 = 120.0;
const STEPS_OF_A_SPRING: f64 = 250.0;
/// The relative tolerance of the exponentials, and of the elastic curve.
const LAW: f64 = 1e-6;
const ELASTIC: f64 = 1e-7;

/// What the loads of a measured history are differentiated by, beside the place of the program and
/// the stiffness of the spring.
#[derive(Clone, Copy, Debug, Default)]
pub struct HistoryInputs<'a> {
    /// Inputs of the contact.
    pub contact: &'a [Input],
    /// Numbers of the law.
    pub law: &'a [LawParameter],
}

/// The states at the points of a measured history, and the derivatives of their loads.
#[derive(Clone, Debug, PartialEq)]
pub struct MeasuredHistory {
    /// The states.
    pub states: Vec<TimedContact>,
    /// The derivatives of the load of each point, point after point, in SI units: with respect to all
    /// imposed values at once, the stiffness of the spring (0 without one), the inputs of the contact,
    /// and the numbers of the law. Empty if none are asked for.
    pub derivatives: Vec<f64>,
}

impl History<'_> {
    /// Follows measured penetrations (m) or positions of a spring (m) in time (s), joined by straight
    /// lines, and returns the states at the points, with the derivatives of the loads if `inputs` are
    /// given.
    ///
    /// The values grow, may be held, and fall once. The steps are those of the points, at most 1/120
    /// of the duration (of a spring 1/250), so that the loads are smooth functions of all numbers. Their errors are some
    /// 1e-5 of the largest load. Of bodies that nearly flow they are larger just after the first touch and after a sudden
    /// change of the speed: up to 4e-3 (`measured_tests.rs`), and with a spring more. [`History::at`] holds a tolerance.
    ///
    /// # Errors
    /// As [`History::at`]; [`HistoryError::GrowsAgain`] where the contact grows after its first
    /// retract; [`HistoryError::MeasuredLoad`] for imposed loads; [`interp::Error::FixedParameter`](interp::Error::FixedParameter)
    /// and [`interp::Error::NoGradient`](interp::Error::NoGradient) as
    /// [`Contact::gradient`](crate::Contact::gradient).
    pub fn measured(
        &self,
        control: Control,
        points: &[(f64, f64)],
        inputs: Option<HistoryInputs<'_>>,
    ) -> Result<MeasuredHistory, HistoryError> {
        control.check()?;
        let compliance = match control {
            Control::Displacement => 0.0,
            Control::Spring { stiffness } => 1.0 / stiffness,
            Control::Load => return Err(HistoryError::MeasuredLoad),
        };
        let program = Program::new(points, &[])?;
        if program.values[0] > 0.0 {
            return Err(HistoryError::BeginsInContact {
                name: control.name(),
                value: program.values[0],
            });
        }
        let width = inputs.map_or(0, |inputs| 2 + inputs.contact.len() + inputs.law.len());
        let inputs = inputs.unwrap_or_default();
        let mut found = MeasuredHistory {
            states: Vec::with_capacity(points.len()),
            derivatives: vec![0.0; points.len() * width],
        };
        let largest = program.largest();
        if largest <= 0.0 {
            let apart = points
                .iter()
                .map(|&(time, value)| TimedContact::separated(time, value));
            found.states.extend(apart);
            return Ok(found);
        }
        let count = match control {
            Control::Spring { .. } => STEPS_OF_A_SPRING,
            _ => STEPS,
        };
        let steps = steps(&program, count);
        // What the first touch divides has small loads.
        let ends = program.times.windows(2).map(|pair| pair[1] - pair[0]);
        let shortest = ends.fold(program.duration() / count, f64::min);
        let (law, variations) = with_derivatives(
            &self.relaxation,
            [shortest, program.duration()],
            LAW,
            inputs.law,
        );
        let setting = Setting {
            contact: self.contact,
            curve: self.curve_to(control, largest, &law, program.duration())?,
            law,
            variations,
            inputs: inputs.contact,
            compliance,
            width,
        };
        follow(&setting, &steps, &mut found)?;
        for (point, at) in found.states.iter().enumerate() {
            let radius = at.state.contact_radius;
            finite_result(radius, at.state.load)?;
            for by in &found.derivatives[point * width..][..width] {
                finite_result(radius, *by)?;
            }
        }
        Ok(found)
    }

    /// Returns the elastic curve up to the largest contact that an imposed value can make.
    fn curve_to(
        &self,
        control: Control,
        largest: f64,
        law: &Exponentials,
        duration: f64,
    ) -> Result<ElasticCurve, HistoryError> {
        let by_depth = elastic::radius_of(self.contact, control.name(), largest, |node| {
            node.penetration
        });
        let radius = match control {
            Control::Spring { stiffness } => {
                // No elastic load is larger than that of the largest load held all the time.
                let most = largest * stiffness * law.creep().value(duration);
                let by_load = elastic::radius_of(self.contact, "load", most, |node| node.load);
                match (by_load, by_depth) {
                    (Ok(a), Ok(b)) => a.min(b),
                    (Ok(a), Err(_)) => a,
                    (Err(_), by_depth) => by_depth?,
                }
            }
            _ => by_depth?,
        };
        ElasticCurve::up_to(self.contact, radius, ELASTIC, 0)
    }
}

/// Returns the places of the program: its points, the first touch, and what divides long steps.
fn steps(program: &Program, count: f64) -> Vec<Place> {
    let longest = program.duration() / count;
    let mut steps = vec![Place {
        time: program.times[0],
        value: program.values[0],
        point: Some(0),
    }];
    let mut touched = program.values[0] >= 0.0;
    for end in 1..program.times.len() {
        let [t0, t1] = [program.times[end - 1], program.times[end]];
        let [v0, v1] = [program.values[end - 1], program.values[end]];
        let mut inner: Vec<f64> = Vec::new();
        if !touched && v1 > 0.0 {
            touched = true;
            let touch = t0 + (t1 - t0) * (v0 / (v0 - v1));
            if touch > t0 && touch < t1 {
                inner.push(touch);
            }
        }
        let begin = inner.first().copied().unwrap_or(t0);
        // Before the touch nothing happens.
        if touched {
            let parts = ((t1 - begin) / longest * (1.0 - 1e-9)).ceil().max(1.0) as usize;
            inner.extend((1..parts).map(|i| begin + (t1 - begin) * (i as f64 / parts as f64)));
        }
        for time in inner {
            let value = if time == begin {
                0.0
            } else {
                program.on_segment(end, time)
            };
            steps.push(Place {
                time,
                value,
                point: None,
            });
        }
        steps.push(Place {
            time: t1,
            value: v1,
            point: Some(end),
        });
    }
    steps
}

/// Takes the steps.
fn follow(
    setting: &Setting<'_>,
    steps: &[Place],
    found: &mut MeasuredHistory,
) -> Result<(), HistoryError> {
    let width = setting.width;
    let mut by = vec![0.0; width];
    let mut approach = Approach::new(setting, &steps[0], steps.len());
    let mut add = |place: &Place, state: TimedContact, by: &[f64]| {
        if let Some(point) = place.point {
            found.states.push(state);
            found.derivatives[point * width..][..width].copy_from_slice(by);
        }
    };
    add(
        &steps[0],
        TimedContact::separated(steps[0].time, steps[0].value),
        &by,
    );
    let mut done = 1;
    for place in &steps[1..] {
        let Some(state) = approach.advance(place, &mut by)? else {
            break;
        };
        add(place, state, &by);
        done += 1;
    }
    let mut back = Return::new(&approach);
    for place in &steps[done..] {
        let state = back.recede(place, &mut by)?;
        add(place, state, &by);
    }
    Ok(())
}
