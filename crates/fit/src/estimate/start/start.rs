//! The problem at the starts that the data show.

use contact::Control;
use interp::Table;

use super::indentation;
use super::jkr::{Homogeneous, homogeneous, level_is, radius_of};
use super::relaxing_start;
use super::starts::{Starts, root_of_modulus};
use crate::estimate::problem::Problem;
use crate::estimate::problem::assigned::Assigned;
use crate::estimate::problem::slot::Slot;
use crate::model::has_no_start;
use crate::statistics::median;
use crate::{Error, Experiment, Free, Kind, LayerQuantity, LineSpeed, Loss, Parameter};

/// The smallest work of adhesion to start from, relative to that of which the largest load would be
/// the pull-off load.
const SMALLEST_WORK: f64 = 1e-6;

/// The exponent of the speed of a contact line to start from, of elastomers.
const USUAL_EXPONENT: f64 = 0.5;

/// Why no start is found.
const NO_START: &str = "JKR finds no positive modulus in these data; check units and signs (loads \
     are positive in compression), and the stiffness of a cantilever, which is too small if the \
     force grows faster with the height than by this stiffness; free the zeros of the instrument that are \
     not known to be 0, such as contact-point and baseline; give the noise, which few points do not tell, and one that \
     is smaller than the loads; or give a start";

/// Asks whether the columns are exchanged, where loads grow much more slowly than contact radii.
fn exchanged(experiment: &Experiment) -> Option<String> {
    /// The power that tells, far below the 3 of Hertz, and the fewest points.
    const SLOW: f64 = 0.7;
    const FEWEST: usize = 5;
    let measurement = &experiment.measurement;
    let points = measurement.points.iter();
    let pressed = points.filter(|point| point.abscissa > 0.0 && point.ordinate > 0.0);
    let pairs = pressed.map(|point| [point.abscissa.ln(), point.ordinate.ln()]);
    let pairs: Vec<[f64; 2]> = pairs.collect();
    let means = [0, 1].map(|k| pairs.iter().map(|pair| pair[k]).sum::<f64>() / pairs.len() as f64);
    let sum = |k: usize| {
        let products = pairs
            .iter()
            .map(|pair| (pair[0] - means[0]) * (pair[k] - means[k]));
        products.sum::<f64>()
    };
    let power = sum(1) / sum(0);
    let is_slow = measurement.kind == Kind::LoadRadius && pairs.len() >= FEWEST && power < SLOW;
    (is_slow && power > 0.0).then(|| {
        format!(
            "the load grows as the power {power:.1} of the contact radius, and that of a contact as 3: are the columns \
             exchanged? "
        )
    })
}

/// How a start differs from the one that the data show first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Variation {
    /// Not at all.
    None,
    /// The start of a parameter is multiplied by a factor.
    Times(Parameter, f64),
    /// The thickness of the film is a multiple of the largest contact radius.
    Thickness(f64),
}

/// Gives the slots the starts that the data show, and returns the problem there.
pub(crate) fn problem<'a>(
    table: &'a Table,
    assigned: &[Assigned],
    slots: &[Slot],
    loss: Loss,
    variation: Variation,
) -> Result<Problem<'a>, Error> {
    let mut slots = slots.to_vec();
    let mut started = vec![false; slots.len()];
    for (e, one) in assigned.iter().enumerate() {
        let own = (0..slots.len()).filter(|&slot| slots[slot].is_of(e, &one.experiment));
        let own = own.map(|slot| (slots[slot].parameter, slot));
        let own: Vec<(Parameter, usize)> = own.collect();
        let mut at = one.clone();
        for &(parameter, slot) in &own {
            let coordinate = slots[slot].coordinate;
            at.experiment
                .replace(parameter, coordinate.value(coordinate.first()))?;
        }
        let is_own = |parameter: Parameter| own.iter().any(|one| one.0 == parameter);
        let unknown = own.iter().filter(|(_, slot)| !slots[*slot].is_given);
        let is_unknown = |parameter: Parameter| unknown.clone().any(|one| one.0 == parameter);
        let multiplied = match variation {
            Variation::Times(parameter, factor) if is_own(parameter) => Some((parameter, factor)),
            _ => None,
        };
        let matched = matched(is_unknown);
        // The modulus that is matched to the data is multiplied after that.
        let before = multiplied.filter(|(parameter, _)| matched != Some(*parameter));
        if let Some((parameter, factor)) = before
            && let Some(value) = at.experiment.get(parameter)
        {
            at.experiment.replace(parameter, factor * value)?;
        }
        let mut starts = Starts {
            table,
            at,
            is_unknown: &is_unknown,
            matched,
            given: Vec::new(),
        };
        relaxing_start::level(&mut starts)?;
        let is_stiffness = one.experiment.measurement.kind.is_stiffness();
        let found = if is_stiffness {
            None
        } else {
            let elastic = relaxing_start::elastic(&starts.at, level_is(&is_unknown))?;
            homogeneous(elastic.as_ref().unwrap_or(&starts.at), &is_unknown)
        };
        let needs_size = matches!(variation, Variation::Thickness(_));
        let is_needed = needs_size || unknown.clone().next().is_some();
        let largest = found.as_ref().map(|found| found.largest[0]);
        if let Variation::Thickness(part) = variation {
            let experiment = &mut starts.at.experiment;
            let largest = largest.unwrap_or_else(|| experiment.largest_radius());
            experiment.replace(Parameter::FilmThickness, part * largest)?;
        }
        let is_found = is_stiffness || found.is_some();
        match found {
            Some(found) => give_homogeneous(&mut starts, found)?,
            None if is_stiffness => indentation::give(&mut starts)?,
            // Each has a start that was given, or the law that fits best tells modulus and contact point.
            None => {}
        }
        relaxing_start::give(&mut starts)?;
        if !is_found && is_needed && starts.given.is_empty() {
            let exchanged = exchanged(&one.experiment).unwrap_or_default();
            return Err(one.experiment.not_fitted(format!("{exchanged}{NO_START}")));
        }
        if let Some((parameter, factor)) = multiplied
            && let Some(value) = starts.at.experiment.get(parameter)
        {
            let factor = if before.is_some() { 1.0 } else { factor };
            starts.give(parameter, factor * value)?;
        }
        if needs_size {
            starts.given.push(Parameter::FilmThickness);
        }
        let Starts { at, given, .. } = starts;
        for &(parameter, slot) in &own {
            let coordinate = slots[slot]
                .coordinate
                .with_unit(one.experiment.unit(parameter, &one.branches));
            let is_new = given.contains(&parameter) && !started[slot];
            let start = at.experiment.get(parameter).filter(|_| is_new);
            slots[slot].coordinate = match start {
                Some(value) => {
                    started[slot] = true;
                    coordinate.starting_from(value)
                }
                None => coordinate,
            };
        }
    }
    let names = assigned.iter().map(|one| &*one.experiment.measurement.name);
    let names = names.collect::<Vec<_>>().join(", ");
    Problem::new(table, assigned.to_vec(), slots, loss)
        .map_err(|cause| Error::at_start(names, cause))
}

/// Returns the modulus that is matched to the data, of those without a start: of two the sphere's.
fn matched(is_unknown: impl Fn(Parameter) -> bool) -> Option<Parameter> {
    let mut moduli = [Parameter::SphereModulus, Parameter::FilmModulus].into_iter();
    moduli.find(|&parameter| is_unknown(parameter))
}

/// Tells whether a fit of experiments finds the start of a free parameter in the data, so that the
/// value of the parameter in the experiments does not matter.
///
/// That is so for works of adhesion, zeros of the instrument, and one modulus of sphere or film:
/// where both are free, that of the sphere. Penetrations against contact radii tell no modulus.
pub fn starts_from_data(parameter: Parameter, experiments: &[Experiment], free: &[Free]) -> bool {
    let is_unknown = has_no_start(free);
    let has_loads = |one: &Experiment| one.measurement.kind != Kind::PenetrationRadius;
    match parameter {
        Parameter::SphereModulus | Parameter::FilmModulus => {
            matched(is_unknown) == Some(parameter) && experiments.iter().all(has_loads)
        }
        Parameter::FilmPoissonRatio
        | Parameter::FilmThickness
        | Parameter::Stiffness
        | Parameter::Layer(_, LayerQuantity::Modulus | LayerQuantity::Thickness) => false,
        // Without springs, the start is as stiff as the layer.
        Parameter::Layer(..) => true,
        _ => is_unknown(parameter),
    }
}

/// Gives the starts that a homogeneous contact shows.
fn give_homogeneous(starts: &mut Starts<'_>, found: Homogeneous) -> Result<(), Error> {
    use Parameter::{
        Baseline, BaselineSlope, ContactPoint, DoublingSpeed, LoadOffset, SpeedExponent,
        WorkOfAdhesion, WorkOfAdhesionReceding,
    };
    let sphere_radius = radius_of(&starts.at);
    let [radius, load, _] = found.largest;
    // Penetrations against radii tell the work of adhesion over the modulus only.
    let (scale, least) = match found.modulus {
        Some(_) => (1.0, load.abs() / sphere_radius),
        None => (
            compound(&starts.at.experiment, starts.table)?,
            radius * radius / sphere_radius,
        ),
    };
    let work = |work: f64| scale * work.max(SMALLEST_WORK * least);
    let level = found.level;
    starts.give_unknown(LoadOffset, level - starts.at.experiment.baseline)?;
    starts.give_unknown(Baseline, level - starts.at.experiment.load_offset)?;
    starts.give_unknown(BaselineSlope, found.slope)?;
    starts.give_unknown(ContactPoint, found.contact_point)?;
    starts.give_unknown(WorkOfAdhesion, work(found.work_of_adhesion))?;
    let receding = found.receding.unwrap_or(found.work_of_adhesion);
    starts.give_unknown(WorkOfAdhesionReceding, work(receding))?;
    if let Some(usual) = usual_speed(&starts.at.experiment.line_speeds) {
        starts.give_unknown(DoublingSpeed, usual)?;
        starts.give_unknown(SpeedExponent, USUAL_EXPONENT)?;
    }
    if let Some((parameter, compound)) = starts.matched.zip(found.modulus) {
        let experiment = &starts.at.experiment;
        let value = matching_modulus(starts.table, experiment, parameter, compound, found.largest);
        starts.give(parameter, value)?;
    }
    Ok(())
}

/// Returns a usual speed of a contact line that moves.
fn usual_speed(speeds: &[LineSpeed]) -> Option<f64> {
    let moving = speeds.iter().map(|one| one.speed.abs());
    let moving: Vec<f64> = moving.filter(|speed| *speed > 0.0).collect();
    (!moving.is_empty()).then(|| median(moving))
}

/// Returns the compound modulus of sphere and film, or of sphere and half-space.
fn compound(experiment: &Experiment, table: &Table) -> Result<f64, Error> {
    let name = &experiment.measurement.name;
    let contact = experiment.bodies.contact(table, &[]);
    let contact = contact.map_err(|cause| Error::at_start(name.clone(), cause))?;
    Ok(contact.mechanics().sphere_film_modulus())
}

/// Returns the modulus with which the contact has the load of a homogeneous contact at its largest
/// radius or penetration.
fn matching_modulus(
    table: &Table,
    experiment: &Experiment,
    parameter: Parameter,
    compound: f64,
    [radius, load, penetration]: [f64; 3],
) -> f64 {
    let bodies = &experiment.bodies;
    let other = if parameter == Parameter::SphereModulus {
        bodies.base().unwrap_or_else(|| bodies.film()).reduced()
    } else {
        bodies.sphere_modulus
    };
    let first = bodies.modulus_beside(parameter, compound, other);
    if bodies.are_half_space() {
        return first;
    }
    let excess = |logarithm: f64| -> Option<f64> {
        let mut bodies = bodies.clone();
        bodies.replace(parameter, logarithm.exp()).ok()?;
        let contact = bodies.contact(table, &[]).ok()?;
        let w = experiment.work_of_adhesion;
        let predicted = if experiment.measurement.kind == Kind::LoadRadius {
            contact.load(radius, w).ok()?
        } else {
            let equilibria = contact.equilibria(w, Control::Displacement).ok()?;
            equilibria.unloading(penetration).ok()?.load
        };
        Some(predicted - load)
    };
    root_of_modulus(first.ln(), excess).unwrap_or(first)
}
