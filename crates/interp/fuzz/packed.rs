//! Packed bytes: an error, or a table that gives numbers and packs into bytes of itself.

#![no_main]

use interp::Table;
use libfuzzer_sys::fuzz_target;
use tables::{look_up, with_prefix};

#[allow(dead_code, reason = "of the tables, the test makes more use")]
#[path = "../tests/hostile/tables.rs"]
mod tables;

// The input is the payload: length and checksum before it are always sound, or no mutation would
// get any further.
fuzz_target!(|payload: &[u8]| {
    let Ok(table) = Table::from_packed(&with_prefix(payload)) else { return };
    let _ = look_up(&table);
    // Written out, a small file may be large.
    if table.shape().iter().product::<usize>() < 10_000 {
        let _ = table.expand();
    }
    let packed = table.to_packed().expect("what was read can be written");
    let again = Table::from_packed(&packed).expect("what was written can be read");
    assert_eq!(again.to_packed().expect("as before"), packed);
});
