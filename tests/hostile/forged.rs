//! Packed tables with random changes and a repaired checksum are an error or tables that can be
//! looked up.

use acceptance::change;
use interp::{Error, Table};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use crate::tables::{self, PREFIX, look_up, with_prefix};

/// Reads `cases` changed tables, and looks up every 31st that is a table.
fn attack(cases: u64) {
    let packed = [
        tables::dense(),
        tables::low_rank(),
        tables::low_rank_in_tiles(),
    ]
    .map(|table| table.to_packed().expect("small"));
    let (mut opened, mut looked_up) = (0, 0);
    for seed in 0..cases {
        let mut random = Pcg64Mcg::seed_from_u64(seed);
        let mut payload = packed[random.random_range(0..packed.len())][PREFIX..].to_vec();
        for _ in 0..random.random_range(1..4) {
            let at = random.random_range(0..payload.len());
            change(&mut payload, at, &mut random);
            if random.random_range(0..8) == 0 {
                payload.truncate(at + 1);
            }
        }
        match Table::from_packed(&with_prefix(&payload)) {
            Ok(table) => {
                opened += 1;
                if opened % 31 == 0 {
                    looked_up += 1;
                    let result = look_up(&table);
                    let is_harmless = matches!(result, Ok(()) | Err(Error::Malformed(_)));
                    assert!(is_harmless, "seed {seed}: {result:?}");
                }
            }
            Err(Error::Malformed(_) | Error::LowRankTooLarge { .. }) => {}
            Err(error) => panic!("seed {seed}: {error}"),
        }
    }
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
