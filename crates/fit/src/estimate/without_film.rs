//! The same data without the film.

use interp::{HalfSpace, Table};

use super::minima::Minimum;
use super::problem::{Ending, Problem};
use super::solve::estimates;
use super::start::{self, Variation};
use super::uncertainty::Uncertainty;
use crate::{Bodies, Branch, Free, Loss, ModulusBias, Parameter, WithoutFilm};

/// The most evaluations over the number of parameters + 1.
const PATIENCE: usize = 40;
/// The relative changes at which the method stops.
const TOLERANCE: f64 = 1e-6;

/// The fit without the film.
pub(crate) struct Found {
    pub result: WithoutFilm,
    /// The ordinates that it predicts, of each point of each experiment that counts.
    pub predictions: Vec<Vec<Option<f64>>>,
}

/// Fits the half-space that remains without the film; `None` where there is no film, where nothing
/// is left to be fitted, or where the half-space has no fit.
pub(crate) fn without_film(
    table: &Table,
    with_film: &Minimum<'_>,
    free: &[Free],
    loss: Loss,
) -> Option<Found> {
    let is_free = |parameter| free.iter().any(|one| one.parameter == parameter);
    let modulus = [Parameter::SphereModulus, Parameter::FilmModulus]
        .into_iter()
        .find(|&parameter| is_free(parameter));
    let of_film = modulus == Some(Parameter::FilmModulus);
    let problem = &with_film.problem;
    let mut assigned = problem.assigned.clone();
    for one in &mut assigned {
        let half_space = match &one.experiment.bodies {
            Bodies::Coated(system) if of_film => HalfSpace {
                solid: system.film,
                ..system.without_film()
            },
            Bodies::Coated(system) => system.without_film(),
            // A bare reference sample has no film to be left out.
            Bodies::Layered(layered) if layered.layers.is_empty() => continue,
            Bodies::Layered(layered) => HalfSpace {
                probe: layered.probe.clone(),
                sphere_modulus: layered.sphere_modulus,
                solid: layered.base,
            },
            Bodies::HalfSpace(_) => return None,
        };
        half_space.compound_modulus().ok()?;
        one.experiment.bodies = Bodies::HalfSpace(half_space);
    }
    let kept = |parameter: Parameter| match parameter {
        Parameter::FilmModulus => of_film,
        Parameter::FilmThickness | Parameter::FilmPoissonRatio => false,
        Parameter::LayerModulus(_) | Parameter::LayerThickness(_) => false,
        _ => true,
    };
    let free: Vec<Free> = free
        .iter()
        .filter(|one| kept(one.parameter))
        // Bounds and priors are those of the film; the start follows from the data.
        .map(|one| Free {
            bounds: None,
            prior: None,
            start: None,
            ..*one
        })
        .collect();
    let slots: Vec<_> = problem
        .slots
        .iter()
        .enumerate()
        .filter(|(_, slot)| kept(slot.parameter))
        .map(|(i, slot)| slot.without_limits(problem.value(i)))
        .collect();
    if slots.is_empty() {
        return None;
    }
    let started = start::problem(table, &assigned, (&free, &slots), loss, Variation::None).ok()?;
    let (fitted, ending) = started.minimise(PATIENCE, TOLERANCE);
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
        let without = estimates
            .iter()
            .find(|one| one.parameter == parameter)?
            .value;
        Some(ModulusBias {
            parameter,
            relative: without / value - 1.0,
            standard_errors: (without - value) / error,
        })
    });
    Some(Found {
        predictions: predictions(&fitted),
        result: WithoutFilm {
            estimates,
            chi_squared,
            modulus,
        },
    })
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
