//! The minima that several starts lead to.
//!
//! `search` leads from each start to its `minimum`, with the `noise` estimated there, `valley` looks for others, and `minima`
//! compares them. `profile` gives intervals without linearisation.

mod minima;
pub(super) mod minimum;
pub(super) mod noise;
pub(super) mod profile;
pub(super) mod search;
pub(super) mod valley;

pub(super) use self::minima::*;
