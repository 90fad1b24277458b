//! The same data without the film.

use interp::{HalfSpace, Table};

use super::minima::Minimum;
use super::problem::{Ending, Problem};
use super::slot::Slot;
use super::start::{self, Variation};
use super::uncertainty::{Uncertainty, estimates};
use crate::model::of_law;
use crate::{Bodies, Branch, Free, Loss, ModulusBias, Parameter, WithoutFilm};

/// The most evaluations over the number of parameters + 1.
const PATIENCE: usize = 40;
/// The relative changes at which the method stops, and those where bodies relax, where an evaluation
/// takes longer.
const TOLERANCE: f64 = 1e-6;
const COARSER: f64 = 1e-4;

/// Fits the half-space that remains without the film. Returns the ordinates that it predicts, too, of each
/// point of each experiment that counts; `None` where there is no film, where nothing
/// is left to be fitted, or where the half-space has no fit.
pub(crate) fn without_film(
    table: &Table,
    with_film: &Minimum<'_>,
    free: &[Free],
    loss: Loss,
) -> Option<(WithoutFilm, Vec<Vec<Option<f64>>>)> {
    let is_free = |parameter| free.iter().any(|one| one.parameter == parameter);
    let problem = &with_film.problem;
    let moduli = [Parameter::SphereModulus, Parameter::FilmModulus];
    let experiments = problem.assigned.iter().map(|one| &one.experiment);
    let of_tops = experiments.filter_map(|one| one.bodies.top_name());
    let modulus = moduli
        .into_iter()
        .chain(of_tops.map(Parameter::LayerModulus))
        .find(|&parameter| is_free(parameter));
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
        let half_space = HalfSpace {
            probe: bodies.probe().clone(),
            sphere_modulus: bodies.sphere_modulus(),
            solid: of_film.map_or(base, |_| bodies.film()),
        };
        half_space.compound_modulus().ok()?;
        one.experiment.bodies = Bodies::HalfSpace(half_space);
    }
    let kept = |parameter: Parameter| {
        Some(parameter) == of_film
            || parameter == Parameter::SphereModulus
            || !parameter.is_of_bodies()
    };
    let law = |parameter: Parameter| {
        let mut slots = problem.slots.iter();
        let slot = slots.position(|slot| slot.parameter == parameter)?;
        of_law(parameter).map(|_| problem.value(slot))
    };
    let renamed = |parameter: Parameter| {
        if Some(parameter) == of_film {
            Parameter::FilmModulus
        } else {
            parameter
        }
    };
    let free: Vec<Free> = free
        .iter()
        .filter(|one| kept(one.parameter))
        // Bounds and priors are those of the film; the start follows from the data, but that of a
        // relaxation function from the one with the film.
        .map(|one| Free {
            bounds: None,
            prior: None,
            start: law(one.parameter),
            parameter: renamed(one.parameter),
            ..*one
        })
        .collect();
    let slots: Vec<_> = problem
        .slots
        .iter()
        .enumerate()
        .filter(|(_, slot)| kept(slot.parameter))
        .map(|(i, slot)| Slot {
            parameter: renamed(slot.parameter),
            ..slot.without_limits(problem.value(i))
        })
        .collect();
    if slots.is_empty() {
        return None;
    }
    let started = start::problem(table, &assigned, (&free, &slots), loss, Variation::None).ok()?;
    let relaxing = assigned.iter().any(|one| one.experiment.relaxing.is_some());
    let tolerance = if relaxing { COARSER } else { TOLERANCE };
    let (fitted, ending) = started.minimise(PATIENCE, tolerance);
    if ending == Ending::Failed {
        return None;
    }
    let uncertainty = Uncertainty::of(&fitted);
    let chi_squared = fitted.plain_residuals()?.norm_squared();
    let estimates = estimates(&fitted, uncertainty.as_ref());
    let modulus = modulus.and_then(|parameter| {
        let with = problem
            .slots
            .iter()
            .position(|slot| slot.parameter == parameter)?;
        let value = problem.value(with);
        let uncertainty = with_film.uncertainty.as_ref()?;
        let error = uncertainty.relative_error(with) * uncertainty.sizes[with];
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
    Some((result, predictions(&fitted)))
}

/// Returns the ordinates at the points that count.
fn predictions(fitted: &Problem<'_>) -> Vec<Vec<Option<f64>>> {
    let of_experiment = |e: usize| {
        let counts = |branch: &Branch| *branch != Branch::LeftOut;
        let values = fitted.predicted.as_ref().map(|all| &all[e].values);
        let branches = fitted.assigned[e].branches.iter().enumerate();
        branches
            .map(|(i, branch)| {
                values
                    .filter(|_| counts(branch))
                    .map(|values| fitted.assigned[e].experiment.ordinate_of(values[i]))
                    .filter(|value| value.is_finite())
            })
            .collect()
    };
    (0..fitted.assigned.len()).map(of_experiment).collect()
}
