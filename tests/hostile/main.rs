//! Tests of the library with hostile bytes and arbitrary numbers.
//!
//! `packed` forges packed tables by hand and `forged` at random, `numbers` gives any f64 to the
//! public functions that `functions` lists, with the longer `calls` apart, `physics` tests
//! properties of the results, and `tables` makes the small tables for them.

mod calls;
mod forged;
mod functions;
mod numbers;
mod packed;
mod physics;
mod tables;

use proptest::test_runner::{Config, RngSeed};

/// Returns a configuration with a fixed seed, so that each run tests equal cases. The fuzzer looks
/// for others.
fn config(cases: u32) -> Config {
    Config {
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(1),
        ..Config::with_cases(cases)
    }
}
