//! Reading measurements from columns of text.
//!
//! [`read`] takes any usual table of numbers: cells between tabs, semicolons, commas or spaces, a
//! decimal point or comma, quotes, comment lines that begin with `#`, `%` or `//`, lines of any
//! text before the headings, and a line of units below them. Columns are recognised by their
//! headings and units, `Force [mN]`, `Radius (um)`, `height_nm`, `Piezo/nm`, or named by the user
//! as a [`Column`]. A heading without a unit is an error, except for the names in SI units that
//! `tabulate` and the Python package afmformats write. Two columns of one quantity, as in
//! `Extend Force(nN)` and `Retract Force(nN)`, are the two directions.
//!
//! Below the first rows there may be further headings with columns of their own, as in exports of
//! JPK, where each segment has them. What the head of a file names of the cantilever, `springConstant:
//! 0.02`, is used where the [`Format`] leaves it open.
//!
//! A column of standard deviations has the heading of its quantity and `error`, `std`, `sd`, `sigma`
//! or `uncertainty`: `radius_error [um]`, `load error [mN]`, `sigma_F`; without a unit it has that of
//! its quantity. A heading `std`, `sd`, `sigma`, `uncertainty`, `standard error` or
//! `standard deviation` alone is that of the ordinate. Percentages are not read.
//!
//! `lines` reads the lines, `head` what they tell of the cantilever, `layout` finds the rows and
//! their headings, `cells` and `number` read a row, `heading` and `names` read a heading.
//! `source` finds the column of a quantity, `deviation` that of
//! its standard deviations and `beside` those of a contact stiffness, and `assignment` decides by them
//! what is measured. `rows` reads the rows, `row` the points of one, `segment` finds their directions, `points` joins and checks
//! their points, `sign`, `tilt`, `turns` and `doubt` tell what seems wrong with them, and `remedy` tells what a
//! user can give where a file is not read.

mod assignment;
mod beside;
mod cells;
mod column;
mod deviation;
mod doubt;
mod failure;
mod head;
mod heading;
mod layout;
mod lines;
mod names;
mod number;
mod points;
mod reading;
mod remedy;
mod row;
mod rows;
mod segment;
mod sign;
mod source;
mod tilt;
mod turns;

pub use self::reading::{Cantilever, Format, Notes, Reading, Segments, read, read_from};
pub use assignment::roles;
pub use column::{Column, Role};
pub use doubt::{Doubt, DoubtKind, opposite_sense};
pub use failure::DataError;
pub use head::{Head, HeadValue, SENSITIVITIES};
pub use heading::Reduced;
pub use number::Marks;
pub use remedy::{Named, Remedy};
pub use segment::Split;
pub use source::Source;
