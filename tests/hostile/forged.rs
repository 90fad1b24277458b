//! Packed tables with random changes and a repaired checksum are an error or tables that can be
//! looked up.

use std::cell::Cell;

use proptest::prelude::*;
use proptest::sample::Index;
use proptest::test_runner::TestRunner;

use interp::{Error, Table};

use crate::config;
use crate::tables::{self, PREFIX, look_up, with_prefix};

/// Changes a payload at a place: by a bit, by one, or to a number of one to eight bytes.
fn change(payload: &mut Vec<u8>, (place, kind, number): (Index, u8, u64)) {
    let at = place.index(payload.len());
    let length = payload.len() as u64;
    let width = [1, 2, 4, 8][usize::from(kind / 8) % 4].min(payload.len() - at);
    let number = match kind % 8 {
        0 => 0,
        1 => u64::MAX,
        2 => 1 << (number % 64),
        3 => number % (2 * length),
        4 => u64::from(payload[at]) ^ 1 << (number % 8),
        5 => u64::from(payload[at])
            .wrapping_add(number % 3)
            .wrapping_sub(1),
        6 => f64::from_bits(number).to_bits(),
        _ => {
            payload.truncate(at + 1);
            return;
        }
    };
    payload[at..at + width].copy_from_slice(&number.to_le_bytes()[..width]);
}

/// Reads `cases` changed tables, and looks up every 31st that is a table.
fn attack(cases: u32) {
    let packed = [
        tables::dense(),
        tables::low_rank(),
        tables::low_rank_in_tiles(),
    ]
    .map(|table| table.to_packed().expect("small"));
    let change_of = (any::<Index>(), any::<u8>(), any::<u64>());
    let changes = (0..packed.len(), prop::collection::vec(change_of, 1..4));
    let (opened, looked_up) = (Cell::new(0), Cell::new(0));
    let tested = TestRunner::new(config(cases)).run(&changes, |(form, changes)| {
        let mut payload = packed[form][PREFIX..].to_vec();
        changes
            .into_iter()
            .for_each(|each| change(&mut payload, each));
        match Table::from_packed(&with_prefix(&payload)) {
            Ok(table) => {
                opened.set(opened.get() + 1);
                if opened.get() % 31 == 0 {
                    looked_up.set(looked_up.get() + 1);
                    let result = look_up(&table);
                    prop_assert!(
                        matches!(result, Ok(()) | Err(Error::Malformed(_))),
                        "{result:?}"
                    );
                }
            }
            Err(error) => prop_assert!(
                matches!(error, Error::Malformed(_) | Error::LowRankTooLarge { .. }),
                "{error}"
            ),
        }
        Ok(())
    });
    tested.unwrap_or_else(|error| panic!("{error}"));
    let (opened, looked_up) = (opened.get(), looked_up.get());
    println!("{cases} forged tables: {opened} are tables, {looked_up} looked up");
    assert!(opened > cases / 100 && opened < cases);
}

#[test]
fn random_changes_are_harmless() {
    attack(20_000);
}

#[test]
#[ignore = "a recorded run: a million tables take minutes"]
fn a_million_random_changes_are_harmless() {
    attack(1_000_000);
}
