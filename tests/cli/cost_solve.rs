//! `tabulate cost solve`: its errors, sizes and methods against those of solves, and its files.

use acceptance::{Data, larger, relative_error, workdir};
use cost::clock::Timing;
use cost::nystrom::Nystrom;
use cost::solve::{NYSTROM, REFUSED, Row, TOLERANCES, contacts, markdown, measure};
use cost::to_csv;
use interp::Quantities;
use solve::solve;
use tabulate::measure::read_csv;

/// The solve refuses no tolerance from here on (`tests/truth/hard_cases.rs`).
const ANSWERED: f64 = 1e-9;

/// Compares the contacts that other references have, too. The Poisson ratio of a rigid base has no
/// meaning.
#[test]
fn the_truth_is_that_of_the_other_references() {
    let files = ["barthel_reference", "contacts", "hard_cases"].map(Data::read);
    let mut common = 0;
    for contact in contacts() {
        let same = |case: &acceptance::Case<'_>| {
            let material = case.material();
            case.get("a_over_t") == contact.a_over_t
                && material.e1_over_e2() == contact.e1_over_e2
                && material.nu1() == contact.nu1
                && material.e0_over_e2() == contact.e0_over_e2
                && (material.nu0() == contact.nu0 || contact.e0_over_e2 == f64::INFINITY)
        };
        for case in files.iter().flat_map(Data::cases).filter(same) {
            assert!(case.get("digits_agreed") >= 17.0);
            let error = relative_error(&contact.truth(), &case.quantities());
            assert!(error <= f64::EPSILON, "{contact:?}: {error:e}");
            common += 1;
        }
    }
    assert!(common >= 4, "{common}");
}

/// Nyström's method solves the right equation. It shares only `X` and the panels in `q` with the
/// solve.
#[test]
fn nystroms_method_converges_to_values_from_elsewhere() {
    let data = Data::read("barthel_reference");
    let (mut worst, mut count) = (0.0, 0);
    for case in data.cases().filter(|case| case.get("a_over_t") <= 30.0) {
        let x = case.get("a_over_t");
        let error = |size: f64| {
            let found = Nystrom::new(size as usize).solve(x, &case.material(), 1e-14);
            relative_error(&found, &case.quantities())
        };
        let (few, many) = (error(4.0 + x), error(48.0 + 6.0 * x));
        assert!(many <= few.max(1e-12), "{case:?}: {few:.1e}, {many:.1e}");
        (worst, count) = (larger(worst, many), count + 1);
    }
    println!("{count} contacts: at most {worst:.1e}");
    assert!(count >= 20);
    // Measured: 1.0e-13, a soft film at a/t = 10.
    assert!(worst <= 2e-12);
}

#[test]
fn rows_have_errors_within_tolerances_that_are_the_same_in_every_run() {
    let workdir = workdir!();
    let rows = measure(Timing::Brief, &|| {});
    assert!(rows.iter().all(|row| row.seconds > 0.0));
    let file = workdir.write("solve.csv", to_csv(&rows));
    let text = workdir.text("solve.csv");
    let header = "contact,a_over_t,e1_over_e2,nu1,e0_over_e2,nu0,method,tolerance,size,error_estimated,error,seconds";
    assert_eq!(text.lines().next(), Some(header));
    assert_eq!(text.lines().count(), rows.len() + 1);
    assert_eq!(read_csv::<Row>(&file).expect("its own"), rows);
    let printed = workdir.succeed("cost solve --data solve.csv");
    assert_eq!(printed, markdown(&rows));

    for name in ["one.svg", "two.svg", "one.png"] {
        let plot = format!("plot work-precision --data solve.csv -o {name}");
        assert_eq!(workdir.succeed(plot), "");
    }
    let drawn = workdir.read("one.svg");
    assert!(drawn.starts_with(b"<svg") && drawn == workdir.read("two.svg"));
    assert!(workdir.read("one.png").starts_with(b"\x89PNG"));

    for contact in contacts() {
        let of_contact =
            |row: &&Row| row.contact == contact.contact && row.a_over_t == contact.a_over_t;
        let of_contact = rows.iter().filter(of_contact);
        let (nystrom, own): (Vec<&Row>, Vec<&Row>) =
            of_contact.partition(|row| row.method == NYSTROM);
        let tolerances: Vec<f64> = own.iter().map(|row| row.tolerance).collect();
        assert_eq!(tolerances, TOLERANCES);
        // To rounding.
        let error_of =
            |found: &Quantities| relative_error(found, &contact.truth()).max(0.5 * f64::EPSILON);
        for row in &own {
            let estimated = row.error_estimated.expect("every solve has an estimate");
            match solve(contact.a_over_t, &contact.material(), row.tolerance) {
                Ok(solution) => {
                    let error = row.error.expect("an answer has one");
                    assert_eq!(error, error_of(&solution.quantities));
                    assert_eq!(row.method, solution.method.name());
                    assert_eq!(row.size, solution.modes as u64);
                    assert!(error <= estimated && estimated <= row.tolerance, "{row:?}");
                }
                Err(_) => {
                    let found = (&*row.method, row.error, row.size);
                    assert_eq!(found, (REFUSED, None, 0));
                    assert!(row.tolerance < ANSWERED, "{row:?}");
                    assert!(estimated > row.tolerance, "{row:?}");
                }
            }
        }
        for row in &nystrom {
            let (x, material) = (contact.a_over_t, contact.material());
            let solved = Nystrom::new(row.size as usize).solve(x, &material, row.tolerance);
            assert_eq!(row.error, Some(error_of(&solved)));
        }
        // The largest number of nodes suffices as far as double precision allows. The solve refuses
        // tolerances beyond that.
        let refused = own.iter().filter(|row| row.method == REFUSED);
        let refused = refused.map(|row| row.tolerance).reduce(f64::max);
        let reached = nystrom.iter().filter_map(|row| row.error).reduce(f64::min);
        let suffices = reached.is_none_or(|error| error <= refused.unwrap_or(1e-13));
        assert!(suffices, "{contact:?}: {reached:?}");
        assert_eq!(reached.is_some(), contact.a_over_t <= 100.0);
    }
}
