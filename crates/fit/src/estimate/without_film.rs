//! The same data without the film.

use interp::Table;

use super::minima::minimum::Minimum;
use super::problem::slot::Slot;
use super::problem::uncertainty::{Uncertainty, estimates};
use super::problem::{Ending, Problem};
use super::start::{self, Variation};
use crate::{Bodies, Loss, ModulusBias, Parameter, WithoutFilm};

/// The most evaluations over the number of parameters + 1.
const PATIENCE: usize = 40;
/// The relative changes at which the method stops, and those where bodies relax, where an evaluation
/// takes longer.
const TOLERANCE: f64 = 1e-6;
const COARSER: f64 = 1e-4;

/// Fits the half-space that remains without the film; `None` where there is no film, where nothing is left to be
/// fitted, or where the half-space has no fit.
pub(crate) fn without_film<'a>(
    table: &'a Table,
    with_film: &Minimum<'_>,
    loss: Loss,
) -> Option<(WithoutFilm, Problem<'a>)> {
    let problem = &with_film.problem;
    let tops = problem.experiments().map(|one| one.bodies.modulus_of_top());
    let mut moduli = std::iter::once(Parameter::SphereModulus).chain(tops);
    let modulus = moduli.find(|&parameter| problem.slot_of(parameter).is_some());
    // The modulus of the film, or of the top layer, is then that of the half-space.
    let of_film = modulus.filter(|&parameter| parameter != Parameter::SphereModulus);
    let mut assigned = problem.assigned.clone();
    for one in &mut assigned {
        let bodies = &one.experiment.bodies;
        let base = bodies.base()?;
        if bodies.thickness().is_none() {
            // A bare reference sample has no film to be left out.
            continue;
        }
        let half_space = bodies.on(of_film.map_or(base, |_| bodies.film()));
        half_space.compound_modulus().ok()?;
        one.experiment.bodies = Bodies::half_space(half_space);
    }
    let kept = |parameter: Parameter| {
        Some(parameter) == of_film
            || parameter == Parameter::SphereModulus
            || !parameter.is_of_bodies()
    };
    let renamed = |parameter: Parameter| {
        if Some(parameter) == of_film {
            Parameter::FilmModulus
        } else {
            parameter
        }
    };
    // Bounds and priors are those of the film; the start follows from the data, but that of a
    // relaxation function from the one with the film.
    let own = |(i, slot): (usize, &Slot)| Slot {
        parameter: renamed(slot.parameter),
        is_given: matches!(slot.parameter, Parameter::Law(_)),
        ..slot.without_limits(problem.value(i))
    };
    let slots = problem.slots.iter().enumerate();
    let slots = slots.filter(|(_, slot)| kept(slot.parameter));
    let slots: Vec<Slot> = slots.map(own).collect();
    if slots.is_empty() {
        return None;
    }
    let started = start::problem(table, &assigned, &slots, loss, Variation::None).ok()?;
    let relaxing = assigned.iter().any(|one| one.experiment.relaxing.is_some());
    let tolerance = if relaxing { COARSER } else { TOLERANCE };
    let fitted = started.minimise(PATIENCE, tolerance);
    if fitted.ending == Ending::Failed {
        return None;
    }
    let uncertainty = Uncertainty::of(&fitted);
    let chi_squared = fitted.plain_residuals()?.norm_squared();
    let estimates = estimates(&fitted, uncertainty.as_ref());
    let modulus = modulus.and_then(|parameter| {
        let with = problem.slot_of(parameter)?;
        let value = problem.value(with);
        let error = with_film.uncertainty.as_ref()?.error(with);
        // A fit that ran away does not tell its modulus.
        let without = estimates
            .iter()
            .find(|one| one.parameter == renamed(parameter) && one.standard_error < one.value)?;
        let without = without.value;
        Some(ModulusBias {
            parameter,
            relative: without / value - 1.0,
            standard_errors: (without - value) / error,
        })
    });
    let result = WithoutFilm {
        estimates,
        chi_squared,
        modulus,
    };
    Some((result, fitted))
}
