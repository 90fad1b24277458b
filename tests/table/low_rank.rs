//! Low-rank tables: their size, their errors and their files.

use std::sync::LazyLock;

use acceptance::{
    BOX, Contacts, RIGID_SPHERE, Refused, all_bits, assert_matches, assert_names, error_at, larger,
    low_rank, shipped, table, workdir, write_hdf5,
};
use interp::{Description, MaterialParameter, Parameter, Quantity, Table};
use tabulate::table::compress;

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

/// A scene whose other quantities are integrals of `Gamma`.
const GAMMA_ALONE: &str = "
    title      = 'Gamma alone'
    tolerance  = 1e-6
    quantities = ['gamma']
    a_over_t   = { from = 1e-3, to = 100 }
    e1_over_e2 = { from = 0.5, to = 2, nodes = 14 }
    nu1        = { from = 0.4, to = 0.5, nodes = 12 }
    e0_over_e2 = { from = 20, to = 60, nodes = 10 }
";

pub static FOUR_AXES: LazyLock<Table> = LazyLock::new(|| table(BOX));

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
    // A gradient is that of all quantities: held, or derived from `Gamma`.
    let of_all = [BOX, RIGID_SPHERE, TWO_AXES].map(|scene| {
        let is_kept = |line: &&str| !line.contains("quantities");
        scene.lines().filter(is_kept).collect::<Vec<_>>().join("\n")
    });
    for scene in of_all.into_iter().chain([GAMMA_ALONE.to_owned()]) {
        let dense = table(&scene);
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
            for parameter in MaterialParameter::ALL {
                let (Ok(ours), Ok(by)) = (ours.by(parameter), theirs.by(parameter)) else {
                    let either = ours.by(parameter).or(theirs.by(parameter));
                    assert!(either.is_err(), "{}", parameter.name());
                    continue;
                };
                for quantity in Quantity::ALL {
                    let unit = theirs.values().get(quantity).abs() + by.get(quantity).abs();
                    worst = larger(worst, (ours.get(quantity) - by.get(quantity)).abs() / unit);
                }
                known += 1;
            }
        }
        println!("{}: {known} {worst:.1e}", dense.description().title);
        // The truncation of a form changes the values by a small part of the tolerance, and the
        // derivatives by a larger one. Measured: 9.8e-8, 4.0e-6, 5.4e-7; 4.6e-5 where `Gamma` alone is held.
        let most = if scene == GAMMA_ALONE { 1e-4 } else { 1e-5 };
        assert!(known >= 100 && worst <= most, "{worst:e}");
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
        assert!(dense.low_rank().is_none());
        assert_matches!(dense.expand(), Ok(std::borrow::Cow::Borrowed(_)));
        for error in [1e-2, 1e-4, 1e-6, 1e-9, 1e-12] {
            let low_rank = low_rank(&dense, error);
            let ranks = low_rank.ranks().expect("it is low-rank");
            for q in Quantity::ALL {
                assert!(low_rank.values(q).is_none() && low_rank.holds(q) == dense.holds(q));
            }
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
            // Rounding of logarithm and exponential.
            assert!(reached <= error * (1.0 + error) + 1e-14, "{reached:.1e}");
            let is_used = reached >= USED * error || ranks == [[1; 3]];
            assert!(is_used, "{reached:.1e}");
            let allowed = BETWEEN * error + DROPPED * dense.description().tolerance;
            assert!(different <= allowed, "{different:.1e}");
            let again = Table::from_packed(&packed).expect("a sound table");
            assert_eq!(again.description(), low_rank.description());
            assert_eq!(again.to_packed().expect("a small table"), packed);
            let again = again.expand().expect("positive values");
            assert_eq!(all_bits(&again), all_bits(&expanded));
        }
    }
}

#[test]
fn an_error_below_rounding_is_refused_with_what_was_reached() {
    compress(&table(TWO_AXES), 1e-17).refused("1.0e-17; larger tolerance");
}

#[test]
fn packing_keeps_the_tolerance_at_fresh_points_and_says_so() {
    let workdir = workdir!();
    write_hdf5(&FOUR_AXES, &workdir.path("table.h5"));
    let own = FOUR_AXES.description().certificate;
    let mut sizes = Vec::new();
    for tolerance in ["1e-3", "1e-4", "1e-5", "1e-6"] {
        let summary = workdir.succeed(format!(
            "pack table.h5 -o table.bin --tolerance {tolerance} --points 1000"
        ));
        let packed = workdir.table("table.bin");
        let value: f64 = tolerance.parse().expect("a number");
        let [a, b, c] = packed.ranks().expect("low-rank")[0];
        let description = packed.description();
        let certificate = description.certificate;
        assert_eq!((certificate.points, certificate.seed), (1000, own.seed + 1));
        let expected = Description {
            tolerance: value,
            certificate,
            ..FOUR_AXES.description().clone()
        };
        assert_eq!(*description, expected);
        assert!(certificate.max_error <= value);
        let size = workdir.read("table.bin").len();
        let form = format!("ranks {a}, {b}, {c}");
        let words = format!("low rank; {form}; {tolerance}; table.bin; {size} bytes");
        assert_names(&summary, &format!("{words}; 1000 direct solves"));
        let info = workdir.succeed("info table.bin");
        assert_names(&info, &[&form, "30 nodes", "low rank"]);

        let mut contacts = Contacts::new(61);
        let worst = (0..500)
            .map(|_| contacts.point_of(&packed))
            .map(|(x, material)| error_at(&packed, x, &material))
            .fold(0.0, larger);
        assert!(worst <= value, "{worst:e}");
        sizes.push(size);

        // The certificate holds for the values at the nodes as well.
        workdir.succeed("unpack table.bin -o unpacked.h5");
        let unpacked = workdir.table("unpacked.h5");
        assert_eq!(unpacked.description(), description);
        let packed = packed.expand().expect("positive values");
        assert_eq!(all_bits(&unpacked), all_bits(&packed));
        for name in ["table.bin", "unpacked.h5"] {
            let checked = workdir.succeed(format!("check {name} --points 300"));
            assert_names(&checked, "300 points; certified max");
        }
    }
    assert!(sizes.is_sorted_by(|a, b| a < b), "{sizes:?}");
    let dense = workdir.read("table.h5").len();
    println!("dense: {dense} {}", dense / sizes[3]);
    // Measured: 97.
    assert!(dense > 80 * sizes[3]);
    // Every command takes it; ten thousand points compare a table with four axes.
    workdir.write_points("1,1,0.4,30\n");
    let answer = workdir.succeed("query table.bin --points points.csv");
    assert_eq!(answer.lines().count(), 2);
    assert_names(&workdir.succeed("check table.bin"), &["10000 points"]);
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
        write_hdf5(&dense, &workdir.path("table.h5"));
        let tolerance = 2.0 * dense.description().certificate.max_error + 1e-9;
        let pack = format!("pack table.h5 -o table.bin --tolerance {tolerance:e}");
        let words = format!("{} direct solves; {tolerance:e}", 2500 * axes);
        assert_names(&workdir.succeed(pack), &words);
        let packed = workdir.table("table.bin");
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
        workdir.succeed("check table.bin");
    }
}

#[test]
fn the_same_table_gives_the_same_bytes_on_any_number_of_threads() {
    let packed = |count| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(count).build();
        let made = pool
            .expect("threads")
            .install(|| low_rank(&FOUR_AXES, 1e-6));
        made.to_packed().expect("a small table")
    };
    assert!(packed(1) == packed(3));
}

#[test]
fn what_cannot_be_packed_to_a_tolerance_is_said_and_nothing_is_written() {
    let workdir = workdir!();
    write_hdf5(&FOUR_AXES, &workdir.path("table.h5"));
    let certified = format!("{:.1e}", FOUR_AXES.description().certificate.max_error);
    workdir.refuses(format!(
        "
        1 | pack table.h5 -o table.bin --tolerance 1e-11 | tolerance; 1e-11; 1e-10 to 1e-1
        1 | pack table.h5 -o table.bin --tolerance 0.2 | tolerance; 0.2; 1e-10 to 1e-1
        1 | pack table.h5 -o table.bin --tolerance -1 | tolerance; -1; 1e-10 to 1e-1
        1 | pack table.h5 -o table.bin --tolerance nan | tolerance; NaN; 1e-10 to 1e-1
        1 | pack table.h5 -o table.bin --tolerance 1e-8 | table.h5; {certified}; 1e-8
        2 | pack table.h5 -o table.bin --points 5 | --tolerance
        2 | pack table.h5 -o table.bin --seed 5 | --tolerance
        "
    ));
    // A certificate that states too small an error is detected.
    let mut wrong = FOUR_AXES.clone();
    wrong.set_certificate(interp::Certificate {
        max_error: 1e-12,
        p999_error: 1e-12,
        median_error: 1e-13,
        ..FOUR_AXES.description().certificate
    });
    write_hdf5(&wrong, &workdir.path("wrong.h5"));
    workdir.refuses(
        "1 | pack wrong.h5 -o table.bin --tolerance 1e-8 --points 200 | wrong.h5; measured error; 1e-8; 1.0e-12",
    );
    assert_eq!(workdir.files(), ["table.h5", "wrong.h5"]);
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
    let expected = [(1e-3, 1e3), (0.0, 1e10), (0.0, 0.5), (0.0, f64::INFINITY)];
    assert_eq!(ends, expected);
    let is_kept = certificate.points >= 10_000 && certificate.max_error <= description.tolerance;
    assert!(is_kept, "{certificate:?}");
    let size = table.to_packed().expect("it was packed").len();
    assert!(size <= 400_000, "{size} bytes");
    // Its own way of placing points, which finds the edges and corners of the box; truth as
    // accurate as the tolerance needs.
    let measured = tabulate::table::certify(table, 1000, certificate.seed + 1, &|_| {});
    let error = measured.expect("within reach").max_error;
    assert!(error <= description.tolerance, "{error:e}");
}
