//! Forged files of low-rank tables.

use acceptance::{PREFIX, assert_names, material, with_payload, workdir};
use interp::{Error, Quantity, Table, Tile};
use low_rank::IntegerTrain;

use crate::low_rank::{FOUR_AXES, PACKED};

#[test]
fn a_forged_form_is_an_error_or_a_table_that_can_be_looked_up() {
    let payload = &PACKED[PREFIX..];
    let sound = Table::from_packed(&with_payload(&PACKED, payload)).expect("as it was");
    assert_eq!(sound.to_packed().expect("a small table"), *PACKED);
    for length in 0..payload.len() {
        let result = Table::from_packed(&with_payload(&PACKED, &payload[..length]));
        assert!(
            matches!(result, Err(Error::Malformed(_))),
            "{length} bytes: {result:?}"
        );
    }
    let longer = Table::from_packed(&with_payload(&PACKED, &[payload, &[0]].concat()));
    assert!(matches!(longer, Err(Error::Malformed(_))), "{longer:?}");
    let (mut bytes, mut tables) = (payload.to_vec(), 0);
    let material = material([0.0, 0.4, 10.0, 0.25]);
    for at in 0..bytes.len() {
        for change in [0x01, 0x80, 0xff] {
            bytes[at] ^= change;
            match Table::from_packed(&with_payload(&PACKED, &bytes)) {
                Ok(table) => {
                    // Neither may panic, whatever they return.
                    let _ = (table.curve(&material), table.expand());
                    tables += 1;
                }
                Err(error) => assert!(matches!(error, Error::Malformed(_)), "byte {at}: {error}"),
            }
            bytes[at] ^= change;
        }
    }
    println!(
        "{} forgeries, of which {tables} are tables",
        3 * bytes.len()
    );
}

/// Forges the length of each list, beyond any file, and reads the file in a process with little
/// memory.
#[cfg(unix)]
#[test]
fn nothing_is_allocated_on_the_word_of_a_file() {
    let workdir = workdir!();
    let table = Table::from_packed(&PACKED).expect("as it was");
    let [tile] = table.low_rank().expect("low-rank") else {
        panic!("it has one tile")
    };
    let payload = &PACKED[PREFIX..];
    // A whole number below 251 takes a byte, others three. The content ends with the weights of
    // three bonds, each list behind its length, a step of eight bytes, and the list of the coded
    // integers.
    let integers = tile.form.coded_integers().len();
    let size = |length: usize| if length < 251 { 1 } else { 3 };
    let at_integers = payload.len() - integers - size(integers);
    let [a, b, c] = tile.form.ranks();
    let at_weights = at_integers - 8 - (3 + a + b + c);
    let mut lengths = vec![at_integers];
    lengths.extend([at_weights, at_weights + 1 + a, at_weights + 2 + a + b]);
    for (at, rank) in lengths[1..].iter().zip([a, b, c]) {
        assert_eq!(usize::from(payload[*at]), rank);
    }
    // Before them, the number of tiles, the nodes of the tile, the order, and the terms of each
    // core.
    let terms = tile.form.terms();
    for (at, terms) in (at_weights - 4..at_weights).zip(terms) {
        assert_eq!(usize::from(payload[at]), terms);
        lengths.push(at);
    }
    assert_eq!(payload[at_weights - 12], 1);
    lengths.push(at_weights - 12);
    for at in lengths {
        let size = if payload[at] == 251 { 3 } else { 1 };
        for claimed in [1_u64 << 27, 1 << 32, 1 << 60, u64::MAX] {
            let forged = [
                &payload[..at],
                &[253],
                &claimed.to_le_bytes(),
                &payload[at + size..],
            ]
            .concat();
            workdir.write("forged.bin", with_payload(&PACKED, &forged));
            let run = workdir.script("ulimit -v 262144 && exec \"$0\" info forged.bin");
            assert_eq!(run.status, 1, "{claimed} at {at}: {}", run.stderr);
            assert_names(&run.stderr, &["the table is malformed"]);
        }
    }
}

#[test]
fn a_train_of_other_functions_than_the_table_holds_is_malformed() {
    let table = &*FOUR_AXES;
    let train = |functions, smooth_degrees| {
        let cores = [vec![1], vec![1], vec![1], vec![1; functions]];
        let weights = [vec![0], vec![0], vec![0]];
        IntegerTrain::new(
            functions,
            [1, 2, 3],
            smooth_degrees,
            [1; 4],
            weights,
            1e-3,
            cores,
        )
    };
    let of = |quantities: &[Quantity], form: Result<IntegerTrain, _>| {
        let tile = Tile {
            film: [0, table.shape()[1] - 1],
            substrate: [0, table.shape()[3] - 1],
            form: form.expect("sound"),
        };
        let description = table.description().clone();
        Table::from_low_rank(description, table.axes(), quantities.to_vec(), vec![tile])
    };
    let held = [Quantity::Pi0, Quantity::Eeq];
    let degrees = Tile::SMOOTH_DEGREES;
    of(&held, train(2, degrees)).expect("two of two");
    let wrong = [
        of(&held, train(3, degrees)),
        of(&held, train(2, [40.0; 4])),
        of(&[], train(0, degrees).or(train(1, degrees))),
        of(&[Quantity::Eeq, Quantity::Pi0], train(2, degrees)),
        of(&[Quantity::Eeq; 2], train(2, degrees)),
    ];
    for (i, wrong) in wrong.iter().enumerate() {
        assert!(matches!(wrong, Err(Error::Malformed(_))), "{i}: {wrong:?}");
    }
}
