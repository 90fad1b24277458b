//! Low-rank tables: their size, their errors and their files.

use std::sync::LazyLock;

use acceptance::{
    BOX, Contacts, PREFIX, RIGID_SPHERE, all_bits, assert_names, error_at, larger, low_rank,
    material, shipped, table, with_payload, workdir,
};
use interp::Parameter;
use interp::{Description, Error, LowRank, Quantity, Table, Tile};
use tabulate::table::{archive, compress};

const TWO_AXES: &str = "
    title      = 'Rigid substrate'
    tolerance  = 1e-4
    quantities = ['pi0', 'gamma', 'delta0']
    a_over_t   = { from = 0.1, to = 10, nodes = 20 }
    e1_over_e2 = { from = 0.3, to = 3, nodes = 12 }
    nu1        = 0.5
    e0_over_e2 = inf
";
const ONE_AXIS: &str = "
    title      = 'One material'
    tolerance  = 1e-4
    quantities = ['eeq']
    a_over_t   = { from = 0.1, to = 10, nodes = 20 }
    e1_over_e2 = 1.75
    nu1        = 0.5
    e0_over_e2 = 1e5
";
/// A scene with a single `a/t`.
const ONE_RADIUS: &str = "
    title      = 'One contact radius'
    tolerance  = 1e-4
    a_over_t   = 1
    e1_over_e2 = { from = 0.3, to = 3, nodes = 12 }
    nu1        = { from = 0.3, to = 0.5, nodes = 9 }
    e0_over_e2 = inf
";

static FOUR_AXES: LazyLock<Table> = LazyLock::new(|| table(BOX));

/// A low-rank table with few nodes, packed.
static PACKED: LazyLock<Vec<u8>> = LazyLock::new(|| {
    let few_nodes = RIGID_SPHERE
        .replace("1e-4", "1e-1")
        .replace("nodes = 20", "nodes = 7")
        .replace("nodes = 9", "nodes = 5");
    low_rank(&table(&few_nodes), 1e-4)
        .to_packed()
        .expect("a small table")
});

/// Returns the largest relative difference between the values of two tables at their nodes.
fn apart(found: &Table, expected: &Table) -> f64 {
    assert_eq!(
        (found.quantities(), found.axes()),
        (expected.quantities(), expected.axes())
    );
    let of = |quantity| {
        let [found, expected] = [found, expected]
            .map(|table| table.values(quantity).expect("a dense table holds them"));
        found
            .iter()
            .zip(expected)
            .map(|(found, expected)| (found / expected - 1.0).abs())
            .fold(0.0, larger)
    };
    expected.quantities().into_iter().map(of).fold(0.0, larger)
}

#[test]
fn derivatives_are_those_of_the_dense_table_with_axes_of_one_node_too() {
    for scene in [BOX, RIGID_SPHERE, TWO_AXES] {
        // A gradient is that of all quantities.
        let dense = table(
            &scene
                .lines()
                .filter(|line| !line.contains("quantities"))
                .collect::<Vec<_>>()
                .join("\n"),
        );
        let low_rank = low_rank(&dense, 1e-9);
        let (mut contacts, mut worst, mut known) = (Contacts::new(61), 0.0, 0);
        for _ in 0..100 {
            let (x, material) = contacts.point_of(&dense);
            let gradient = |table: &Table| {
                table
                    .curve_with_gradient(&material)
                    .and_then(|curve| curve.gradient(x))
                    .expect("inside")
            };
            let [ours, theirs] = [&low_rank, &dense].map(gradient);
            for parameter in [Parameter::E1OverE2, Parameter::Nu1, Parameter::E0OverE2] {
                let (Ok(ours), Ok(by)) = (ours.by(parameter), theirs.by(parameter)) else {
                    assert!(
                        ours.by(parameter).is_err() && theirs.by(parameter).is_err(),
                        "{}",
                        parameter.name()
                    );
                    continue;
                };
                for quantity in dense.quantities() {
                    let unit = theirs.values().get(quantity).abs() + by.get(quantity).abs();
                    worst = larger(worst, (ours.get(quantity) - by.get(quantity)).abs() / unit);
                }
                known += 1;
            }
        }
        println!(
            "{}: {known} derivatives, at most {worst:.1e} apart",
            dense.description().title
        );
        // The truncation of a form changes the values by a small part of the tolerance, and the
        // derivatives by a larger one. Measured: 1.2e-7, 2.8e-6, 1.7e-7.
        assert!(known >= 100 && worst <= 1e-5);
    }
}

#[test]
fn a_low_rank_table_has_the_error_it_was_given_at_the_nodes_and_little_more_between_them() {
    /// The least ratio of the error of a form to the allowed one, if its ranks are not all 1: with
    /// a rank less it may be too large. Measured: 0.5.
    const USED: f64 = 0.3;
    /// The largest difference from the curves of the dense table, and from those of the dense table
    /// of the form's values at the nodes, in allowed errors.
    ///
    /// The error is searched at the nodes. Where an axis has twelve, it is larger between them.
    /// Measured: 0.6 with four axes, 5.0 at most.
    const BETWEEN: f64 = 8.0;
    /// The part of it that does not depend on the allowed error, in tolerances: a lookup drops and
    /// rounds small terms.
    const DROPPED: f64 = 0.005;
    for scene in [BOX, RIGID_SPHERE, TWO_AXES, ONE_AXIS, ONE_RADIUS] {
        let dense = table(scene);
        assert!(
            dense.low_rank().is_none()
                && matches!(dense.expand(), Ok(std::borrow::Cow::Borrowed(_)))
        );
        for error in [1e-2, 1e-4, 1e-6, 1e-9, 1e-12] {
            let low_rank = low_rank(&dense, error);
            let ranks = low_rank.ranks().expect("it is low-rank");
            assert!(
                Quantity::ALL
                    .into_iter()
                    .all(|q| low_rank.values(q).is_none() && low_rank.holds(q) == dense.holds(q))
            );
            let expanded = low_rank.expand().expect("positive values");
            let reached = apart(&expanded, &dense);
            let mut contacts = Contacts::new(60);
            let mut different = 0.0;
            for _ in 0..200 {
                let (x, material) = contacts.point_of(&dense);
                let curves = [&low_rank, &dense, &*expanded]
                    .map(|table| table.curve(&material).expect("inside"));
                for quantity in dense.quantities() {
                    let [found, expected @ ..] = curves
                        .each_ref()
                        .map(|curve| curve.quantity(quantity, x).expect("inside"));
                    for expected in expected {
                        different = larger(different, (found / expected - 1.0).abs());
                    }
                }
            }
            let packed = low_rank.to_packed().expect("a small table");
            println!(
                "{}: error {error:e}: {reached:.1e} with ranks {:?} in {} bytes; the curves differ by {different:.1e}",
                dense.description().title,
                ranks,
                packed.len()
            );
            // Rounding of logarithm and exponential.
            assert!(reached <= error * (1.0 + error) + 1e-14, "{reached:.1e}");
            assert!(
                reached >= USED * error || ranks == [[1; 3]],
                "{reached:.1e}"
            );
            let allowed = BETWEEN * error + DROPPED * dense.description().tolerance;
            assert!(different <= allowed, "{different:.1e}");
            let again = Table::from_packed(&packed).expect("a sound table");
            assert_eq!(again.description(), low_rank.description());
            assert_eq!(again.to_packed().expect("a small table"), packed);
            assert_eq!(
                all_bits(&again.expand().expect("positive values")),
                all_bits(&expanded)
            );
        }
    }
}

#[test]
fn an_error_below_rounding_is_refused_with_what_was_reached() {
    match compress(&FOUR_AXES, 1e-17) {
        Err(error @ tabulate::Error::Truncation { .. }) => {
            assert_names(&error.to_string(), &["1.0e-17", "larger tolerance"])
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn packing_keeps_the_tolerance_at_fresh_points_and_says_so() {
    let workdir = workdir!();
    archive::write(&FOUR_AXES, &workdir.path("table.h5")).expect("written");
    let own = FOUR_AXES.description().certificate;
    let mut sizes = Vec::new();
    for tolerance in ["1e-3", "1e-4", "1e-5", "1e-6"] {
        let summary = workdir.succeed(&[
            "pack",
            "table.h5",
            "-o",
            "table.bin",
            "--tolerance",
            tolerance,
            "--points",
            "1000",
        ]);
        let packed = Table::read(workdir.path("table.bin")).expect("a sound table");
        let (value, ranks) = (
            tolerance.parse::<f64>().expect("a number"),
            packed.ranks().expect("low-rank")[0],
        );
        let description = packed.description();
        let certificate = &description.certificate;
        assert_eq!(
            (description.tolerance, certificate.points, certificate.seed),
            (value, 1000, own.seed + 1)
        );
        assert_eq!(
            description,
            &Description {
                tolerance: value,
                certificate: *certificate,
                ..FOUR_AXES.description().clone()
            }
        );
        assert!(certificate.max_error <= value);
        let size = workdir.read("table.bin").len();
        let [a, b, c] = ranks;
        let form = format!("ranks {a}, {b}, {c}");
        assert_names(
            &summary,
            &[
                "low rank",
                &form,
                tolerance,
                "table.bin",
                &format!("{size} bytes"),
                "1000 direct solves",
            ],
        );
        assert_names(
            &workdir.succeed(&["info", "table.bin"]),
            &[&form, "30 nodes", "low rank"],
        );

        let mut contacts = Contacts::new(61);
        let worst = (0..500)
            .map(|_| contacts.point_of(&packed))
            .map(|(x, material)| error_at(&packed, x, &material))
            .fold(0.0, larger);
        println!(
            "{tolerance}: {form}, {size} bytes, certified {:.1e}, at 500 fresh points {worst:.1e}",
            certificate.max_error
        );
        assert!(worst <= value);
        sizes.push(size);

        // The certificate holds for the values at the nodes as well.
        workdir.succeed(&["unpack", "table.bin", "-o", "unpacked.h5"]);
        let unpacked = Table::open(workdir.path("unpacked.h5")).expect("a sound table");
        assert_eq!(unpacked.description(), description);
        assert_eq!(
            all_bits(&unpacked),
            all_bits(&packed.expand().expect("positive values"))
        );
        for name in ["table.bin", "unpacked.h5"] {
            assert_names(
                &workdir.succeed(&["check", name, "--points", "300"]),
                &["300 points", "certified max"],
            );
        }
    }
    assert!(sizes.is_sorted_by(|a, b| a < b), "{sizes:?}");
    let dense = workdir.read("table.h5").len();
    println!(
        "dense: {dense} bytes, {} times as many as at 1e-6",
        dense / sizes[3]
    );
    // Measured: 97.
    assert!(dense > 80 * sizes[3]);
    // Every command takes it; ten thousand points compare a table with four axes.
    workdir.write(
        "points.csv",
        "a_over_t,e1_over_e2,nu1,e0_over_e2\n1,1,0.4,30\n",
    );
    assert_eq!(
        workdir
            .succeed(&["query", "table.bin", "--points", "points.csv"])
            .lines()
            .count(),
        2
    );
    assert_names(&workdir.succeed(&["check", "table.bin"]), &["10000 points"]);
}

/// An axis of one node has small ranks, and its table is packed and checked like any other.
#[test]
fn tables_of_fewer_axes_are_packed_to_a_tolerance_and_checked_too() {
    let workdir = workdir!();
    for (scene, axes) in [
        (RIGID_SPHERE, 3),
        (TWO_AXES, 2),
        (ONE_AXIS, 1),
        (ONE_RADIUS, 2),
    ] {
        let dense = table(scene);
        archive::write(&dense, &workdir.path("table.h5")).expect("written");
        let tolerance = 2.0 * dense.description().certificate.max_error + 1e-9;
        let text = workdir.succeed(&[
            "pack",
            "table.h5",
            "-o",
            "table.bin",
            "--tolerance",
            &format!("{tolerance:e}"),
        ]);
        assert_names(
            &text,
            &[
                &format!("{} direct solves", 2500 * axes),
                &format!("{tolerance:e}"),
            ],
        );
        let packed = Table::read(workdir.path("table.bin")).expect("a sound table");
        let [tile] = packed.low_rank().expect("low-rank") else {
            panic!("such a table is not divided")
        };
        assert!(packed.description().certificate.max_error <= tolerance);
        let (shape, [a, b, c]) = (dense.shape(), tile.form.ranks());
        let terms = tile.form.terms();
        assert!(a <= terms[0] && b <= a * terms[1] && c <= b * terms[2]);
        // An axis of one node has one term.
        let [first, second, third] = tile.form.order();
        for (dimension, terms) in [first, second, third, 0].into_iter().zip(terms) {
            assert!(shape[dimension] > 1 || terms == 1, "{terms} terms");
        }
        assert_eq!(packed.quantities(), dense.quantities());
        let mut contacts = Contacts::new(62);
        let fresh = (0..200)
            .map(|_| contacts.point_of(&packed))
            .map(|(x, material)| error_at(&packed, x, &material));
        assert!(fresh.fold(0.0, larger) <= tolerance);
        workdir.succeed(&["check", "table.bin"]);
    }
}

#[test]
fn the_same_table_gives_the_same_bytes_on_any_number_of_threads() {
    let threads = |count| {
        rayon::ThreadPoolBuilder::new()
            .num_threads(count)
            .build()
            .expect("threads")
    };
    let packed = |count| {
        threads(count).install(|| {
            low_rank(&FOUR_AXES, 1e-6)
                .to_packed()
                .expect("a small table")
        })
    };
    assert!(packed(1) == packed(3));
}

#[test]
fn what_cannot_be_packed_to_a_tolerance_is_said_and_nothing_is_written() {
    let workdir = workdir!();
    archive::write(&FOUR_AXES, &workdir.path("table.h5")).expect("written");
    let certified = format!("{:.1e}", FOUR_AXES.description().certificate.max_error);
    let pack = |tolerance| {
        [
            "pack",
            "table.h5",
            "-o",
            "table.bin",
            "--tolerance",
            tolerance,
        ]
    };
    for (tolerance, words) in [
        ("1e-11", ["tolerance", "1e-11", "1e-10 to 1e-1"]),
        ("0.2", ["tolerance", "0.2", "1e-10 to 1e-1"]),
        ("-1", ["tolerance", "-1", "1e-10 to 1e-1"]),
        ("nan", ["tolerance", "NaN", "1e-10 to 1e-1"]),
        ("1e-8", ["table.h5", &certified, "1e-8"]),
    ] {
        assert_names(&workdir.fail(1, &pack(tolerance)), &words);
    }
    // A certificate that states too small an error is detected.
    let mut wrong = FOUR_AXES.clone();
    wrong.set_certificate(interp::Certificate {
        max_error: 1e-12,
        p999_error: 1e-12,
        median_error: 1e-13,
        ..FOUR_AXES.description().certificate
    });
    archive::write(&wrong, &workdir.path("wrong.h5")).expect("written");
    let message = workdir.fail(
        1,
        &[
            "pack",
            "wrong.h5",
            "-o",
            "table.bin",
            "--tolerance",
            "1e-8",
            "--points",
            "200",
        ],
    );
    assert_names(&message, &["wrong.h5", "measured error", "1e-8", "1.0e-12"]);
    for argument in ["--points", "--seed"] {
        assert_names(
            &workdir.fail(2, &["pack", "table.h5", "-o", "table.bin", argument, "5"]),
            &["--tolerance"],
        );
    }
    assert_eq!(workdir.files(), ["table.h5", "wrong.h5"]);
}

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

#[test]
fn the_embedded_table_is_the_universal_one_and_as_accurate_as_it_says() {
    let table = Table::embedded();
    let description = table.description();
    let certificate = &description.certificate;
    assert_eq!(
        description.scene,
        std::fs::read_to_string(shipped("universal.toml")).expect("the scene is there")
    );
    assert!(table.low_rank().is_some() && table.quantities() == [Quantity::Gamma]);
    let ends = Parameter::REDUCED.map(|parameter| acceptance::ends(table, parameter));
    assert_eq!(
        ends,
        [(1e-3, 1e3), (0.0, 1e10), (0.0, 0.5), (0.0, f64::INFINITY)]
    );
    assert!(
        certificate.points >= 10_000 && certificate.max_error <= description.tolerance,
        "{certificate:?}"
    );
    let size = table.to_packed().expect("it was packed").len();
    assert!(size <= 400_000, "{size} bytes");
    // Its own way of placing points, which finds the edges and corners of the box; truth as
    // accurate as the tolerance needs.
    let measured =
        tabulate::table::certify(table, 1000, certificate.seed + 1, &|_| {}).expect("within reach");
    println!(
        "{size} bytes, certified {:.1e}, at 1000 fresh points {:.1e}",
        certificate.max_error, measured.max_error
    );
    assert!(measured.max_error <= description.tolerance);
}
