//! The experiments of fits and forecasts, from the attributes of the Python class.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use fit::{
    Bodies, Direction, Experiment, Interrupt, Kind, Measurement, NamedLayer, Numbering, Point,
    PointErrors, Relaxing, Solver,
};
use numpy::PyReadonlyArray1;
use pyo3::prelude::*;

use crate::bodies::{NativeCoated, NativeHalfSpace};
use crate::error::{OrRaise as _, unknown};
use crate::history::{LawNumbers, law};
use crate::indentation::GivenIndentation;

/// An experiment, as the attributes of the Python class.
#[derive(FromPyObject)]
pub struct Given<'py> {
    name: String,
    kind: String,
    bodies: GivenBodies<'py>,
    abscissa: PyReadonlyArray1<'py, f64>,
    ordinate: PyReadonlyArray1<'py, f64>,
    retract: Option<PyReadonlyArray1<'py, bool>>,
    work_of_adhesion: f64,
    work_of_adhesion_receding: Option<f64>,
    doubling_speed: Option<f64>,
    speed_exponent: Option<f64>,
    load_offset: f64,
    contact_point: f64,
    baseline: f64,
    baseline_slope: f64,
    stiffness: Option<f64>,
    from_deflection: bool,
    noise: Option<GivenNoise<'py>>,
    abscissa_noise: GivenNoise<'py>,
    indentation: Option<GivenIndentation>,
    friction: String,
    sphere_poisson_ratio: f64,
    advancing: f64,
    time: Option<PyReadonlyArray1<'py, f64>>,
    law: Option<LawNumbers>,
    all_relax: bool,
}

/// A standard deviation, or one for each point.
#[derive(FromPyObject)]
enum GivenNoise<'py> {
    #[pyo3(transparent)]
    One(f64),
    #[pyo3(transparent)]
    Each(PyReadonlyArray1<'py, f64>),
}

impl GivenNoise<'_> {
    /// Returns the number, or the list of those of the points.
    fn read(&self) -> PyResult<(Option<f64>, Vec<f64>)> {
        Ok(match self {
            Self::One(noise) => (Some(*noise), Vec::new()),
            Self::Each(noises) => (None, noises.as_slice()?.to_vec()),
        })
    }
}

/// The bodies of an experiment.
#[derive(FromPyObject)]
enum GivenBodies<'py> {
    #[pyo3(transparent)]
    Coated(Bound<'py, NativeCoated>),
    #[pyo3(transparent)]
    HalfSpace(Bound<'py, NativeHalfSpace>),
}

/// Makes experiments, as [`one`].
pub fn all(
    py: Python<'_>,
    given: &[Given<'_>],
    frictionless: &Solver,
) -> PyResult<Vec<Experiment>> {
    let made = given.iter().map(|given| one(py, given, frictionless));
    made.collect()
}

/// Lets experiments make no further contact once a flag is set.
pub fn interrupt(experiments: &mut [Experiment], interrupted: &Arc<AtomicBool>) {
    for experiment in experiments {
        let interrupted = Arc::clone(interrupted);
        experiment.bodies.interrupt = Interrupt::when(move || interrupted.load(Ordering::Relaxed));
    }
}

/// Makes an experiment. The solver makes its contacts if they are on layers and do not stick.
pub fn one(py: Python<'_>, given: &Given<'_>, frictionless: &Solver) -> PyResult<Experiment> {
    let kind = Kind::of_name(&given.kind).ok_or_else(|| unknown("kind", &given.kind))?;
    let (x, y) = (given.abscissa.as_slice()?, given.ordinate.as_slice()?);
    let retract = given.retract.as_ref().map(|retract| retract.as_slice());
    let retract = retract.transpose()?;
    let directions = x.iter().enumerate().map(|(i, _)| {
        let is_retract = retract.and_then(|retract| retract.get(i));
        is_retract.map(|&retract| Direction::ALL[usize::from(retract)])
    });
    let points = x.iter().zip(y).zip(directions).enumerate();
    let points = points.map(|(i, ((&abscissa, &ordinate), direction))| Point {
        // Points are counted from 0, as the items of an array are.
        line: i as u64,
        abscissa,
        ordinate,
        direction,
    });
    let measurement = Measurement {
        name: given.name.clone(),
        kind,
        numbering: Numbering::Points,
        points: points.collect(),
    };
    let stick = match &*given.friction {
        "none" => None,
        "stick" => Some(Solver::Stick {
            sphere_poisson_ratio: given.sphere_poisson_ratio,
            advancing: given.advancing,
        }),
        other => return Err(unknown("friction", other)),
    };
    let bodies = match &given.bodies {
        GivenBodies::HalfSpace(half_space) => Bodies::half_space(half_space.get().0.clone()),
        GivenBodies::Coated(coated) => {
            let NativeCoated { system, named } = coated.get();
            let layers = match named {
                None if stick.is_none() => None,
                None => Some(NamedLayer::of_film(system)),
                Some(named) => Some(NamedLayer::all(&named.stack, &named.names).or_raise(py)?),
            };
            match layers {
                None => Bodies::coated(system),
                Some(layers) => Bodies {
                    layers,
                    solver: stick.unwrap_or_else(|| frictionless.clone()),
                    ..Bodies::bare(&measurement, system.without_film())
                },
            }
        }
    };
    let given_noise = given.noise.as_ref().map(GivenNoise::read).transpose()?;
    let (noise, of_ordinates) = given_noise.unwrap_or_default();
    let (abscissa_noise, of_abscissae) = given.abscissa_noise.read()?;
    let mut made = Experiment {
        work_of_adhesion: given.work_of_adhesion,
        work_of_adhesion_receding: given.work_of_adhesion_receding,
        doubling_speed: given.doubling_speed,
        speed_exponent: given.speed_exponent,
        load_offset: given.load_offset,
        contact_point: given.contact_point,
        baseline: given.baseline,
        baseline_slope: given.baseline_slope,
        stiffness: given.stiffness,
        from_deflection: given.from_deflection,
        noise,
        abscissa_noise: abscissa_noise.unwrap_or(0.0),
        errors: PointErrors {
            abscissa: of_abscissae,
            ordinate: of_ordinates,
        },
        ..Experiment::new(measurement, bodies)
    };
    if let Some(time) = &given.time {
        made.times = time.as_slice()?.to_vec();
    }
    if let Some(numbers) = &given.law {
        made.relaxing = Some(Relaxing {
            law: law(numbers.clone())?,
            all_bodies: given.all_relax,
        });
    }
    if let Some(indentation) = &given.indentation {
        indentation.complete(py, &mut made)?;
    }
    Ok(made)
}
