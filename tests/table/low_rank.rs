//! Low-rank tables: their size, their errors and their files.

use std::sync::LazyLock;

use acceptance::{
    BOX, Contacts, PREFIX, RIGID_SPHERE, all_bits, assert_names, error_at, larger, low_rank,
    material, shipped, table, with_payload, workdir,
};
use interp::Parameter;
use interp::{Description, Error, LowRank, Quantity, Table};
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
fn at_the_nodes_a_low_rank_table_has_the_error_it_was_given_and_between_them_the_splines_through_its_values()
 {
    /// The least ratio of the error of a form to the allowed one, if its ranks are not all 1: with
    /// a rank less it may be too large. Measured: 0.18.
    const USED: f64 = 0.15;
    /// The largest difference between the curves of both forms, in tolerances: a lookup drops and
    /// rounds small terms. Measured: 0.0010.
    const SAME_SPLINE: f64 = 0.005;
    for scene in [BOX, RIGID_SPHERE, TWO_AXES, ONE_AXIS, ONE_RADIUS] {
        let dense = table(scene);
        assert!(
            dense.low_rank().is_none()
                && matches!(dense.expand(), Ok(std::borrow::Cow::Borrowed(_)))
        );
        for error in [1e-2, 1e-4, 1e-6, 1e-9, 1e-12] {
            let low_rank = low_rank(&dense, error);
            let form = low_rank.low_rank().expect("it is low-rank");
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
                let [a, b] =
                    [&low_rank, &*expanded].map(|table| table.curve(&material).expect("inside"));
                for quantity in dense.quantities() {
                    let [a, b] = [&a, &b].map(|curve| curve.quantity(quantity, x).expect("inside"));
                    different = larger(different, (a / b - 1.0).abs());
                }
            }
            let packed = low_rank.to_packed().expect("a small table");
            println!(
                "{}: error {error:e}: {reached:.1e} with ranks {:?} in {} bytes; the curves of both forms differ by {different:.1e}",
                dense.description().title,
                form.ranks(),
                packed.len()
            );
            // Rounding of logarithm and exponential.
            assert!(reached <= error * (1.0 + error) + 1e-14, "{reached:.1e}");
            assert!(
                reached >= USED * error || form.ranks() == [[1; 3]],
                "{reached:.1e}"
            );
            assert!(different <= SAME_SPLINE * dense.description().tolerance);
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
            packed.low_rank().expect("low-rank").ranks()[0],
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
        let form = packed.low_rank().expect("low-rank");
        assert!(packed.description().certificate.max_error <= tolerance);
        let ([n_a, n_e1, n_nu, n_e0], [a, b, c]) = (dense.shape(), form.ranks()[0]);
        assert!(
            a <= n_e0 && b <= a * n_e1 && c <= (b * n_nu).min(n_a * dense.quantities().len()),
            "{:?}",
            form.ranks()
        );
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
    let ranks = table.low_rank().expect("low-rank").ranks()[0];
    let payload = &PACKED[PREFIX..];
    // A whole number takes a byte, or as many after a mark.
    let whole = |at: usize| match payload[at] {
        251 => (
            usize::from(u16::from_le_bytes([payload[at + 1], payload[at + 2]])),
            3,
        ),
        252 => (0, 5),
        253 => (0, 9),
        small => (usize::from(small), 1),
    };
    // The content begins with three lists of weights, each with its length in a byte; then there
    // are those of four functions, four steps, and the cores.
    let [a, b, c] = ranks;
    let begins = |&at: &usize| {
        let places = [at, at + 1 + 8 * a, at + 2 + 8 * (a + b)];
        places
            .iter()
            .zip(ranks)
            .all(|(&at, rank)| payload.get(at).copied().map(usize::from) == Some(rank))
    };
    let mut at = (0..payload.len()).find(begins).expect("the weights");
    let mut lengths = Vec::new();
    for _ in 0..7 {
        lengths.push(at);
        let (count, size) = whole(at);
        at += size + 8 * count;
    }
    assert_eq!(lengths[3] - lengths[0], 3 + 8 * (a + b + c));
    at += 4 * 8;
    for _ in 0..4 {
        lengths.push(at);
        let (count, size) = whole(at);
        at += size;
        (0..count).for_each(|_| at += whole(at).1);
    }
    assert_eq!(at, payload.len());
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
    let weights = || [vec![0.5], vec![0.25], vec![2.0, 1.0]];
    // One substrate; three film moduli, two Poisson ratios, one function for each; three contact
    // radii, the third the sum of the others.
    let functions = || {
        let unit = |count: usize| {
            (0..count * count)
                .map(|i| if i % (count + 1) == 0 { 1.0 } else { 0.0 })
                .collect()
        };
        [
            unit(1),
            unit(3),
            unit(2),
            vec![1.0, 0.0, 0.0, 1.0, 1.0, 1.0],
        ]
    };
    let steps = [1.0, 0.5, 0.1, 2.0];
    let cores: [&[i64]; 4] = [
        &[2],
        &[1, 2, -1],
        &[10, 20, 30, -5],
        &[1, 2, 3, 4, 5, 6, 7, 8],
    ];
    let sound = LowRank::new(held(), weights(), functions(), steps, cores).expect("sound");
    assert_eq!(
        (sound.ranks(), sound.quantities()),
        ([1, 1, 2], &held()[..])
    );
    // By hand: C0 / w0 = 4, at the second film modulus C1 / w1 = 4, so 16 times C2 / w2 = (0.5, 2)
    // or (1.5, -0.5), times C3.
    let expected = [
        336.0, 416.0, 496.0, 576.0, 832.0, 992.0, -32.0, 0.0, 32.0, 64.0, 0.0, 64.0,
    ];
    let logarithms = sound.logarithms(1);
    assert_eq!(logarithms.len(), expected.len());
    for (found, expected) in logarithms.iter().zip(expected) {
        assert!((found - expected).abs() < 1e-12, "{logarithms:?}");
    }
    let new = |weights, steps, cores| LowRank::new(held(), weights, functions(), steps, cores);
    let with_core = |i: usize, core: &'static [i64]| {
        let mut cores = cores;
        cores[i] = core;
        new(weights(), steps, cores)
    };
    let with_function = |i: usize, values: Vec<f64>| {
        let mut functions = functions();
        functions[i] = values;
        LowRank::new(held(), weights(), functions, steps, cores)
    };
    let with_step = |step: f64| new(weights(), [1.0, 0.5, step, 2.0], cores);
    let with_weight = |weight: f64| new([vec![0.5], vec![weight], vec![2.0, 1.0]], steps, cores);
    let wrong = [
        LowRank::new(vec![], weights(), functions(), steps, cores),
        LowRank::new(
            vec![Quantity::Eeq, Quantity::Pi0],
            weights(),
            functions(),
            steps,
            cores,
        ),
        LowRank::new(vec![Quantity::Eeq; 2], weights(), functions(), steps, cores),
        new([vec![0.5], vec![], vec![2.0, 1.0]], steps, cores),
        new([vec![0.5], vec![0.25], vec![2.0, 1.0, 1.0]], steps, cores),
        // Two values of an index from a single node.
        new(
            [vec![0.5, 0.5], vec![0.25], vec![2.0, 1.0]],
            steps,
            [&[2, 2], &[1, 2, -1, 3, 1, 1], cores[2], cores[3]],
        ),
        with_core(0, &[]),
        with_core(2, &[10, 20, 30]),
        with_core(3, &[1, 2, 3, 4, 5, 6]),
        with_core(1, &[1, 2, i64::MIN]),
        with_core(1, &[1, 2, (1 << 53) + 1]),
        with_function(0, vec![]),
        with_function(2, vec![1.0; 3]),
        with_function(0, vec![f64::NAN]),
        with_function(0, vec![f64::INFINITY]),
        // Two functions on a single node.
        with_function(3, vec![1.0; 2]),
        with_step(0.0),
        with_step(f64::NAN),
        with_step(f64::INFINITY),
        // In steps of this, one entry is more than anything is.
        with_step(1e29),
        with_weight(0.0),
        with_weight(-0.25),
        with_weight(f64::NAN),
        // More values than are ever made.
        LowRank::new(
            vec![Quantity::Pi0],
            std::array::from_fn(|_| vec![1.0]),
            std::array::from_fn(|_| vec![0.1; 200]),
            [1.0; 4],
            [&[1]; 4],
        ),
    ];
    for (i, wrong) in wrong.iter().enumerate() {
        assert!(matches!(wrong, Err(Error::Malformed(_))), "{i}: {wrong:?}");
    }
    let table = &*FOUR_AXES;
    let misfit = Table::from_low_rank(table.description().clone(), table.axes(), sound);
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
    assert!(size <= 3_000_000, "{size} bytes");
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
