//! What the library makes of bytes and numbers that nobody should give it.

mod functions;
mod numbers;
mod packed;
mod physics;
mod tables;

use proptest::test_runner::{Config, RngSeed};

/// The same cases in every run; the fuzzer looks for others.
fn config(cases: u32) -> Config {
    Config {
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(1),
        ..Config::with_cases(cases)
    }
}
