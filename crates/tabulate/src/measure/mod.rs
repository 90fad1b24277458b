//! Measurements that make tables, as rows of the crate `cost`: [`table()`] and [`effects()`].
//!
//! `made` makes a table to be measured, `limits` ends a series of tables, `rows` reads rows from files.

mod effects;
mod limits;
mod made;
mod rows;
mod table;

pub use effects::measure as effects;
pub use made::Made;
pub use rows::read_csv;
#[cfg(test)]
pub(crate) use rows::rows;
pub use table::measure as table;
