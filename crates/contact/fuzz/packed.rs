//! Fuzzes the reader of packed tables. The result must be an error, or a table that can be looked
//! up, and that gives identical bytes when it is packed, read and packed again.

#![no_main]

use interp::Table;
use libfuzzer_sys::fuzz_target;
use tables::{look_up, with_prefix};

#[allow(dead_code, reason = "the test uses more of these tables")]
#[path = "../../../tests/hostile/tables.rs"]
mod tables;

// The input is the payload alone. Valid length and checksum precede it, because the reader would
// reject nearly every mutation of them.
fuzz_target!(|payload: &[u8]| {
    let Ok(table) = Table::from_packed(&with_prefix(payload)) else {
        return;
    };
    let _ = look_up(&table);
    // A small low-rank file may expand to a large table.
    if table.shape().iter().product::<usize>() < 10_000 {
        let _ = table.expand();
    }
    let packed = table
        .to_packed()
        .expect("a table that was read can be written");
    let again = Table::from_packed(&packed).expect("a table that was written can be read");
    assert_eq!(again.to_packed().expect("as before"), packed);
});
