//! The result of a fit for people, as text.
//!
//! [`report`] is what `tabulate fit` prints, and what Python's `print(fit(...))` shows;
//! [`expected`] is the same for the errors of a planned experiment. `unit` chooses units and
//! digits, `name` writes the names of values, `agreement` says how well the fit agrees with the data, `fixed_values` what the values taken as
//! given do, `line_speed` the adhesion over the speed of contact lines, and [`jkr_plot`] returns the points of the reduced JKR plot.

mod agreement;
mod contact_radii;
mod fixed_values;
mod indentation;
mod jkr_plot;
mod line_speed;
mod name;
mod relaxing;
mod text;
mod unit;

pub use self::contact_radii::a_over_t;
pub use self::jkr_plot::{JkrPlotPoint, jkr_plot};
pub use self::line_speed::{LinePlot, line_plot, line_speeds};
pub use self::text::{expected, reading, report};
pub use self::unit::UnitOf;
