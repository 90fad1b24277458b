//! Bodies that relax: what is known of them, and the loads in time.

use contact::{Contact, Control, HistoryInputs, Input, LawParameter, Relaxation};
use interp::{Elastic, Table};

use super::differences::ContactOf;
use super::predicted::Predicted;
use super::program::Program;
use super::{Branch, Experiment, Measurement, Parameter};
use crate::Error;
use crate::statistics::range;

/// Bodies that relax by one function, `E(t) = E_ref phi(t)`.
///
/// The moduli of an [`Experiment`] are then those of `E_ref`: the instantaneous ones, and under a
/// power law those at its reference time. The experiment needs the times of its points, which rise,
/// and penetrations or heights that begin before the contact, grow, may be held, and fall once.
#[derive(Clone, Debug, PartialEq)]
pub struct Relaxing {
    /// The law. Its numbers are parameters: `relaxed-fraction`, `relaxation-exponent`,
    /// `relaxation-time`, `relaxation-weight.2`.
    pub law: Relaxation,
    /// Whether probe and substrate relax like the film. If not, the error of taking them so is
    /// estimated, and refused above 2 %: see [`History::beside`](contact::History::beside).
    pub all_bodies: bool,
}

impl Relaxing {
    /// Takes a film that relaxes between bodies that do not.
    pub const fn new(law: Relaxation) -> Self {
        Self {
            law,
            all_bodies: false,
        }
    }

    /// Lists the numbers of the law as parameters.
    pub fn parameters(&self) -> Vec<Parameter> {
        let own = self.law.parameters().into_iter();
        own.map(Parameter::Law).collect()
    }
}

/// The part of their range by which abscissae that are one cycle do not go back and forth.
const SEVERAL: f64 = 0.1;
/// The part of the indentation within which a penetration is held, and of the largest load by which it falls then.
const HELD: f64 = 0.03;
const FALLS: f64 = 0.1;
/// The most relaxation times of one law.
const MOST_TERMS: usize = 50;

impl Experiment {
    /// Tells whether a relaxation function could be fitted, and none is: loads at penetrations or heights in time.
    pub fn may_relax(&self) -> bool {
        self.measurement.kind.at_positions() && self.relaxing.is_none() && !self.times.is_empty()
    }

    /// Returns why a parameter of the law, or of the adhesion, is not one of this experiment.
    pub(super) fn why_not_relaxing(&self, parameter: Parameter) -> Option<&'static str> {
        let adhesive = parameter.is_work_of_adhesion();
        match (&self.relaxing, parameter) {
            (None, Parameter::Law(_)) => Some("no relaxation function is given; give one"),
            (Some(relaxing), Parameter::Law(own)) if relaxing.law.parameter(own).is_none() => Some(
                "its relaxation function does not have this number, or it follows from the others",
            ),
            (Some(_), _) if adhesive => Some(
                "how much a growing contact gains from adhesion while the bodies relax depends on the \
                 process at the crack tip, for which no law is known here: relaxing contacts are fitted \
                 without adhesion",
            ),
            _ => None,
        }
    }

    /// Accepts the times of the points, and what a fit of bodies that relax needs.
    pub(super) fn accept_relaxing(&self) -> Result<(), Error> {
        let name = &self.measurement.name;
        let points = &self.measurement.points;
        if !self.times.is_empty() && self.times.len() != points.len() {
            let found = self.times.len() as f64;
            let allowed = format!("0, or that of the points, {}", points.len());
            return Err(self.wrong_setting("the number of times", found, allowed));
        }
        let Some(relaxing) = &self.relaxing else {
            return Ok(());
        };
        relaxing.law.check()?;
        if let Relaxation::Prony { terms, .. } = &relaxing.law
            && !(1..=MOST_TERMS).contains(&terms.len())
        {
            let what = "the number of relaxation times";
            return Err(self.wrong_setting(what, terms.len() as f64, "from 1 to 50"));
        }
        if self.bodies.probe.is_flat_punch() {
            return Err(self.not_fitted(
                "a relaxation function is fitted under probes whose contact grows, and that of a flat punch does not",
            ));
        }
        let kind = self.measurement.kind;
        if !kind.at_positions() {
            return Err(self.not_fitted(
                "a relaxation function is fitted to loads at penetrations, or to forces at heights of a \
                 cantilever, in time",
            ));
        }
        self.accept_times()?;
        let adhesion = [Some(self.work_of_adhesion), self.work_of_adhesion_receding];
        if adhesion.into_iter().flatten().any(|work| work != 0.0) {
            return Err(self.not_fitted(
                "it has a work of adhesion, and how much a growing contact gains from adhesion while the \
                 bodies relax depends on the process at the crack tip, for which no law is known here: \
                 fit it without adhesion",
            ));
        }
        if self.holds_penetration() {
            return Err(self.not_fitted(
                "its penetration was held while the force fell, because the cantilever's base moved back: the contact \
                 followed the penetration, and at heights it is not solved; give the penetrations, contact point - height - \
                 force/stiffness, in place of the heights",
            ));
        }
        let range = range(points.iter().map(|point| point.abscissa));
        if self.program().changed > SEVERAL * range {
            return Err(self.not_fitted(
                "its penetrations or heights go back and forth, or scatter, by more than a tenth of their range, and one \
                 approach, which may be held, and one retract are followed: keep the points of one cycle that \
                 begins before the contact, and check that no two columns are swapped",
            ));
        }
        if self.bodies_do_not_relax() && self.bodies.are_layered() {
            return Err(Error::DifferentBodies(name.clone()));
        }
        Ok(())
    }

    /// Accepts times of the points that are finite and rise.
    pub(super) fn accept_times(&self) -> Result<(), Error> {
        let Measurement {
            name,
            numbering,
            points,
            ..
        } = &self.measurement;
        if self.times.is_empty() {
            return Err(Error::NoTimes(name.clone()));
        }
        for (&time, point) in self.times.iter().zip(points) {
            if time.is_infinite() {
                return Err(self.refused(point.line, "time", time, "finite"));
            }
        }
        for (i, pair) in self.times.windows(2).enumerate() {
            if pair[0].is_nan() || pair[1].is_nan() || pair[1] <= pair[0] {
                return Err(Error::Times {
                    measurement: name.clone(),
                    numbering: *numbering,
                    line: points[i + 1].line,
                    time: pair[1],
                    before: pair[0],
                });
            }
        }
        Ok(())
    }

    /// Tells whether the penetration was held after the turn of the heights, at least half as long as it grew before.
    fn holds_penetration(&self) -> bool {
        let Control::Spring { stiffness } = self.control() else {
            return false;
        };
        let points = &self.measurement.points;
        let turn = self.program().turn;
        let load = |i: usize| points[i].ordinate - points[0].ordinate;
        let penetration = |i: usize| self.imposed(points[i].abscissa) - load(i) / stiffness;
        let Some(begin) = (0..turn).find(|&i| load(i) > FALLS * load(turn)) else {
            return false;
        };
        let change = |i: usize| (penetration(i) - penetration(turn)).abs();
        let held = (turn..points.len()).take_while(|&i| change(i) <= HELD * change(begin));
        held.last().is_some_and(|end| {
            let falls = load(turn) - load(end);
            let moves_back =
                self.imposed(points[turn].abscissa) - self.imposed(points[end].abscissa);
            self.times[end] - self.times[turn] >= 0.5 * (self.times[turn] - self.times[begin])
                && falls >= FALLS * load(turn)
                && (0.5..2.0).contains(&(moves_back * stiffness / falls))
        })
    }

    /// Tells whether a body deforms and does not relax.
    fn bodies_do_not_relax(&self) -> bool {
        let all = self.relaxing.as_ref().is_some_and(|one| one.all_bodies);
        let base_deforms = || {
            self.bodies
                .base()
                .is_some_and(|base| base.young().is_finite())
        };
        !all && (self.bodies.sphere_modulus.is_finite() || base_deforms())
    }

    /// Returns the contact between a rigid probe and a rigid base, where one of them deforms and
    /// does not relax.
    pub(crate) fn beside_rigid(&self, table: &Table) -> Result<Option<Contact>, Error> {
        if !self.bodies_do_not_relax() || self.bodies.are_layered() {
            return Ok(None);
        }
        let mut rigid = self.bodies.clone();
        rigid.sphere_modulus = f64::INFINITY;
        if let Some(base) = rigid.base() {
            rigid.base = Elastic::new(f64::INFINITY, base.poisson())?;
        }
        rigid.contact(table, &[]).map(Some)
    }

    /// Returns what is imposed on the contact in time, without its noise.
    pub(crate) fn program(&self) -> Program {
        let points = &self.measurement.points;
        let values = points.iter().map(|point| self.sense() * point.abscissa);
        let mut program = Program::new(&self.times, &values.collect::<Vec<f64>>());
        // Afterwards, so that the same point is the turn for each contact point.
        let shift = self.imposed(0.0);
        for (_, value) in &mut program.points {
            *value += shift;
        }
        program
    }

    /// Returns the branches of points in time: advancing up to the largest imposed value, and receding
    /// from there on. The model tells which of them have no contact.
    pub(super) fn branches_in_time(&self) -> Vec<Branch> {
        let turn = self.program().turn;
        let branch = |i: usize| {
            if i <= turn {
                Branch::Advancing
            } else {
                Branch::Receding
            }
        };
        (0..self.measurement.points.len()).map(branch).collect()
    }

    /// Predicts all points, with derivatives with respect to `parameters`.
    pub(super) fn predict_history(
        &self,
        contact_of: &ContactOf<'_>,
        parameters: &[Parameter],
    ) -> Result<Predicted, Error> {
        let Some(relaxing) = &self.relaxing else {
            return Err(Error::nothing("relaxation function"));
        };
        let points = &self.measurement.points;
        let exact = !self.bodies.are_layered();
        let contact = contact_of(&self.bodies, if exact { parameters } else { &[] })?;
        let program = self.program();
        let (mut inputs, mut law): (Vec<Input>, Vec<LawParameter>) = (Vec::new(), Vec::new());
        for &parameter in parameters {
            if let Parameter::Law(own) = parameter {
                law.push(own);
            }
            inputs.extend(self.bodies.input(parameter).filter(|_| exact));
        }
        let asked = (!parameters.is_empty()).then_some(HistoryInputs {
            contact: &inputs,
            law: &law,
        });
        let history = contact.history(&relaxing.law)?;
        let found = history.measured(self.control(), &program.points, asked)?;
        let width = 2 + inputs.len() + law.len();
        let pairs = points.iter().zip(&found.states);
        let values = pairs.map(|(point, at)| self.baseline_at(point.abscissa) + at.state.load);
        let mut predicted = Predicted::new(values.collect(), 0);
        let radii = found.states.iter().map(|at| at.state.contact_radius);
        predicted.radii = radii.collect();
        if parameters.is_empty() {
            return Ok(predicted);
        }
        // The column of the history that each parameter takes, and its sign.
        let sense = self.sense();
        let place = |input: Input| inputs.iter().position(|own| *own == input);
        let taken = |parameter: Parameter| match parameter {
            Parameter::ContactPoint => (Some(0), -sense),
            Parameter::Stiffness => (Some(1), 1.0),
            Parameter::Law(own) => {
                let place = law.iter().position(|one| *one == own);
                (place.map(|k| 2 + inputs.len() + k), 1.0)
            }
            _ => {
                let input = self.bodies.input(parameter);
                (input.and_then(place).map(|k| 2 + k), 1.0)
            }
        };
        let taken: Vec<(Option<usize>, f64)> = parameters.iter().copied().map(taken).collect();
        for row in found.derivatives.chunks_exact(width) {
            let load = |&(column, sign): &(Option<usize>, f64)| {
                column.map_or(0.0, |column| sign * row[column])
            };
            predicted.derivatives.extend(taken.iter().map(load));
        }
        self.add_baseline_derivatives(parameters, &mut predicted.derivatives);
        if exact {
            return Ok(predicted);
        }
        for (column, &parameter) in parameters.iter().enumerate() {
            if parameter.is_of_bodies() {
                let values = |moved: &Self| Ok(moved.predict_history(contact_of, &[])?.values);
                let by = self.differences(parameter, values)?;
                predicted.set_column(column, parameters.len(), by);
            }
        }
        Ok(predicted)
    }
}
