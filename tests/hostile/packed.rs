//! Any packed bytes give an error or a table that can be looked up, and reading them takes memory
//! of at most a small multiple of their length.

use allocation_counter::measure;
use contact::Contact;
use interp::{Error, Quantity, System, Table, Tile};

use crate::tables::{self, PREFIX, look_up, with_prefix};

/// The largest memory that reading may take: bytes for each byte of the input, and a constant
/// number of bytes. The first is that of six integers of eight bytes for each byte, and of the
/// bytes themselves. The second is the megabyte that a forged length can claim under the header's
/// limit.
const READING: (usize, usize) = (52, 1_060_000);

/// The largest memory that the first look-up of a curve with gradients may take: bytes for each
/// byte of the packed table, and a constant number of bytes. Measured: 48.4 for a low-rank table of
/// many nodes, of which the header's limit allows 130,000, and 2.5e7 for noise on 60 decades of
/// `a/t`, which needs the finest pieces.
const LOOKING_UP: (usize, usize) = (50, 27_000_000);

/// The same for forms that need as much as is accepted: 16 numbers of 8 bytes for each integer, of
/// which a byte holds six, or 8 MB; a list of numbers takes up to three times its size while it
/// grows. Measured: 834 for each byte of the table.
const DEMANDING: (usize, usize) = (850, 37_000_000);

/// Reads packed bytes, and asserts that this takes little memory.
fn read(bytes: &[u8]) -> Result<Table, Error> {
    let mut result = None;
    let most = measure(|| result = Some(Table::from_packed(bytes))).bytes_max as usize;
    assert_little(most, READING, bytes.len());
    result.expect("measured")
}

/// Asserts that memory is at most the given multiple of a number of bytes, plus the constant.
fn assert_little(memory: usize, (multiple, constant): (usize, usize), bytes: usize) {
    assert!(
        memory <= multiple * bytes + constant,
        "{memory} bytes of memory for {bytes} bytes"
    );
}

/// Reads a payload after a valid prefix.
fn read_payload(payload: &[u8]) -> Result<Table, Error> {
    read(&with_prefix(payload))
}

/// Asserts that a payload is malformed.
fn assert_malformed(case: &str, payload: &[u8]) {
    let result = read_payload(payload);
    assert!(
        matches!(result, Err(Error::Malformed(_))),
        "{case}: {result:?}"
    );
}

/// Asserts that a forged payload is malformed, or a table whose look-up gives numbers or finds that
/// it is malformed. Only every 31st forgery is looked up, because that is slow.
fn assert_harmless(case: &str, number: usize, payload: &[u8]) {
    let look_up = |table: Table| {
        if number.is_multiple_of(31) {
            look_up(&table)
        } else {
            Ok(())
        }
    };
    if let Err(error) = read_payload(payload).and_then(look_up) {
        assert!(matches!(error, Error::Malformed(_)), "{case}: {error}");
    }
}

/// Returns a packed table of each form.
fn packed() -> [(&'static str, Vec<u8>); 2] {
    [("dense", tables::dense()), ("low rank", tables::low_rank())]
        .map(|(form, table)| (form, table.to_packed().expect("small")))
}

#[test]
fn the_prefix_is_that_of_the_format() {
    for (form, bytes) in packed() {
        assert_eq!(with_prefix(&bytes[PREFIX..]), bytes, "{form}");
        look_up(&read(&bytes).expect("valid")).expect("valid");
    }
}

#[test]
fn any_other_length_is_an_error_that_states_both() {
    for (form, bytes) in packed() {
        let payload = bytes.len() - PREFIX;
        for length in 0..bytes.len() {
            match (length, read(&bytes[..length])) {
                (0..8, Err(Error::Foreign(_))) => {}
                (_, Err(Error::Length { expected, found })) => {
                    let stated = if length < PREFIX {
                        [PREFIX, length]
                    } else {
                        [payload, length - PREFIX]
                    };
                    assert_eq!([expected, found], stated.map(|length| length as u64));
                }
                (_, other) => panic!("{form}, {length} bytes: {other:?}"),
            }
        }
        for more in [1, 8, 1000] {
            let error = read(&[&bytes[..], &vec![0; more]].concat()).expect_err("too long");
            let message = error.to_string();
            assert!(
                message.contains("copy or download the file again"),
                "{message}"
            );
            let Error::Length { expected, found } = error else {
                panic!("{form}, {more} bytes more: {error:?}")
            };
            assert_eq!(
                [expected, found],
                [payload, payload + more].map(|n| n as u64)
            );
        }
        for length in PREFIX..bytes.len() {
            assert_malformed(
                &format!("{form}, {length} bytes, valid checksum"),
                &bytes[PREFIX..length],
            );
        }
        assert_malformed(
            &format!("{form}, a byte more, valid checksum"),
            &[&bytes[PREFIX..], &[0]].concat(),
        );
    }
}

/// Every bit of every byte is changed alone, and all together.
#[test]
fn every_changed_byte_is_an_error_by_its_place_and_with_a_valid_checksum_harmless() {
    for (form, bytes) in packed() {
        let mut changed = bytes.clone();
        for at in 0..bytes.len() {
            for (i, change) in (0..8).map(|bit| 1 << bit).chain([0xff]).enumerate() {
                let case = format!("{form}, byte {at} changed by {change:#x}");
                changed[at] ^= change;
                match (at, read(&changed)) {
                    (0..8, Err(Error::Foreign(_))) => {}
                    (8..12, Err(Error::Version { supported: 4, .. })) => {}
                    (12..20, Err(Error::Length { .. })) => {}
                    (20.., Err(Error::Checksum { stored, found })) => {
                        assert_ne!(stored, found, "{case}");
                    }
                    (_, other) => panic!("{case}: {other:?}"),
                }
                assert_harmless(&case, 9 * at + i, &changed[PREFIX..]);
                // Neither may panic, whatever they return.
                if let Ok(table) = read_payload(&changed[PREFIX..]) {
                    let _ = (table.curve(&tables::material()), table.expand());
                }
                changed[at] ^= change;
            }
        }
    }
}

#[test]
fn a_value_that_is_not_positive_is_malformed() {
    let [(form, bytes), _] = packed();
    for value in [-1.0, 0.0, f64::NAN, f64::INFINITY] {
        let last = bytes.len() - 8;
        assert_malformed(
            &format!("{form}, {value}"),
            &[&bytes[PREFIX..last], &value.to_le_bytes()].concat(),
        );
    }
}

/// Lengths are forged at every place, in the fixed width of the header and in the variable width of
/// the content.
#[test]
fn forged_lengths_are_harmless() {
    for (form, bytes) in packed() {
        let payload = &bytes[PREFIX..];
        for length in [
            3_u64,
            1 << 16,
            1 << 20,
            1 << 27,
            1 << 32,
            1 << 60,
            u64::MAX / 8,
            u64::MAX,
        ] {
            for at in 0..payload.len() {
                let case = format!("{form}, {length} at {at}");
                let rest = |size: usize| &payload[payload.len().min(at + size)..];
                assert_harmless(
                    &case,
                    at,
                    &[&payload[..at], &length.to_le_bytes(), rest(8)].concat(),
                );
                assert_harmless(
                    &case,
                    at,
                    &[&payload[..at], &[253], &length.to_le_bytes(), rest(1)].concat(),
                );
            }
        }
        // The length of the payload.
        for length in [
            0,
            1,
            payload.len() as u64 - 1,
            payload.len() as u64 + 1,
            1 << 40,
            u64::MAX,
        ] {
            let forged = [&bytes[..12], &length.to_le_bytes(), &bytes[20..]].concat();
            assert!(
                matches!(read(&forged), Err(Error::Length { .. })),
                "{form}, {length}"
            );
        }
    }
}

/// Zeros are the numbers of the fewest bytes.
#[test]
fn a_long_list_of_zeros_takes_little_memory_wherever_it_is() {
    let zeros = vec![0; (1 << 20) + 1];
    let length = (zeros.len() as u64).to_le_bytes();
    for ((form, bytes), length) in packed()
        .iter()
        .zip([length.to_vec(), [&[253], &length[..]].concat()])
    {
        for at in PREFIX..bytes.len() {
            assert_malformed(
                &format!("{form}, zeros behind {at} bytes"),
                &[&bytes[PREFIX..at], &length, &zeros].concat(),
            );
        }
    }
}

#[test]
fn looking_up_takes_little_memory() {
    let material = tables::material();
    let assert_modest = |table: &Table| {
        // The packing of a copy, because it prepares the lookup.
        let packed = table.clone().to_packed();
        let bytes = packed.expect("not too large").len();
        let most = measure(|| drop(table.curve_with_gradient(&material))).bytes_max as usize;
        assert_little(most, LOOKING_UP, bytes);
    };
    for shape in [
        [2, 1, 1, 1],
        [2; 4],
        [2000, 2, 2, 2],
        [2, 1000, 2, 2],
        [2, 2, 1000, 2],
        [2, 2, 2, 1000],
        [20; 4],
    ] {
        for a_over_t in [[0.5, 2.0], [1e-30, 1e30]] {
            tables::of_shape(shape, a_over_t)
                .iter()
                .for_each(assert_modest);
        }
    }
    for a_over_t in [[1e-3, 1e3], [1e-30, 1e30]] {
        assert_modest(&tables::of_nodes(120_000, a_over_t));
    }
}

/// A form may need a multiple of its size, whichever core makes it large.
#[test]
fn the_first_lookup_of_the_most_demanding_forms_takes_memory_in_proportion() {
    // Of each family the largest number that is accepted: nodes of `a/t`, or terms of a core.
    type Family = (&'static str, fn(usize) -> Result<Table, Error>);
    let families: [Family; 5] = [
        ("radii", |n_a| {
            tables::demanding([1, 1, 600, 1], [1, 1, 600], n_a)
        }),
        ("radii after few terms", |n_a| {
            tables::demanding([9, 9, 9, 9], [9, 81, 400], n_a)
        }),
        // With six columns of sixteen, the padding is as large as is accepted.
        ("film moduli", |terms| {
            tables::demanding([400, terms, 1, 1], [400, 6, 1], 2)
        }),
        ("Poisson ratios", |terms| {
            tables::demanding([1, 400, terms, 1], [1, 400, 6], 2)
        }),
        ("substrate moduli", |terms| {
            tables::demanding([terms, 1, 1, 1], [terms, 1, 1], 2)
        }),
    ];
    let material = tables::material();
    for (family, make) in families {
        let (mut accepted, mut refused) = (100_usize, 20_000);
        while refused - accepted > 1 {
            let middle = accepted.midpoint(refused);
            match make(middle) {
                Ok(_) => accepted = middle,
                Err(Error::LowRankTooLarge { needed, most, .. }) => {
                    assert!(needed > most);
                    refused = middle;
                }
                Err(other) => panic!("{family}: {other}"),
            }
        }
        let table = make(accepted).expect("accepted");
        let bytes = table.clone().to_packed().expect("accepted");
        let mut again = None;
        let read = measure(|| again = Some(Table::from_packed(&bytes))).bytes_max as usize;
        again.expect("measured").expect("it was packed");
        assert_little(read, READING, bytes.len());
        // The table that was not read from a file must choose its pieces, too.
        let most = measure(|| drop(table.curve(&material))).bytes_max as usize;
        let [reading, multiple] = [(read, READING), (most, DEMANDING)]
            .map(|(most, (_, constant))| most.saturating_sub(constant) as f64 / bytes.len() as f64);
        println!(
            "{family}: {accepted}, {} bytes, {multiple:.0} bytes of memory for each, {reading:.1} to read",
            bytes.len()
        );
        assert_little(most, DEMANDING, bytes.len());
    }
}

/// The ranks of a table made to a small tolerance, with terms in proportion to those of the
/// embedded table.
#[test]
fn a_form_of_large_ranks_is_accepted() {
    let ranks = [25, 215, 137];
    let table = tables::demanding([25, 46, 24, 56], ranks, 130).expect("not too large");
    assert_eq!(table.ranks(), Some(vec![ranks]));
}

/// Sound forms of 320 and 61 kilobytes, whose first lookup would keep 1.6 and 0.4 GB.
#[test]
fn a_small_form_that_needs_gigabytes_is_refused_with_what_to_do() {
    for [n_a, c] in [[36_000, 1380], [20_000, 600]] {
        let error = tables::demanding([1, 1, c, 1], [1, 1, c], n_a).expect_err("too large");
        assert!(matches!(error, Error::LowRankTooLarge { .. }), "{error}");
        let message = error.to_string();
        for word in [
            &format!("[1, 1, {c}]"),
            "at most",
            "tolerance",
            "smaller box",
            "HDF5",
        ] {
            assert!(message.contains(word), "{message}");
        }
    }
}

/// Each form alone is accepted because forms of any size may need a megabyte of numbers.
#[test]
fn tiles_that_need_too_much_together_are_refused() {
    let form = tables::form(1, [96, 96, 1, 1], [96, 1, 1], 1e-3, |i| i % 7);
    let mut axes = tables::axes();
    axes[1].1 = (0..12).map(|i| 1.5 + f64::from(i)).collect();
    axes[2].1.truncate(1);
    let tiles = |count: usize| {
        let tile = |i: usize| Tile {
            film: [11 * i / count, 11 * (i + 1) / count],
            substrate: [0, 1],
            form: form.clone(),
        };
        let tiles = (0..count).map(tile).collect();
        Table::from_low_rank(
            tables::description(),
            axes.clone(),
            vec![Quantity::Gamma],
            tiles,
        )
    };
    assert!(tiles(1).is_ok());
    for count in [2, 8] {
        let result = tiles(count);
        assert!(
            matches!(result, Err(Error::LowRankTooLarge { needed, most, .. }) if needed > most)
        );
    }
}

/// Fitting code calls these functions in its innermost loop.
#[test]
fn evaluating_a_contact_does_not_allocate() {
    let system = System {
        film_thickness: 1e-5,
        ..tables::contact().system().expect("on a film").clone()
    };
    let contact = Contact::in_table_with_gradient(Table::embedded(), &system).expect("inside");
    let curve = contact.curve().expect("on a film");
    let allocated = measure(|| {
        curve.quantities_and_slopes(6.5).expect("inside");
        curve
            .quantity_at_all(Quantity::Eeq, &[1.0, 1e-5], &mut [0.0; 2])
            .expect("inside or beyond");
        contact.load(6.5e-5, 0.04).expect("inside");
        contact.load_and_penetration(6.5e-5, 0.04).expect("inside");
        contact.gradient(6.5e-5, 0.04).expect("inside");
        contact
            .energy_release_rate_at_load(6.5e-5, 0.0)
            .expect("inside");
    });
    assert_eq!(allocated.count_total, 0);
}
