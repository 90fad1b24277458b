//! A measured penetration, or position of a spring, that grows, may be held, and falls: the loads and
//! their derivatives, in fixed steps.
//!
//! The equations are those of `approach`. With the total derivatives `A = dF_el/dp` at a fixed place of
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
use super::steps::Steps;
use super::variation::with_derivatives;
use super::{History, LawParameter, TimedContact};
use crate::{Control, Error, Input};
use interp::check::finite_result;

/// The relative tolerance of the exponentials, and of the elastic curve.
const LAW: f64 = 1e-6;
const ELASTIC: f64 = 1e-7;
/// The estimated error over the difference from steps of half the length.
const SAFETY: f64 = 2.0;

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
    /// The values grow, may be held, and fall once. The steps depend on the points and on the first touch alone,
    /// so that the loads are smooth functions of all numbers, but for their errors. Of imposed penetrations
    /// these are some 1e-5 of the largest load. Under a spring they are larger, and most where a body that
    /// nearly flows turns suddenly. [`History::error_of_measured`] estimates them, and [`History::at`] holds a
    /// tolerance.
    ///
    /// # Errors
    /// As [`History::at`]; [`Error::GrowsAgain`] where the contact grows after its first
    /// retract; [`Error::Refused`] for imposed loads; [`interp::Error::FixedParameter`](interp::Error::FixedParameter)
    /// and [`interp::Error::NoGradient`](interp::Error::NoGradient) as
    /// [`Contact::gradient`](crate::Contact::gradient).
    pub fn measured(
        &self,
        control: Control,
        points: &[(f64, f64)],
        inputs: Option<HistoryInputs<'_>>,
    ) -> Result<MeasuredHistory, Error> {
        self.followed(control, points, inputs, |steps| steps)
    }

    /// Estimates the largest error of the loads of a [measured history](History::measured) by its steps, in
    /// parts of the largest load: twice the difference from steps of half the length. To it come up to 1e-5 by
    /// the exponentials and the elastic curve.
    ///
    /// It takes twice as long as the history. `measured_tests.rs` compares it with histories of many digits.
    ///
    /// # Errors
    /// As [`History::measured`].
    pub fn error_of_measured(
        &self,
        control: Control,
        points: &[(f64, f64)],
        measured: &MeasuredHistory,
    ) -> Result<f64, Error> {
        let finer = self.followed(control, points, None, Steps::halved)?;
        let (mut most, mut largest) = (0.0_f64, 0.0_f64);
        for (own, finer) in measured.states.iter().zip(&finer.states) {
            most = most.max((own.state.load - finer.state.load).abs());
            largest = largest.max(finer.state.load.abs());
        }
        Ok(if largest > 0.0 {
            SAFETY * most / largest
        } else {
            0.0
        })
    }

    /// Follows a measured history in steps that are made from the usual ones.
    fn followed(
        &self,
        control: Control,
        points: &[(f64, f64)],
        inputs: Option<HistoryInputs<'_>>,
        of_usual: fn(Steps) -> Steps,
    ) -> Result<MeasuredHistory, Error> {
        control.check()?;
        let compliance = match control {
            Control::Displacement => 0.0,
            Control::Spring { stiffness } => 1.0 / stiffness,
            Control::Load => {
                return Error::refused(
                    "the loads are imposed, and measured histories follow a penetration or the position of a spring: give one of these",
                );
            }
        };
        let program = Program::new(control.name(), points, &[])?;
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
        let steps = of_usual(Steps::new(&program, compliance > 0.0));
        let (law, variations) = with_derivatives(
            &self.relaxation,
            [steps.shortest(&program), program.duration()],
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
            receding: None,
            width,
        };
        follow(&setting, &steps.places(&program), &mut found)
            .map_err(|error| error.later_by(program.origin))?;
        for (point, at) in found.states.iter_mut().enumerate() {
            at.time = points[point].0;
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
    ) -> Result<ElasticCurve, Error> {
        let Control::Spring { stiffness } = control else {
            return ElasticCurve::to_penetration(self.contact, largest, ELASTIC, 0);
        };
        // No elastic load is larger than that of the largest load held all the time.
        let most = largest * stiffness * law.creep().value(duration);
        let radius = elastic::radius_on_spring(self.contact, most, largest)?;
        ElasticCurve::up_to(self.contact, radius, ELASTIC, 0)
    }
}

/// Takes the steps.
pub(super) fn follow(
    setting: &Setting<'_>,
    places: &[Place],
    found: &mut MeasuredHistory,
) -> Result<(), Error> {
    let width = setting.width;
    let mut by = vec![0.0; width];
    let mut approach = Approach::new(setting, &places[0], places.len());
    let mut add = |place: &Place, state: TimedContact, by: &[f64]| {
        if let Some(point) = place.point {
            found.states.push(state);
            found.derivatives[point * width..][..width].copy_from_slice(by);
        }
    };
    add(
        &places[0],
        TimedContact::separated(places[0].time, places[0].value),
        &by,
    );
    let mut done = 1;
    for place in &places[1..] {
        let Some(state) = approach.advance(place, &mut by)? else {
            break;
        };
        add(place, state, &by);
        done += 1;
    }
    let mut back = Return::new(&approach);
    for place in &places[done..] {
        let state = back.recede(place, &mut by)?;
        add(place, state, &by);
    }
    Ok(())
}
