//! `tabulate cost lookup`: its errors against errors of loads in newtons, and its files.

use contact::Contact;
use std::f64::consts::PI;
use std::sync::LazyLock;

use acceptance::{
    Refused, assert_close, assert_names, low_rank, shipped, solid, system_of, table, workdir,
};
use cost::clock::Timing;
use cost::lookup::{POINTS, Row, SEED, markdown, measure};
use cost::{Measured, to_csv};
use interp::{Probe, Table};
use tabulate::measure::read_csv;
use tabulate::table::random_points;

use crate::solved;

/// The rows of the paper's table, which is dense.
static ROWS: LazyLock<Vec<Row>> = LazyLock::new(|| measured(&paper(), COUNT));
const COUNT: usize = 51;

/// A table that has a low-rank form.
const SMALL: &str = "
    title      = 'A small box'
    tolerance  = 1e-4
    a_over_t   = { from = 0.1, to = 10, nodes = 20 }
    e1_over_e2 = { from = 0.3, to = 3, nodes = 10 }
    nu1        = 0.5
    e0_over_e2 = 10
";

fn paper() -> Table {
    Table::read(shipped("paper.bin")).expect("it comes with the project")
}

/// Measures at random points of the table's box.
fn tried(table: &Table, points: usize) -> Result<Measured<Row>, solve::Error> {
    let points = random_points(table, points, SEED);
    measure(table, &points, Timing::Brief, &|_| {})
}

fn measured(table: &Table, points: usize) -> Vec<Row> {
    let measured = tried(table, points);
    measured.expect("the solve reaches all of the box").rows
}

/// The first row of a form.
fn of<'a>(rows: &'a [Row], form: &str) -> &'a Row {
    let mut rows = rows.iter();
    rows.find(|row| row.form == form).expect("it is measured")
}

/// Returns the median and the largest of an odd number of errors.
fn median_and_largest(mut errors: Vec<f64>) -> [f64; 2] {
    errors.sort_by(f64::total_cmp);
    [errors[errors.len() / 2], errors[errors.len() - 1]]
}

#[test]
fn errors_are_those_of_loads_in_newtons() {
    let table = paper();
    let (mut bulk, mut looked_up_errors) = ([const { Vec::new() }; 2], [const { Vec::new() }; 2]);
    for (x, material) in random_points(&table, COUNT, 1) {
        let (t, r, unit) = (2e-6, 3e-3, 5e6);
        let solid = |ratio: f64, nu: f64| solid(ratio * unit, nu);
        let system = system_of(
            Probe::Paraboloid { radius: r },
            unit,
            solid(material.e1_over_e2(), material.nu1()),
            t,
            solid(material.e0_over_e2(), material.nu0()),
        );
        let contact = Contact::in_table(&table, &system).expect("inside");
        let a = x * t;
        let q = solved(x, &material, 1e-12).quantities;
        // Eq. 9, and the work of adhesion at which its second term is half of the first.
        let press = a.powi(3) * unit * q.pi0 / (2.0 * r);
        let pull = |w: f64| {
            4.0 * a * q.eeq / q.gamma
                * (0.5 * PI * a * w * unit * material.sphere_film_modulus()).sqrt()
        };
        let w = (0.5 * press / pull(1.0)).powi(2);
        let compound =
            1.0 / (1.0 / unit + (1.0 - material.nu0().powi(2)) / (unit * material.e0_over_e2()));
        let jkr = |w: f64| {
            4.0 * compound * a.powi(3) / (3.0 * r) - (8.0 * PI * w * compound * a.powi(3)).sqrt()
        };
        let looked_up = |w: f64| contact.load(a, w).expect("inside");
        for (i, w) in [0.0, w].into_iter().enumerate() {
            let truth = press - pull(w);
            bulk[i].push((jkr(w) / truth - 1.0).abs());
            looked_up_errors[i].push((looked_up(w) / truth - 1.0).abs());
        }
    }
    for (form, errors, rounding) in [
        ("bulk JKR, film ignored", bulk, 1e-9),
        ("dense table", looked_up_errors, 1e-3),
    ] {
        let row = of(&ROWS, form);
        let [[median, largest], [adhesive_median, adhesive_largest]] =
            errors.map(median_and_largest);
        let adhesive = |error: Option<f64>| error.expect("the form has adhesion");
        for (found, expected) in [
            (row.median_error, median),
            (row.max_error, largest),
            (adhesive(row.adhesive_median_error), adhesive_median),
            (adhesive(row.adhesive_max_error), adhesive_largest),
        ] {
            // An error near 1e-12 is that of the truth itself.
            assert_close(found, expected, rounding + 3e-12 / expected);
        }
    }
}

#[test]
fn two_runs_differ_in_their_times_alone() {
    let timeless = |mut rows: Vec<Row>| {
        rows.iter_mut().for_each(|row| row.seconds = 0.0);
        rows
    };
    assert_eq!(timeless(ROWS.clone()), timeless(measured(&paper(), COUNT)));
}

#[test]
fn every_form_is_there_and_what_is_written_is_read() {
    let dense = table(SMALL);
    let rows = measured(&low_rank(&dense, 1e-7), 21);
    for row in &rows {
        assert!(row.seconds > 0.0 && row.points == 21, "{row:?}");
        assert!(row.median_error > 0.0, "{row:?}");
        assert!(row.median_error <= row.max_error, "{row:?}");
        let has_adhesion = row.adhesive_max_error.is_some();
        assert_eq!(has_adhesion, row.at == "contact radius", "{row:?}");
        // A load that is too large by an error of 1 or more has at least the factor of that error.
        let is_large = row.max_error >= 1.0;
        let least = if is_large { 1.0 + row.max_error } else { 1.0 };
        assert!(row.max_factor >= least, "{row:?}");
    }
    let summary = markdown(&rows);
    let tables =
        "packed table; dense table; linear in 4-D; linear along; cubic along; direct solve to 1e-6";
    let closed =
        "bulk JKR; film JKR; Gao 1992; Hay and Crawford; Hertz; Dimitriadis 2002; Garcia 2018";
    assert_names(&summary, tables);
    assert_names(&summary, closed);
    for line in summary.lines() {
        assert_eq!(line.matches('|').count(), 8, "{line}");
    }
    // The packed table and its expansion have the same splines.
    let [packed, dense] = ["packed table", "dense table"].map(|form| of(&rows, form).max_error);
    assert_close(packed, dense, 0.05);
    let workdir = workdir!();
    let file = workdir.write("rows.csv", to_csv(&rows));
    assert_eq!(read_csv::<Row>(&file).expect("its own"), rows);
    workdir.succeed("plot lookup-cost --data rows.csv -o lookup-cost.svg");
    assert!(workdir.read("lookup-cost.svg").starts_with(b"<svg"));
}

#[test]
fn the_series_for_layers_are_worse_the_thinner_the_layer() {
    let errors = |form: &str| -> Vec<f64> {
        let of_form = ROWS.iter().filter(|row| row.form == form);
        of_form.map(|row| row.max_error).collect()
    };
    for form in ["Dimitriadis 2002, eq. 12", "Garcia 2018"] {
        let [thick, thin] = errors(form)[..] else {
            panic!("two scopes of {form}")
        };
        assert!(thick < 0.2 && thin > thick, "{form}: {thick}, {thin}");
    }
}

#[test]
fn a_table_without_all_quantities_is_an_error_that_names_one() {
    let scene = "title = \"t\"\ntolerance = 1e-3\nquantities = [\"pi0\"]\na_over_t = { from = 0.1, to = 1 }\n\
                 e1_over_e2 = 1\nnu1 = 0.3\ne0_over_e2 = 10\nnu0 = 0.25\n";
    tried(&table(scene), 3).refused("eeq");
}

#[test]
fn the_command_prints_a_summary_and_writes_all_rows() {
    let workdir = workdir!();
    let table = shipped("paper.bin").display().to_string();
    let summary = workdir.succeed(format!("cost lookup {table} -o lookup.csv"));
    let rows: Vec<Row> = read_csv(&workdir.path("lookup.csv")).expect("its own");
    assert_eq!(summary, markdown(&rows));
    assert!(rows.iter().any(|row| row.points == POINTS as u64));
    workdir.refuses("1 | cost lookup missing.bin | missing.bin");
}

#[test]
fn direct_solves_keep_their_tolerances() {
    for tolerance in [1e-2, 1e-4, 1e-6, 1e-9] {
        let row = of(&ROWS, &format!("direct solve to {tolerance:e}"));
        assert!(row.max_error <= tolerance, "{row:?}");
    }
}
