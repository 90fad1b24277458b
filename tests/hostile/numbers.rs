//! Every public function is total on f64: it returns finite numbers or an error for any arguments,
//! and never panics.

use proptest::prelude::*;
use proptest::test_runner::TestRunner;

use crate::config;
use crate::functions::{FUNCTIONS, Function};

/// Generates any f64: numbers at the ends of arithmetic, any bits, any magnitude; and, more often,
/// numbers of the size that a contact may have.
fn any_number() -> impl Strategy<Value = f64> {
    let ends = [
        0.0,
        5e-324,
        1e-310,
        f64::MIN_POSITIVE,
        1e-154,
        1e-30,
        f64::EPSILON,
        0.25,
        0.5,
        1.0,
        1e30,
        1e154,
        f64::MAX,
    ];
    let ends: Vec<f64> = ends
        .into_iter()
        .chain([f64::INFINITY])
        .flat_map(|x| [x, -x])
        .chain([f64::NAN])
        .collect();
    let magnitude = |range: std::ops::Range<f64>| range.prop_map(|exponent| 10_f64.powf(exponent));
    prop_oneof![
        3 => prop::sample::select(ends),
        1 => any::<u64>().prop_map(f64::from_bits),
        2 => magnitude(-300.0..300.0),
        6 => magnitude(-9.0..9.0),
        4 => 0.0..=0.5,
    ]
}

/// Generates arguments: any numbers, or the valid ones of which one is replaced by any number.
fn arguments(valid: &'static [f64]) -> impl Strategy<Value = Vec<f64>> {
    let one = (0..valid.len(), any_number()).prop_map(|(i, number)| {
        let mut numbers = valid.to_vec();
        numbers[i] = number;
        numbers
    });
    prop_oneof![prop::collection::vec(any_number(), valid.len()), one]
}

/// Calls every function with `cases` lists of arguments.
fn attack(cases: u32) {
    let fails = |(name, valid, function): &Function| {
        let tested = TestRunner::new(config(cases)).run(&arguments(valid), |numbers| {
            let results = function(&numbers).unwrap_or_default();
            prop_assert!(
                results.iter().all(|number| number.is_finite()),
                "{results:?}"
            );
            Ok(())
        });
        Some(format!("{name}: {}", tested.err()?))
    };
    let failures: Vec<String> = FUNCTIONS.iter().filter_map(fails).collect();
    println!("{} {cases}", FUNCTIONS.len());
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn any_numbers_give_finite_results_or_an_error() {
    attack(400);
}

#[test]
#[ignore = "a recorded run: a million calls take minutes"]
fn a_million_lists_of_numbers_give_finite_results_or_an_error() {
    attack(30_000);
}

/// Without this the test above might only meet errors.
#[test]
fn valid_numbers_give_results() {
    let fails =
        |(name, valid, function): &Function| Some(format!("{name}: {}", function(valid).err()?));
    let failures: Vec<String> = FUNCTIONS.iter().filter_map(fails).collect();
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}
