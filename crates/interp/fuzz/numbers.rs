//! Numbers: the first byte chooses a public function, the others are the bits of its arguments.

#![no_main]

use functions::FUNCTIONS;
use libfuzzer_sys::fuzz_target;

#[path = "../tests/hostile/functions.rs"]
mod functions;
#[allow(dead_code, reason = "of the tables, the test makes more use")]
#[path = "../tests/hostile/tables.rs"]
mod tables;

fuzz_target!(|input: &[u8]| {
    let Some((first, bytes)) = input.split_first() else { return };
    let (name, sound, function) = FUNCTIONS[usize::from(*first) % FUNCTIONS.len()];
    let mut numbers = sound.to_vec();
    numbers.iter_mut().zip(bytes.as_chunks().0).for_each(|(number, bits)| *number = f64::from_le_bytes(*bits));
    let answer = function(&numbers).unwrap_or_default();
    assert!(answer.iter().all(|number| number.is_finite()), "{name}: {answer:?}");
});
