//! The word `embedded` in place of a table.

use std::path::Path;

use acceptance::{assert_names, shipped, table, workdir};
use interp::Table;

use crate::TWO_QUANTITIES;

#[test]
fn embedded_is_the_table_that_is_compiled_in() {
    let workdir = workdir!();
    let file =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../crates/interp/embedded/universal.bin");
    let (path, points) = (file.to_str().expect("UTF-8"), shipped("points.csv"));
    let commands = [
        &format!("query TABLE --points {} --gradient", points.display()),
        "curve TABLE --points 20",
        "info TABLE",
        "info TABLE --json",
        "check TABLE --points 50",
        "check TABLE --points 50 --json",
    ];
    for command in commands {
        let of = |table: &str| workdir.succeed(command.replace("TABLE", table));
        assert_eq!(of("embedded"), of(path), "{command:?}");
    }
    // A command of `report --help`.
    let punch = "report embedded --probe flat-punch --sphere-radius 1e-5";
    workdir.succeed(format!("{punch} -o punch.html"));
    workdir.succeed("pack embedded -o packed.bin");
    assert!(workdir.read("packed.bin") == std::fs::read(&file).expect("it is there"));
    let read = Table::read(&file).expect("a sound table");
    assert_eq!(Table::embedded().description(), read.description());
}

/// The table holds ratios of reduced moduli, which no user gives.
#[test]
fn a_ratio_of_reduced_moduli_outside_the_table_is_explained() {
    let workdir = workdir!();
    workdir.write_points("1,1e12,0.3,1\n");
    workdir.refuses("1 | query embedded --points points.csv | line 2; e1s_over_einfs is the reduced modulus of the film; tabulate solve");
}

#[test]
fn a_file_of_that_name_is_reached_with_its_folder() {
    let workdir = workdir!();
    workdir.pack("embedded", &table(TWO_QUANTITIES));
    assert_names(&workdir.succeed("info ./embedded"), &["Two quantities"]);
    let title = &Table::embedded().description().title;
    assert_names(&workdir.succeed("info embedded"), &[title]);
}

/// The word spelled wrong, a value without its option, and a missing file.
#[test]
fn what_names_no_table_is_told_what_does() {
    let workdir = workdir!();
    for wrong in ["embed", "Embedded", "10um", "table.bin"] {
        for command in [
            &format!("info {wrong}"),
            &format!("curve {wrong}"),
            &format!("query {wrong} --points none.csv"),
        ] {
            let words = format!("no table {wrong}; No such file; the word `embedded`");
            workdir.refuses(format!("1 | {command} | {words}"));
        }
    }
}

#[test]
fn every_help_with_a_table_says_so() {
    let workdir = workdir!();
    let commands = "query, curve, info, check, report, pack, unpack, plot error-map, cost lookup";
    for command in commands.split(", ") {
        let help = workdir.succeed(format!("{command} --help"));
        assert_names(&help, "the word `embedded`; ./embedded");
    }
}
