//! Finding the parameters, their uncertainty, and what the data do not tell.
//!
//! `solve` leads from the data to the result: `start` finds where the method starts, `problem` is the least-squares problem,
//! and `minima` finds the best minimum. `without_film` is the fit of JKR, `left_out` the points that do not count, `relaxing`
//! tells what a fit of bodies that relax finds, `fixed_values` what the values taken as given do, and `warnings` lists the
//! doubts. `forecast` tells the errors of a planned experiment, `likelihood` is for samplers. `result` holds what comes out.

mod fixed_values;
mod forecast;
mod left_out;
mod likelihood;
mod minima;
mod problem;
mod relaxing;
mod result;
mod solve;
mod start;
mod warnings;
mod without_film;

pub use fixed_values::FixedValue;
pub use forecast::forecast;
pub(crate) use left_out::text as left_out_text;
pub use likelihood::Likelihood;
pub(crate) use problem::uncertainty::UNDETERMINED;
pub use result::{
    Combination, Estimate, Fit, FittedExperiment, FittedPoint, FittedRelaxation, Forecast, LeftOut,
    LeftOutReason, ModulusBias, Warning, WarningKind, WithoutFilm,
};
pub use solve::fit;
pub use start::starts_from_data;
