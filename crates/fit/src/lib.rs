//! Moduli and work of adhesion from measured contacts of a sphere on a coated substrate.
//!
//! An [`Experiment`] is a [`Measurement`] with what is known about it: the bodies, the work of
//! adhesion, the zeros of the instrument. [`fit`] finds the parameters that are [`Free`], by
//! Levenberg and Marquardt's method with the exact derivatives of the crate `interp` (central
//! differences on a stack of layers, [`Solver`], of contact stiffnesses, and beyond the nodes of the
//! table in `a/t`), and returns a [`Fit`]: estimates with standard errors, what the data do not determine, the same data without the film, and warnings. All units
//! are SI. Loads are positive in compression.
//!
//! ```
//! use fit::{Bodies, Experiment, Free, Kind, Measurement, Numbering, Options, Parameter, Point};
//! use interp::{Elastic, System, Table, Probe};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let system = System {
//!     probe: Probe::Paraboloid { radius: 1e-3 },
//!     sphere_modulus: 2e6,
//!     film: Elastic::new(3.5e6, 0.5)?,
//!     film_thickness: 1e-5,
//!     substrate: Elastic::new(2e11, 0.25)?,
//! };
//! // Contact radii (m) and loads (N). A real program reads them from a file.
//! let loads = [-1.909e-4, -1.016e-4, 3.12e-4, 1.179e-3];
//! let point = |i: usize| Point {
//!     line: i as u64 + 1,
//!     abscissa: [40e-6, 60e-6, 80e-6, 100e-6][i],
//!     ordinate: loads[i],
//!     direction: None,
//! };
//! let measurement = Measurement {
//!     name: "lens.csv".into(),
//!     kind: Kind::LoadRadius,
//!     numbering: Numbering::Lines,
//!     points: (0..4).map(point).collect(),
//! };
//! let experiment = Experiment::new(measurement, Bodies::coated(&system));
//! let free = [Free::new(Parameter::SphereModulus), Free::new(Parameter::WorkOfAdhesion)];
//! let found = fit::fit(Table::embedded(), &[experiment], &free, &Options::default())?;
//! let modulus = found.estimate(Parameter::SphereModulus).expect("it is free");
//! assert!((modulus.value / 2e6 - 1.0).abs() < 0.02);
//! # Ok(()) }
//! ```
//!
//! The README tells what can be measured and fitted, and what the result holds.

#![forbid(unsafe_code)]

#[macro_use(named)]
extern crate contact;

pub mod data;
mod error;
mod estimate;
mod magnitude;
mod model;
pub mod report;
mod statistics;

pub use error::{Error, Undetermined};
pub use estimate::{
    Combination, Estimate, Fit, FittedExperiment, FittedPoint, FittedRelaxation, FixedValue,
    Forecast, LeftOut, LeftOutReason, Likelihood, ModulusBias, Warning, WarningKind, WithoutFilm,
    fit, forecast, starts_from_data,
};
pub use model::{
    AreaFunction, Bodies, Branch, ContactDepth, Direction, Experiment, Fixed, Free, Indentation,
    Interrupt, Kind, Known, LayerName, LayerQuantity, LineSpeed, Loss, LossAngle,
    MOST_COEFFICIENTS, Measurement, NamedLayer, Numbering, Options, Parameter, Point, PointErrors,
    Prediction, Prior, Reach, Relaxing, Scale, Scope, Solver, simulate,
};
