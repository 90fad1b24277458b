//! The table: quantities at nodes of four parameters, the files it lies in, and the lookup of one
//! material's curve.
//!
//! A [`Table`] holds `axes`, a `description` with its `certificate`, and values or a `low_rank`
//! form, read by `packed` or `hdf5` (whose names are in [`schema`]) or compiled in (`embedded`). At
//! the first lookup it becomes a `tensor_spline`, dense or a `tensor_train`, whose sums are those
//! of `weighted_sum` and `mixed_precision`; `lookup` makes the [`Curve`](crate::Curve) of a
//! material from it.

pub(crate) mod axes;
mod certificate;
mod description;
#[cfg(feature = "embedded")]
mod embedded;
#[cfg(feature = "hdf5")]
mod hdf5;
mod lookup;
pub(crate) mod low_rank;
mod mixed_precision;
mod packed;
pub mod schema;
mod table;
mod tensor_spline;
mod tensor_train;
mod weighted_sum;

pub use certificate::Certificate;
pub use description::Description;
pub use low_rank::LowRank;
pub use packed::is_packed;
pub use table::Table;
