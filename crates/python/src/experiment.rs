//! The experiments of fits and forecasts, from the attributes of the Python class.

use fit::{
    Bodies, Direction, Experiment, Kind, Measurement, NamedLayer, Numbering, Point, PointErrors,
    Relaxing, Solver,
};
use interp::System;
use numpy::PyReadonlyArray1;
use pyo3::prelude::*;

use crate::bodies::{NativeHalfSpace, NativeStackSystem, NativeSystem};
use crate::contacts_on_layers::{ContactsOnLayers, stick};
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
    Coated(Bound<'py, NativeSystem>),
    #[pyo3(transparent)]
    HalfSpace(Bound<'py, NativeHalfSpace>),
    #[pyo3(transparent)]
    Layered(Bound<'py, NativeStackSystem>),
}

/// Makes experiments; the `solvers` make their contacts if they are on layers or stick.
pub fn all(
    py: Python<'_>,
    given: &[Given<'_>],
    solvers: &ContactsOnLayers,
) -> PyResult<Vec<Experiment>> {
    given.iter().map(|given| one(py, given, solvers)).collect()
}

/// Makes an experiment; one of the `solvers` makes its contacts if they are on layers or stick.
pub fn one(py: Python<'_>, given: &Given<'_>, solvers: &ContactsOnLayers) -> PyResult<Experiment> {
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
    let stick = stick(&given.friction, given.sphere_poisson_ratio, given.advancing)?;
    let bodies = match &given.bodies {
        GivenBodies::Coated(system) if stick.is_some() => {
            let system = &system.get().0;
            let layers = NamedLayer::of_film(system);
            layered(system, layers, &measurement, stick, solvers)
        }
        GivenBodies::Coated(system) => Bodies::coated(&system.get().0),
        GivenBodies::HalfSpace(half_space) => Bodies::half_space(half_space.get().0.clone()),
        GivenBodies::Layered(layers) => {
            let NativeStackSystem { named, system } = layers.get();
            let layers = NamedLayer::all(&named.stack, &named.names).or_raise(py)?;
            layered(system, layers, &measurement, stick, solvers)
        }
    };
    let given_noise = given.noise.as_ref().map(GivenNoise::read).transpose()?;
    let (noise, of_ordinates) = given_noise.unwrap_or_default();
    let (abscissa_noise, of_abscissae) = given.abscissa_noise.read()?;
    let mut made = Experiment {
        work_of_adhesion: given.work_of_adhesion,
        work_of_adhesion_receding: given.work_of_adhesion_receding,
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

/// Makes the layers of an experiment, whose contacts are made with full friction by `stick`, or
/// without friction.
fn layered(
    system: &System,
    layers: Vec<NamedLayer>,
    measurement: &Measurement,
    stick: Option<Solver>,
    solvers: &ContactsOnLayers,
) -> Bodies {
    Bodies {
        layers,
        solver: stick.unwrap_or_else(|| solvers.frictionless.clone()),
        interrupt: solvers.interrupt(),
        ..Bodies::bare(measurement, system.without_film())
    }
}
