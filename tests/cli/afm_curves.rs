//! Measured AFM curves: the test data of the Python package afmformats (MIT), fetched when the
//! tests run and exported to columns by this package.
//!
//! No radius of a sphere and no sample is known, so that the moduli mean nothing: the curves test
//! that files are read, and that each is fitted or refused with a reason.

use std::env;
use std::path::{Path, PathBuf};

use acceptance::{Case, Data, Workdir, output, python, workdir};
use fit::data::{Format, read};
use serde_json::Value;

/// What `tabulate fit` makes of a curve, a row of `tests/data/afm_curves.csv`: the curve, the outcome (`fitted`, `not
/// converged`, `refused` or `not exported`) and the kinds of the warnings of a fit, or the reason; modulus and work of
/// adhesion in SI units, of a fit that determines both.
type Row = ([String; 3], Option<[f64; 2]>);

type Outcome = (&'static str, Option<[f64; 2]>, String);

/// The columns of the recorded values.
const HEADER: &str = "curve,outcome,film_modulus,work_of_adhesion,text";

fn csv(([curve, outcome, text], values): &Row) -> String {
    let values = values.map(|values| values.map(|value| format!("{value:.4e}")));
    let [modulus, work] = values.unwrap_or_default();
    format!("{curve},{outcome},{modulus},{work},{text}")
}

fn recorded(case: &Case<'_>) -> Row {
    let value = |name: &str| case.text(name).parse().ok();
    let values = value("film_modulus").zip(value("work_of_adhesion"));
    let texts = ["curve", "outcome", "text"].map(|name| case.text(name).into());
    (texts, values.map(|(modulus, work)| [modulus, work]))
}

/// Tells whether two rows agree but for what depends on the rounding of the processor: the last digits of values, and
/// the list of the points of a refusal, some of which rounding moves from one place to another.
fn alike(one: &Row, other: &Row) -> bool {
    const DIFFERENCE: f64 = 1e-3;
    let reason = |([curve, outcome, text], _): &Row| {
        let sentences = if outcome == "refused" { 3 } else { usize::MAX };
        let text = text.split(": ").take(sentences).collect::<String>();
        [curve.clone(), outcome.clone(), text]
    };
    let near = |(a, b): (f64, f64)| (a - b).abs() <= DIFFERENCE * b.abs();
    let are_near = match (one.1, other.1) {
        (Some(one), Some(other)) => one.into_iter().zip(other).all(near),
        (one, other) => one == other,
    };
    are_near && reason(one) == reason(other)
}

/// Fits an exported curve. Returns the last three fields of its row.
fn fit(workdir: &Workdir, curve: &str, file: &str, stiffness: &str) -> Outcome {
    let known = match stiffness {
        "" => String::new(),
        _ => format!("--stiffness {stiffness}"),
    };
    let system = "--half-space --sphere-modulus inf --film-poisson-ratio 0.5 --sphere-radius 2e-5";
    let run = workdir.run(format!("fit {file} --json {system} {known}"));
    assert!(
        !run.stderr.contains("panicked") && run.status < 2,
        "{curve}: {run:?}"
    );
    let reason = |text: &str| text.trim().replace(file, "FILE").replace(',', ";");
    let Ok(object) = serde_json::from_str::<Value>(&run.stdout) else {
        assert_eq!(run.status, 1, "{run:?}");
        // Warnings that may tell why a value is impossible come below.
        let first = run.stderr.lines().next();
        return ("refused", None, reason(first.expect("a reason")));
    };
    let converged = object["converged"].as_bool().expect("true or false");
    assert_eq!(converged, run.status == 0, "{curve}: {run:?}");
    let warnings = object["warnings"].as_array().expect("a list");
    let mut kinds: Vec<&str> = warnings
        .iter()
        .filter_map(|warning| warning["kind"].as_str())
        .collect();
    kinds.dedup();
    assert_eq!(converged, !kinds.contains(&"not-converged"), "{kinds:?}");
    if !converged {
        // Where such a fit stops depends on the rounding of the processor.
        return ("not converged", None, String::new());
    }
    let value = |name: &str| object["parameters"][name]["value"].as_f64();
    let values = value("film_modulus").zip(value("work_of_adhesion"));
    let values = values.map(|(modulus, work)| [modulus, work]);
    let values = values.filter(|_| !kinds.contains(&"undetermined"));
    ("fitted", values, kinds.join(" "))
}

const SCRIPT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/cli/export_curves.py");

/// Exports the curves to a folder. Returns a line for each curve; none without the source of afmformats.
fn export(workdir: &Workdir) -> Option<(PathBuf, String)> {
    let Some(source) = env::var_os("AFMFORMATS_SOURCE") else {
        println!("skipped: `cargo xtask test` fetches the measured curves of afmformats");
        return None;
    };
    let files = Path::new(&source).join("tests/data");
    let list = output(python().arg(SCRIPT).arg(&files).arg(workdir.path("")));
    Some((files, String::from_utf8(list).expect("UTF-8")))
}

/// Both turn the height round, because the file's grows towards the sample.
#[test]
fn a_file_of_an_instrument_is_read_as_afmformats_reads_it() {
    /// Digits of the exported text.
    const DIFFERENCE: f64 = 1e-7;
    let workdir = workdir!();
    let Some((files, _)) = export(&workdir) else {
        return;
    };
    let name = "fmt-afm-workshop-fd_single_2020-02-14_13.41.25.csv";
    let direct = read(&files.join(name), &Format::default()).expect("a sound file");
    let exported = workdir.path(&format!("{name}.0.tab"));
    let exported = read(&exported, &Format::default()).expect("a sound file");
    let [direct, exported] = [direct, exported].map(|reading| reading.measurement.points);
    assert_eq!((direct.len(), exported.len()), (2030, 2030));
    for (a, b) in direct.iter().zip(&exported) {
        assert_eq!(a.direction, b.direction);
        for (a, b) in [(a.abscissa, b.abscissa), (a.ordinate, b.ordinate)] {
            assert!((a - b).abs() <= DIFFERENCE * b.abs(), "{a} and {b}");
        }
    }
}

/// The regression values of `tests/data/afm_curves.csv` come from this test, which prints them.
#[test]
fn every_curve_is_fitted_or_refused_with_a_reason() {
    let workdir = workdir!();
    let Some((_, list)) = export(&workdir) else {
        return;
    };
    let row = |line: &str| {
        let cells: Vec<&str> = line.split('\t').collect();
        let [file, number, stiffness, exported] = cells[..] else {
            panic!("{line:?} has four cells");
        };
        let curve = format!("{file} {number}").trim().replace(',', ";");
        let (outcome, values, text) = match exported {
            "" => ("not exported", None, stiffness.into()),
            _ => fit(&workdir, &curve, exported, stiffness),
        };
        ([curve, outcome.into(), text], values)
    };
    let rows: Vec<Row> = list.lines().map(row).collect();
    println!("{HEADER}");
    for row in &rows {
        println!("{}", csv(row));
    }
    let data = Data::read("afm_curves");
    assert_eq!(data.columns().join(","), HEADER);
    let recorded: Vec<Row> = data.cases().map(|case| recorded(&case)).collect();
    assert_eq!(rows.len(), recorded.len(), "the number of curves");
    for (row, before) in rows.iter().zip(&recorded) {
        assert!(alike(row, before), "{row:?} was {before:?}");
    }
}
