//! Forged files of low-rank tables.

use acceptance::{PREFIX, assert_names, material, with_payload, workdir};
use interp::{Error, LowRank, Quantity, Table, Tile};

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
    let integers = tile.form.coded_bytes();
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
fn a_form_whose_parts_contradict_each_other_is_malformed() {
    let held = || vec![Quantity::Pi0, Quantity::Eeq];
    let (order, terms, step) = ([3, 1, 2], [1, 3, 2, 2], 0.5);
    // The weights 1/2, 1/4, 2 and 1.
    let weights = || [vec![-1], vec![-2], vec![1, 0]];
    let cores = || {
        [
            vec![2],
            vec![1, 2, -1],
            vec![10, 20, 30, -5],
            vec![1, 2, 3, 4, 5, 6, 7, 8],
        ]
    };
    let sound = LowRank::new(held(), order, terms, weights(), step, cores()).expect("sound");
    assert_eq!(
        (sound.ranks(), sound.terms(), sound.quantities()),
        ([1, 1, 2], terms, &held()[..])
    );
    // By hand, where the film's modulus is in the middle, `T1 = 0` and `T2 = -1`, `nu1` at its end,
    // `T1 = 1`, and `a/t` at its beginning, `T1 = -1`.
    let root = |square: f64| 2_f64.sqrt() / (1.0 + square).sqrt();
    let [film, nu, a] = [-root(0.01), root(0.25), -root(1.0 / 1600.0)];
    let vector = [10.0 + 30.0 * nu, 20.0 - 5.0 * nu];
    let before = 2.0 * step / 0.5 * (step * (1.0 - film) / 0.25);
    let expected = [
        [1.0 + 3.0 * a, 5.0 + 7.0 * a],
        [2.0 + 4.0 * a, 6.0 + 8.0 * a],
    ]
    .map(|last| before * step * step * (vector[0] / 2.0 * last[0] + vector[1] * last[1]));
    let ends = [[-1.0, 1.0], [2.0, 4.0], [0.0, 1.0], [7.0, 7.0]];
    let found = sound.logarithms(ends, [&[-1.0], &[3.0], &[1.0], &[7.0]]);
    assert_eq!(found.len(), 2);
    for (found, expected) in found.iter().zip(expected) {
        assert!(
            (found / expected - 1.0).abs() < 1e-14,
            "{found}, not {expected}"
        );
    }
    let new = |order, terms, weights, step, cores| {
        LowRank::new(held(), order, terms, weights, step, cores)
    };
    let with_core = |i: usize, core: Vec<i64>| {
        let mut cores = cores();
        cores[i] = core;
        new(order, terms, weights(), step, cores)
    };
    let of = |quantities| LowRank::new(quantities, order, terms, weights(), step, cores());
    let with_weight = |weight| {
        new(
            order,
            terms,
            [vec![weight], vec![-2], vec![1, 0]],
            step,
            cores(),
        )
    };
    let wrong = [
        of(vec![]),
        of(vec![Quantity::Eeq, Quantity::Pi0]),
        of(vec![Quantity::Eeq; 2]),
        new([3, 1, 1], terms, weights(), step, cores()),
        new([0, 1, 2], terms, weights(), step, cores()),
        new(order, [1, 3, 2, 1], weights(), step, cores()),
        new(order, [0, 3, 2, 2], weights(), step, cores()),
        new(order, [1, usize::MAX, 2, 2], weights(), step, cores()),
        new(order, terms, [vec![-1], vec![], vec![1, 0]], step, cores()),
        new(
            order,
            terms,
            [vec![-1], vec![-2], vec![1, 0, 0]],
            step,
            cores(),
        ),
        // Two values of an index from a single term.
        new(
            order,
            terms,
            [vec![-1, -1], vec![-2], vec![1, 0]],
            step,
            [
                vec![2, 2],
                vec![1, 2, -1, 3, 1, 1],
                vec![10, 20, 30, -5],
                vec![1; 8],
            ],
        ),
        with_core(0, vec![]),
        with_core(2, vec![10, 20, 30]),
        with_core(3, vec![1, 2, 3, 4, 5, 6]),
        with_core(1, vec![1, 2, i64::MIN]),
        with_core(1, vec![1, 2, (1 << 53) + 1]),
        new(order, terms, weights(), 0.0, cores()),
        new(order, terms, weights(), f64::NAN, cores()),
        new(order, terms, weights(), f64::INFINITY, cores()),
        // In steps of this, one integer is more than anything is.
        new(order, terms, weights(), 1e29, cores()),
        with_weight(100),
        with_weight(i8::MIN),
    ];
    for (i, wrong) in wrong.iter().enumerate() {
        assert!(matches!(wrong, Err(Error::Malformed(_))), "{i}: {wrong:?}");
    }
    let table = &*FOUR_AXES;
    let tile = Tile {
        film: [0, 2],
        substrate: [0, 0],
        form: sound,
    };
    let misfit = Table::from_low_rank(table.description().clone(), table.axes(), vec![tile]);
    assert!(matches!(misfit, Err(Error::Malformed(_))), "{misfit:?}");
}
