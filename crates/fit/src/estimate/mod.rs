//! Finding the parameters, their uncertainty, and what the data do not tell.
//!
//! `solve` leads from the data to the result. `slot` lists the values to be found and their
//! coordinates, `jkr`, `starts` and `start` find where the method starts, `assigned` is an experiment with the
//! branches of its points, `few` the points that count at first, `problem` the least-squares problem with its `loss`,
//! `minimise` its minimisation, and `blocks` decomposes the derivatives of many experiments. `minima`
//! compares the minima (`minimum`) that several starts lead to, `basin` tells which of them lead to a known one,
//! `valley` looks for others, and `search` leads to each of them. `uncertainty` gives the errors there,
//! `profile` intervals without linearisation, `without_film` the fit of JKR, `left_out` the points that
//! do not count, `noise` estimates the noise, `warnings` lists the doubts, with `agreement`,
//! `detector`, `prior`, `wanted`, `cycle`, `hold`, `no_adhesion` and `interfaces`.
//! `relaxing_start` is the start where bodies relax, and `relaxing` what such a fit tells.
//! `fixed_values` tells what the values taken as given do. `forecast` tells the errors of a planned
//! experiment, `likelihood` is for samplers. `result` holds what comes out.

mod agreement;
mod assigned;
mod assumptions;
mod basin;
mod blocks;
mod cycle;
mod detector;
mod few;
mod fixed_values;
mod forecast;
mod friction;
mod hold;
mod indentation;
mod interfaces;
mod jkr;
mod left_out;
mod likelihood;
mod loss;
mod minima;
mod minimise;
mod minimum;
mod no_adhesion;
mod noise;
mod prior;
mod problem;
mod profile;
mod relaxing;
mod relaxing_start;
mod result;
mod search;
mod shared_noise;
mod slot;
mod solve;
mod start;
mod starts;
mod table_error;
mod twice;
mod uncertainty;
mod unequal_noise;
mod unseen_zero;
mod valley;
mod wanted;
mod warnings;
mod without_film;

pub use forecast::forecast;
pub(crate) use left_out::text as left_out_text;
pub use likelihood::Likelihood;
pub use result::{
    Combination, Estimate, Fit, FittedExperiment, FittedPoint, FittedRelaxation, FixedValue,
    Forecast, LeftOut, LeftOutReason, ModulusBias, Warning, WarningKind, WithoutFilm,
};
pub use solve::fit;
pub use start::starts_from_data;
