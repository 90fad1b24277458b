//! Synthetic data.

use std::f64::consts::TAU;

use interp::Table;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::{Branch, Direction, Experiment, Point, contacts_of};
use crate::Error;

/// Makes the experiment that the values of an experiment would give: its measurement, the loads of depths, which
/// follow from the hardness, and the phases of a loss tangent.
///
/// The points of `experiment` say where to measure: their abscissae and directions; their ordinates
/// are not used. On approach the contact forms at the contact point. On retract, and without a
/// direction, it lasts to the end of the stable branch. It is pinned after the turn if the receding
/// work of adhesion is the larger one; the turn is at the largest imposed value. Points at contact
/// radii are always in contact (a radius of 0 is none). `noise` is the standard deviation of the
/// normal noise that is added to each ordinate; one `seed` always gives one measurement. Of a contact
/// stiffness it is relative, 0.01 is 1 %, and its logarithm is normal. A phase has
/// the noise of a stiffness, in rad: both parts of a complex stiffness are as noisy. The
/// [noise of the abscissae](Experiment::abscissa_noise) is added to these, but to a radius of 0.
///
/// # Errors
/// [`Error::Point`] for an abscissa that is not finite; [`Error::Setting`] for a noise that is
/// negative or not finite, a zero of the instrument that is not finite, a missing stiffness, a
/// contact stiffness where there is no contact, numbers of the indentation that a fit does not accept, depths
/// without a hardness, a loss tangent outside 0 to 1, and a noise of the abscissae as large as a contact radius;
/// [`Error::Contact`] outside the table.
pub fn simulate(
    table: &Table,
    experiment: &Experiment,
    noise: f64,
    seed: u64,
) -> Result<Experiment, Error> {
    if !(0.0..f64::INFINITY).contains(&noise) {
        return Err(Error::setting("noise", noise, ">= 0 and finite"));
    }
    experiment.accept_instrument()?;
    experiment.accept_indentation()?;
    experiment.accept_abscissae()?;
    let without_noise = Experiment {
        noise: None,
        ..experiment.clone()
    };
    without_noise.accept_errors()?;
    let mut made = experiment.clone();
    made.reach_contacts();
    made.make(table)?;
    let apart = |point: &&Point| point.ordinate.is_nan();
    if let Some(point) = made.measurement.points.iter().find(apart) {
        let [abscissa, _] = made.measurement.kind.names();
        let name = format!("the {abscissa} of a point of {}", made.measurement.name);
        let allowed = if made.measurement.kind.at_radii() {
            "above 0"
        } else {
            "that of a contact: above 0 without adhesion"
        };
        return Err(Error::setting(name, point.abscissa, allowed));
    }
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    // The method of Box and Muller.
    let mut normal = || {
        let radius = (-2.0 * random.random_range(f64::MIN_POSITIVE..1.0).ln()).sqrt();
        radius * (TAU * random.random_range(0.0..1.0)).cos()
    };
    for i in 0..made.measurement.points.len() {
        let noisy = made.compared(i) + noise * normal();
        made.measurement.points[i].ordinate = made.ordinate_of(noisy);
    }
    for phase in &mut made.indentation.phases {
        *phase += noise * normal();
    }
    let kind = made.measurement.kind;
    let is_size = !kind.at_positions();
    for i in 0..made.measurement.points.len() {
        let exact = made.measurement.points[i].abscissa;
        let read = exact + made.abscissa_deviation(i) * normal();
        if is_size && exact == 0.0 {
            continue;
        }
        if is_size && read <= 0.0 {
            let [abscissa, _] = kind.names();
            let name = format!("the noise of the {abscissa}");
            let allowed = format!(
                "much smaller than each {abscissa}: here it makes one of {exact:e} negative"
            );
            return Err(Error::setting(name, made.abscissa_deviation(i), allowed));
        }
        made.measurement.points[i].abscissa = read;
    }
    Ok(made)
}

impl Experiment {
    /// Gives the points the ordinates of the model.
    pub(crate) fn make(&mut self, table: &Table) -> Result<(), Error> {
        if self.measurement.kind.is_stiffness() {
            return self.make_stiffness(&contacts_of(table));
        }
        let contact = self.bodies.contact(table, &[])?;
        let (branches, order) = self.branches_of_model(&contact)?;
        let predicted = self.predict_with(&contacts_of(table), &branches, &order, &[])?;
        for (point, value) in self.measurement.points.iter_mut().zip(predicted.values) {
            point.ordinate = value;
        }
        Ok(())
    }

    /// Returns the branches on which the model has the points, and the points by descending imposed
    /// value.
    pub(crate) fn branches_of_model(
        &self,
        contact: &contact::Contact,
    ) -> Result<(Vec<Branch>, Vec<usize>), Error> {
        let points = &self.measurement.points;
        let order = self.order();
        if self.relaxing.is_some() {
            return Ok((self.branches_in_time(), order));
        }
        let [advancing, receding] =
            Branch::CONTACTS.map(|branch| self.branch_end(contact, branch, &[]));
        let [advancing, receding] = [advancing?, receding?];
        if self.measurement.kind.is_stiffness() {
            return Ok((vec![Branch::Advancing; points.len()], order));
        }
        let at_radii = self.measurement.kind.at_radii();
        let branches = points
            .iter()
            .map(|point| {
                let end = match point.direction {
                    Some(Direction::Approach) => None,
                    Some(Direction::Retract) => receding.as_ref(),
                    None => advancing.as_ref(),
                };
                let is_apart = if at_radii {
                    point.abscissa == 0.0
                } else {
                    let end = end.map_or(self.contact_point, |end| end.abscissa);
                    self.sense() * (point.abscissa - end) <= 0.0
                };
                if is_apart {
                    Branch::Baseline
                } else {
                    point.branch()
                }
            })
            .collect();
        Ok((branches, order))
    }
}
