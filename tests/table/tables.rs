//! Tables of scenes: their nodes, stored values, certificates and lookups.

use contact::Contact;
use std::sync::LazyLock;

use acceptance::{
    Contacts, Refused, all_bits, assert_names, error_at, forged, larger, material, shipped, solved,
    table, workdir, write_hdf5,
};
use interp::{Description, Error, Parameter, Quantity, Table};
use tabulate::table::certify;

/// Largest ratio of the error at some hundred fresh points to that of the certificate. Measured:
/// 1.5.
const BEYOND_CERTIFICATE: f64 = 3.0;
/// Largest ratio of the median errors of two independent samples of a table. Measured: 1.2.
const MEDIANS: f64 = 2.0;

/// A scene of four axes.
const BOX: &str = "
    title      = 'Four axes'
    tolerance  = 1e-4
    a_over_t   = { from = 0.1, to = 10 }
    e1_over_e2 = { from = 0.3, to = 3 }
    nu1        = { from = 0.3, to = 0.5 }
    e0_over_e2 = { from = 10, to = 100 }
";
/// A scene of two axes: the substrate is rigid and the film incompressible.
const RIGID_SUBSTRATE: &str = "
    title      = 'Rigid substrate'
    tolerance  = 1e-5
    a_over_t   = { from = 0.1, to = 10 }
    e1_over_e2 = { from = 0.3, to = 3 }
    nu1        = 0.5
    e0_over_e2 = inf
";
/// A scene under a rigid sphere, normalised by `E1*`. The quantities grow steeply with `a/t` at the
/// end of the box, and its nodes are stated.
const RIGID_SPHERE: &str = "
    title      = 'Rigid sphere'
    tolerance  = 1e-5
    a_over_t   = { from = 0.1, to = 10, nodes_per_decade = 20 }
    e1_over_e2 = 0
    nu1        = { from = 0.3, to = 0.5 }
    e0_over_e2 = { from = 1, to = 100 }
";
/// A scene of one axis, `a/t`, and two quantities.
const TWO_QUANTITIES: &str = "
    title      = 'Two quantities'
    tolerance  = 1e-6
    quantities = ['delta0', 'eeq']
    a_over_t   = { from = 0.01, to = 100 }
    e1_over_e2 = 1.75
    nu1        = 0.5
    e0_over_e2 = 1e5
";
const TIGHT: &str = "
    title      = 'Solved to 1e-12'
    tolerance  = 1e-10
    a_over_t   = { from = 0.01, to = 100, nodes = 13 }
    e1_over_e2 = { from = 0.1, to = 10, nodes = 7 }
    nu1        = 0.5
    e0_over_e2 = 1e5
";
/// A scene whose films are thick on most of the range: the median error is a thousandth of the
/// largest.
const COARSE_AT_ONE_END: &str = "
    title      = 'Coarse at one end'
    tolerance  = 1e-1
    a_over_t   = { from = 1e-4, to = 10, nodes = 20 }
    e1_over_e2 = { from = 0.1, to = 10, nodes = 20 }
    nu1        = 0.5
    e0_over_e2 = inf
";
static FOUR_AXES: LazyLock<Table> = LazyLock::new(|| table(BOX));

/// Compares a table with direct solves at fresh random points. Its errors must be within the
/// tolerance and agree with the certificate.
fn assert_certified(table: &Table, seed: u64, points: usize) {
    let mut contacts = Contacts::new(seed);
    let mut errors: Vec<f64> = (0..points)
        .map(|_| {
            let (x, material) = contacts.point_of(table);
            error_at(table, x, &material)
        })
        .collect();
    errors.sort_by(f64::total_cmp);
    let (max, median) = (errors[points - 1], errors[points / 2]);
    let description = table.description();
    let certificate = &description.certificate;
    println!(
        "{}: {points} points: max {max:.1e}, median {median:.1e}; certified {:.1e}, {:.1e}; tolerance {:e}",
        description.title, certificate.max_error, certificate.median_error, description.tolerance
    );
    assert!(max <= description.tolerance);
    assert!(max <= BEYOND_CERTIFICATE * certificate.max_error);
    let medians = median / certificate.median_error;
    assert!((1.0 / MEDIANS..=MEDIANS).contains(&medians), "{medians}");
}

/// At the tightest tolerance the stored values are the solves to rounding, although all materials
/// share the panels of the quadrature.
#[test]
fn values_at_the_nodes_are_the_solves_to_rounding() {
    let table = table(TIGHT);
    let mut worst = 0.0;
    let (axes, values) = (
        Parameter::ALL.map(|parameter| table.axis(parameter)),
        Quantity::ALL.map(|q| table.values(q).expect("held")),
    );
    for (i, &x) in axes[0].iter().enumerate() {
        for (j, &e1) in axes[1].iter().enumerate() {
            let own = material([e1, 0.5, 1e5, 0.25]);
            let solution = solved(x, &own, 1e-12);
            let curve = table.curve(&own).expect("a node");
            for quantity in Quantity::ALL {
                let stored = values[quantity as usize][i * axes[1].len() + j];
                let interpolated = curve.quantity(quantity, x).expect("a node");
                for found in [stored, interpolated] {
                    worst = larger(worst, (found / solution.get(quantity) - 1.0).abs());
                }
            }
        }
    }
    println!("nodes of a tight table: largest difference from solves {worst:.1e}");
    // Measured: 4.2e-12; the pieces of the curve may add this much.
    assert!(worst <= 1e-11);
}

#[test]
fn a_table_keeps_tolerance_and_certificate_and_a_fixed_parameter_has_one_node() {
    let cases = [
        (BOX, "E2*", [false; 4]),
        (RIGID_SUBSTRATE, "E2*", [false, false, true, true]),
        (RIGID_SPHERE, "E1*", [false, true, false, false]),
        (TWO_QUANTITIES, "E2*", [false, true, true, true]),
    ];
    for (scene, unit, fixed) in cases {
        let table = table(scene);
        assert_eq!(table.shape().map(|n| n == 1), fixed, "{:?}", table.shape());
        assert_eq!(table.unit(), unit);
        assert_certified(&table, 53, 500);
    }
}

#[test]
fn only_the_quantities_of_the_scene_are_held_and_another_is_an_error_that_names_it() {
    let table = table(TWO_QUANTITIES);
    assert_eq!(table.quantities(), [Quantity::Eeq, Quantity::Delta0]);
    let curve = table
        .curve(&material([1.75, 0.5, 1e5, 0.25]))
        .expect("the scene's material");
    for quantity in Quantity::ALL {
        match (curve.quantity(quantity, 1.0), table.holds(quantity)) {
            (Ok(value), true) => assert!(value > 0.0),
            (Err(error @ Error::MissingQuantity(name)), false) => {
                assert_eq!(name, quantity.name());
                assert!(error.to_string().contains(name), "{error}");
            }
            other => panic!("{quantity:?}: {other:?}"),
        }
    }
    let contact =
        Contact::in_table(&table, &acceptance::paper_system(1e-6)).expect("the scene's material");
    assert!(contact.stiffness(1e-6).is_ok(), "eeq is all that it needs");
    let looked_up = curve.quantities(1.0).map(drop);
    for result in [
        looked_up.map_err(contact::Error::from),
        contact.load(1e-6, 0.04).map(drop),
        contact.load_and_penetration(1e-6, 0.04).map(drop),
    ] {
        let error = result.expect_err("pi0 is not held");
        let is_missing = matches!(error, contact::Error::Table(Error::MissingQuantity("pi0")));
        assert!(is_missing, "{error}");
    }
}

/// Also errors below the tolerance are found if they contradict the certificate.
#[test]
fn check_notices_a_table_that_is_not_as_accurate_as_it_says() {
    let mut sound = table(COARSE_AT_ONE_END);
    sound.set_certificate(certify(&sound, 1000, 1, &|_| {}).expect("within reach"));
    let workdir = workdir!();
    let tolerance = sound.description().tolerance;
    // Errors in parts of the tolerance: the median reveals the first, of all values, the largest error the second, of one.
    for (off, count, word) in [
        (0.0, 0, None),
        (0.03, usize::MAX, Some("its median error is")),
        (2.0, 1, Some("its error is")),
    ] {
        let factor = |i| {
            if i < count {
                1.0 + off * tolerance
            } else {
                1.0
            }
        };
        let table = forged(&sound, |_, i, value| factor(i) * value, |_| ());
        let table = table.expect("sound values");
        write_hdf5(&table, &workdir.path("table.h5"));
        workdir.pack("table.bin", &table);
        for file in ["table.h5", "table.bin"] {
            let run = workdir.run(format!("check {file} --points 1000"));
            assert_eq!(run.status, i32::from(word.is_some()), "{run:?}");
            if let Some(word) = word {
                let words = "is less accurate than it states; --certificate-points 10000`";
                assert_names(&run.stderr, &format!("{word}; {words}"));
            }
        }
        let run = workdir.run("check table.bin --points 1000 --json");
        let found: serde_json::Value = serde_json::from_str(&run.stdout).expect("JSON");
        assert_eq!(found["holds"], word.is_none(), "{run:?}");
    }
}

#[test]
fn a_tolerance_or_a_certificate_without_sense_is_malformed() {
    let refused = |change: fn(&mut Description, f64), number: f64, words: &str| {
        let forged = forged(
            &FOUR_AXES,
            |_, _, value| value,
            |sound| change(sound, number),
        );
        assert!(matches!(forged, Err(Error::Malformed(_))), "{forged:?}");
        forged.refused(words);
    };
    for tolerance in [0.0, -1e-6, 1.5, f64::NAN, f64::INFINITY] {
        let words = format!("its tolerance is {tolerance:?}");
        refused(
            |sound, tolerance| sound.tolerance = tolerance,
            tolerance,
            &words,
        );
    }
    let certificate = FOUR_AXES.description().certificate;
    let [most, few] = [certificate.max_error, certificate.p999_error].map(|error| 2.0 * error);
    let words = "its certificate has; median_error <= p999_error <= max_error";
    refused(
        |sound, most| sound.certificate.p999_error = most,
        most,
        words,
    );
    refused(
        |sound, few| sound.certificate.median_error = few,
        few,
        words,
    );
}

#[test]
fn the_shipped_table_is_the_same_in_both_forms_and_as_accurate_as_it_says() {
    let hdf5 = Table::open(shipped("paper.h5")).expect("a sound table");
    let packed = Table::read(shipped("paper.bin")).expect("a sound table");
    assert_eq!(hdf5.description(), packed.description());
    assert_eq!(all_bits(&hdf5), all_bits(&packed));
    let description = packed.description();
    let scene = std::fs::read_to_string(shipped("paper.toml")).expect("the scene is beside it");
    assert_eq!(description.scene, scene);
    let certificate = description.certificate;
    let is_kept = certificate.points >= 1000 && certificate.max_error <= description.tolerance;
    assert!(is_kept, "{certificate:?}");
    assert_certified(&packed, 54, 300);
}

#[test]
fn a_material_on_another_substrate_poisson_ratio_is_looked_up_as_its_equivalent() {
    let table = &*FOUR_AXES;
    let mut contacts = Contacts::new(55);
    let (mut worst, mut furthest, mut count) = (0.0, 0.0_f64, 0);
    while count < 300 {
        let (x, inside) = contacts.point_of(table);
        let nu0 = contacts.uniform(-0.5, 0.5);
        // The original is found from an equivalent inside the box.
        let Ok(original) = inside.with_substrate_poisson_ratio(nu0) else {
            continue;
        };
        worst = larger(worst, error_at(table, x, &original));
        furthest = furthest.max((original.nu1() - inside.nu1()).abs());
        count += 1;
    }
    println!("{count} {worst:.1e} {furthest:.3}");
    assert!(worst <= BEYOND_CERTIFICATE * table.description().certificate.max_error);
    assert!(
        furthest > 0.01,
        "the films must differ for the comparison to mean anything"
    );
}

/// Values at the ends of the coordinates, near them and between them.
#[test]
fn values_are_those_of_their_coordinates() {
    let ends = [
        (Parameter::E1sOverEinfs, 1e-10),
        (Parameter::E0sOverE2s, 1e-11),
    ];
    for (parameter, end) in ends {
        assert_eq!(parameter.coordinate(0.0), f64::ln(end));
        assert_eq!(parameter.value(f64::ln(end).next_down()), 0.0);
    }
    let moduli = [0.0, 1e-13, 1e-11, 1e-10, 1e-3, 1.0, 1e3, 1e11];
    let ratios = [-0.5, 0.0, 0.3, 0.499_999, 0.5];
    for (parameter, values) in [
        (Parameter::AOverT, &moduli[4..7]),
        (Parameter::E1sOverEinfs, &moduli),
        (Parameter::E0sOverE2s, &moduli),
        (Parameter::Nu1, &ratios),
    ] {
        for &value in values {
            let coordinate = parameter.coordinate(value);
            let off = parameter.coordinate(parameter.value(coordinate)) - coordinate;
            assert!(
                off.abs() < 1e-10,
                "{} = {value:e}: {off:e}",
                parameter.name()
            );
        }
    }
}
