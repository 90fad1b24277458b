//! `tabulate cost lookup`: its errors against errors of loads in newtons, and its files.

use contact::Contact;
use std::f64::consts::PI;
use std::sync::LazyLock;

use acceptance::{assert_names, low_rank, shipped, solid, table, workdir};
use cost::clock::Timing;
use cost::lookup::{POINTS, Row, SEED, markdown, measure};
use cost::{Measured, to_csv};
use interp::{Probe, System, Table};
use solve::solve;
use tabulate::measure::read_csv;
use tabulate::table::random_points;

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
    tried(table, points)
        .expect("the solve reaches all of the box")
        .rows
}

/// The first row of a form.
fn of<'a>(rows: &'a [Row], form: &str) -> &'a Row {
    rows.iter()
        .find(|row| row.form == form)
        .expect("the form is measured")
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
        let system = System {
            probe: Probe::Paraboloid { radius: r },
            sphere_modulus: unit,
            film: solid(material.e1_over_e2(), material.nu1()),
            film_thickness: t,
            substrate: solid(material.e0_over_e2(), material.nu0()),
        };
        let contact = Contact::in_table(&table, &system).expect("inside");
        let a = x * t;
        let q = solve(x, &material, 1e-12)
            .expect("a benign contact")
            .quantities;
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
            println!("{form}: {found:.3e}, in newtons {expected:.3e}");
            // An error near 1e-12 is that of the truth itself.
            assert!(
                (found / expected - 1.0).abs() <= rounding + 3e-12 / expected,
                "{form}: {found}, not {expected}"
            );
        }
    }
}

#[test]
fn two_runs_differ_in_their_times_alone() {
    let timeless = |rows: &[Row]| {
        rows.iter()
            .map(|row| Row {
                seconds: 0.0,
                ..row.clone()
            })
            .collect::<Vec<_>>()
    };
    assert_eq!(timeless(&ROWS), timeless(&measured(&paper(), COUNT)));
}

#[test]
fn every_form_is_there_and_what_is_written_is_read() {
    let dense = table(SMALL);
    let rows = measured(&low_rank(&dense, 1e-7), 21);
    for row in &rows {
        assert!(
            row.seconds > 0.0 && row.median_error <= row.max_error && row.points == 21,
            "{row:?}"
        );
        assert!(row.median_error > 0.0 && row.max_factor >= 1.0, "{row:?}");
        assert_eq!(
            row.adhesive_max_error.is_some(),
            row.at == "contact radius",
            "{row:?}"
        );
        // A load that is too large by an error of 1 or more has at least the factor of that error.
        assert!(
            row.max_error < 1.0 || row.max_factor >= 1.0 + row.max_error,
            "{row:?}"
        );
    }
    let summary = markdown(&rows);
    let tables = [
        "packed table",
        "dense table",
        "linear in 4-D",
        "linear along",
        "cubic along",
        "direct solve to 1e-6",
    ];
    let closed = [
        "bulk JKR",
        "film JKR",
        "Gao 1992",
        "Hay and Crawford",
        "Hertz",
        "Dimitriadis 2002",
        "Garcia 2018",
    ];
    assert_names(&summary, &tables);
    assert_names(&summary, &closed);
    assert!(
        summary.lines().all(|line| line.matches('|').count() == 8),
        "{summary}"
    );
    // The packed table and its expansion have the same splines.
    assert!(
        (of(&rows, "packed table").max_error / of(&rows, "dense table").max_error - 1.0).abs()
            <= 0.05
    );
    let workdir = workdir!();
    let file = workdir.write("rows.csv", to_csv(&rows));
    assert_eq!(read_csv::<Row>(&file).expect("its own"), rows);
    workdir.succeed("plot lookup-cost --data rows.csv -o lookup-cost.svg");
    assert!(workdir.read("lookup-cost.svg").starts_with(b"<svg"));
}

#[test]
fn the_series_for_layers_are_worse_the_thinner_the_layer() {
    let errors = |form: &str| {
        ROWS.iter()
            .filter(|row| row.form == form)
            .map(|row| row.max_error)
            .collect::<Vec<f64>>()
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
    let error = tried(&table(scene), 3).expect_err("eeq is missing");
    assert_names(&error.to_string(), &["eeq"]);
}

#[test]
fn the_command_prints_a_summary_and_writes_all_rows() {
    let workdir = workdir!();
    let table = shipped("paper.bin").display().to_string();
    let summary = workdir.succeed(format!("cost lookup {table} -o lookup.csv"));
    let rows: Vec<Row> = read_csv(&workdir.path("lookup.csv")).expect("its own");
    assert_eq!(summary, markdown(&rows));
    assert!(rows.iter().any(|row| row.points == POINTS as u64));
    let message = workdir.fail(1, "cost lookup missing.bin");
    assert_names(&message, &["missing.bin"]);
}

#[test]
fn direct_solves_keep_their_tolerances() {
    for tolerance in ["1e-2", "1e-4", "1e-6", "1e-9"] {
        let form = format!("direct solve to {tolerance}");
        let row = of(&ROWS, &form);
        assert!(
            row.max_error <= tolerance.parse().expect("a number"),
            "{row:?}"
        );
    }
}
