//! Finding the parameters.

mod forecast;
mod result;
mod solve;

pub use forecast::forecast;
pub use result::{
    Combination, Estimate, Fit, FittedExperiment, FittedPoint, Forecast, ModulusBias, Warning,
    WarningKind, WithoutFilm,
};
pub use solve::fit;
