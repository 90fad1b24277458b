//! Support for the acceptance tests: reference data, random contacts, small tables, measures of
//! error, and the program under test with a folder to work in. A helper panics where it cannot do
//! what it says: the test fails.

#![forbid(unsafe_code)]

mod contacts;
mod data;
mod differences;
mod error;
mod forgery;
mod material;
mod printed;
mod python;
mod refusals;
mod shapes;
mod stacks;
mod tables;
mod workdir;

pub use contacts::Contacts;
pub use data::{Case, Data};
pub use differences::{derivatives, direct, simpson, slopes};
pub use error::{
    TRUTH, all_bits, assert_close, assert_near, bits, error_at, larger, relative, relative_error,
    relative_errors,
};
pub use forgery::{Checked, change, with_payload};
pub use material::{
    half_space_of, looked_up, material, on_half_space, paper_system, rigid_probe, rigid_sphere,
    solved, solved_contact, system_of,
};
pub use printed::{assert_estimate, estimate, json, kinds, number, value};
pub use python::{output, python};
pub use refusals::{Refused, Words, assert_cases, assert_names, rows};
pub use shapes::{flat_ended_cone, modified_power_law, power_law, prony, rounded_cone};
pub use stacks::{layer, random_stack, solid, springs, stack, with_interfaces};
pub use tables::{BOX, RIGID_SPHERE, ends, forged, low_rank, shipped, table, write_hdf5};
pub use workdir::{Run, Workdir, arguments, nothing_starts, start};

/// Returns `count + 1` numbers from `from` to `to`, evenly spaced in the logarithm.
pub fn geometric([from, to]: [f64; 2], count: u32) -> impl Iterator<Item = f64> {
    (0..=count)
        .map(move |i| (from * (to / from).powf(f64::from(i) / f64::from(count))).clamp(from, to))
}

/// Returns the number of random cases of a search: `default`, or that of the environment variable
/// `SEARCH_CASES`.
pub fn cases(default: u64) -> u64 {
    std::env::var("SEARCH_CASES").map_or(default, |text| text.parse().expect("a number"))
}
