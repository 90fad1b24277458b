//! The doubts about a result: each file has one kind of them, and `warnings` lists them all.

pub(super) mod agreement;
pub(super) mod assumptions;
pub(super) mod calibration;
pub(super) mod cycle;
pub(super) mod detector;
mod files_apart;
pub(super) mod friction;
pub(super) mod hold;
pub(super) mod indentation;
pub(super) mod interfaces;
mod line_law;
pub(super) mod lost_radii;
mod pinned;
pub(super) mod prior;
pub(super) mod radius_noise;
pub(super) mod shape;
pub(super) mod shared_noise;
pub(super) mod table_error;
pub(super) mod twice;
pub(super) mod unequal_noise;
mod unfitted_pull;
mod unseen_pull;
pub(super) mod unseen_zero;
pub(super) mod wanted;
mod warnings;

pub(super) use self::warnings::*;
