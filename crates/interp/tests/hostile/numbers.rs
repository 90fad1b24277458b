//! Every public function is total on f64: whatever it is asked, it answers with finite numbers or
//! an error, never a panic.

use proptest::prelude::*;
use proptest::test_runner::TestRunner;

use crate::config;
use crate::functions::{FUNCTIONS, Function};

/// Any f64 at all: those at the ends of arithmetic, any bits, any magnitude; and, more often, such
/// as a contact may have.
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

/// All of them any numbers, or all but one those that are answered.
fn arguments(sound: &'static [f64]) -> impl Strategy<Value = Vec<f64>> {
    let one = (0..sound.len(), any_number()).prop_map(|(i, number)| {
        let mut numbers = sound.to_vec();
        numbers[i] = number;
        numbers
    });
    prop_oneof![prop::collection::vec(any_number(), sound.len()), one]
}

#[test]
fn any_numbers_are_answered_with_finite_ones_or_an_error() {
    let fails = |(name, sound, function): &Function| {
        let answered = TestRunner::new(config(1000)).run(&arguments(sound), |numbers| {
            let answer = function(&numbers).unwrap_or_default();
            prop_assert!(answer.iter().all(|number| number.is_finite()), "{answer:?}");
            Ok(())
        });
        Some(format!("{name}: {}", answered.err()?))
    };
    let failures: Vec<String> = FUNCTIONS.iter().filter_map(fails).collect();
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

/// Or nothing would be asked of the answers.
#[test]
fn sound_numbers_are_answered() {
    let fails =
        |(name, sound, function): &Function| Some(format!("{name}: {}", function(sound).err()?));
    let failures: Vec<String> = FUNCTIONS.iter().filter_map(fails).collect();
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}
