//! Fuzzes the public functions with numbers. The first byte chooses a function, the other bytes are
//! the bits of its arguments. The result must be an error or finite numbers.

#![no_main]

use functions::FUNCTIONS;
use libfuzzer_sys::fuzz_target;

#[path = "../../../tests/hostile/calls.rs"]
mod calls;
#[path = "../../../tests/hostile/functions.rs"]
mod functions;
#[allow(dead_code, reason = "the test uses more of these tables")]
#[path = "../../../tests/hostile/tables.rs"]
mod tables;

fuzz_target!(|input: &[u8]| {
    let Some((first, bytes)) = input.split_first() else {
        return;
    };
    let (name, valid, function) = FUNCTIONS[usize::from(*first) % FUNCTIONS.len()];
    let mut numbers = valid.to_vec();
    numbers
        .iter_mut()
        .zip(bytes.as_chunks().0)
        .for_each(|(number, bits)| *number = f64::from_le_bytes(*bits));
    let results = function(&numbers).unwrap_or_default();
    assert!(
        results.iter().all(|number| number.is_finite()),
        "{name}: {results:?}"
    );
});
