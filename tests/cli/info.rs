//! `tabulate info`, and the JSON objects of all commands.

use acceptance::{assert_names, number, table, workdir};
use interp::{Parameter, Quantity, SubstratePoissonRatio, Table};
use serde_json::Value;

use crate::{TWO_QUANTITIES, paper_table};

#[test]
fn info_prints_axes_quantities_and_certificate() {
    let workdir = workdir!();
    let table_path = paper_table();
    let table = Table::read(&table_path).expect("a sound table");
    let description = table.description();
    let certificate = &description.certificate;
    let held = |error: Option<f64>| error.expect("all quantities are held");
    let identities = certificate.identity_errors.map(held);
    let [n_a, n_e1, _, _] = table.shape();
    let [energy, stiffness, penetration, load] = identities.map(|error| format!("{error:.1e}"));
    let text = workdir.succeed(format!("info {table_path}"));
    let expected = format!(
        "title {}
         a_over_t 0.001 to 1000, {n_a} nodes
         e1_over_e2 0.01 to 100, {n_e1} nodes
         nu1 0.5
         e0_over_e2 100000
         nu0 0.25
         quantities pi0, eeq, gamma, delta0 (normalised by E2*)
         tolerance 1e-9
         certified error max {:.1e}, 99.9 % {:.1e}, median {:.1e}
         worst {} at a_over_t = {}
         identities Gamma^2 = es (x Eeq)' {energy}, F0' = S delta0' {stiffness}, \
         delta0' = (2/R) S/S' {penetration}, F0' = (2/R) S^2/S' {load}
         created by {}
         size {}",
        description.title,
        certificate.max_error,
        certificate.p999_error,
        certificate.median_error,
        certificate.worst_quantity.name(),
        certificate.worst_point[0],
        description.created_by,
        table.to_packed().expect("it was packed").len()
    );
    let (rows, meanings) = text.split_once("\n\nThe rows mean:\n").expect("two parts");
    assert_eq!(rows.lines().count(), expected.lines().count(), "{text}");
    for (line, expected) in rows.lines().zip(expected.lines()) {
        let words: Vec<&str> = line.split_whitespace().collect();
        let is_there = words.join(" ").starts_with(expected.trim());
        assert!(is_there, "{line}: {expected}");
    }
    assert_names(meanings, &Parameter::ALL.map(Parameter::long_name));
    let [points, seed] = [certificate.points, certificate.seed];
    assert_names(&text, &format!("{points} direct solves, seed {seed}"));
    workdir.pack("small.bin", &self::table(TWO_QUANTITIES));
    let words = "eeq, delta0 (normalised by E2*); inf";
    assert_names(&workdir.succeed("info small.bin"), words);
}

#[test]
fn the_embedded_table_states_what_it_answers_and_explains_its_rows() {
    let workdir = workdir!();
    let text = workdir.succeed("info embedded");
    let (rows, meanings) = text.split_once("\n\nThe rows mean:\n").expect("two parts");
    assert_names(
        rows,
        &["gamma; pi0, eeq, delta0 follow from gamma (normalised by Es*)"],
    );
    // Every name of a row has a meaning, except for those that explain themselves.
    for row in rows.lines() {
        let name = row[..15].trim_end();
        let plain = ["title", "quantities", "created by", "size"].contains(&name);
        let explained = |line: &str| line.starts_with(&format!("{name:15} "));
        let count = meanings.lines().filter(|line| explained(line)).count();
        assert_eq!(count, usize::from(!plain), "{name}");
    }
    for quantity in Quantity::ALL {
        assert_names(meanings, &[quantity.name(), quantity.equation()]);
    }
    let object = workdir.json("info embedded --json");
    assert_eq!(object["quantities"], serde_json::json!(["gamma"]));
    let all = Quantity::ALL.map(Quantity::name);
    assert_eq!(object["answers"], serde_json::json!(all));
}

/// One of its random places has a film too soft and a substrate too stiff to be answered.
#[test]
fn a_check_keeps_to_materials_that_are_answered() {
    let workdir = workdir!();
    assert_eq!(
        workdir.json("check embedded --seed 6 --json")["holds"],
        true
    );
}

#[test]
fn a_check_states_the_errors_of_each_quantity_that_the_table_answers() {
    let workdir = workdir!();
    let text = workdir.succeed("check embedded --points 40");
    for quantity in Quantity::ALL {
        assert_names(&text, &[format!("\n{:9} max ", quantity.name())]);
    }
    let object = workdir.json("check embedded --points 40 --json");
    let error = |of: &Value| number(of, "max_error");
    let each = Quantity::ALL.map(|quantity| error(&object["quantities"][quantity.name()]));
    let largest = each.into_iter().fold(0.0, f64::max);
    assert!(each.into_iter().all(|error| error > 0.0));
    assert_eq!(largest, error(&object["measured"]));
    let worst = object["measured"]["worst_quantity"].as_str();
    let worst = worst.expect("a name");
    assert_eq!(error(&object["quantities"][worst]), largest);
}

/// Asserts that `object` describes `table`, whose file has this many `bytes`.
fn assert_describes(object: &Value, table: &Table, bytes: u64) {
    let close = |field: &str, value: f64| {
        let found = object.pointer(field).unwrap_or(&Value::Null);
        let number = match found.as_str() {
            Some(text) => text.parse().ok(),
            None => found.as_f64(),
        };
        // The reading of serde_json may be one bit off.
        let holds = number.is_some_and(|number: f64| {
            number == value || (number / value - 1.0).abs() <= f64::EPSILON
        });
        assert!(holds, "{field}: {found}, not {value}");
    };
    let description = table.description();
    assert_eq!(object["title"], description.title);
    assert_eq!(object["scene"], description.scene);
    assert_eq!(object["created_by"], description.created_by);
    for (parameter, nodes) in table.axes() {
        let axis = format!("/axes/{}", parameter.name());
        close(&format!("{axis}/from"), nodes[0]);
        close(&format!("{axis}/to"), nodes[nodes.len() - 1]);
        close(&format!("{axis}/nodes"), nodes.len() as f64);
    }
    match description.nu0 {
        SubstratePoissonRatio::Fixed(nu0) => close("/nu0", nu0),
        SubstratePoissonRatio::Paired => assert_eq!(object["nu0"], "paired"),
    }
    let names: Vec<&str> = table.quantities().into_iter().map(Quantity::name).collect();
    assert_eq!(object["quantities"], serde_json::json!(names));
    let names: Vec<&str> = table.answers().into_iter().map(Quantity::name).collect();
    assert_eq!(object["answers"], serde_json::json!(names));
    assert_eq!(object["normalised_by"], table.unit());
    close("/tolerance", description.tolerance);
    let ranks = table.ranks();
    assert_eq!(object["ranks"], serde_json::json!(ranks));
    let certificate = &description.certificate;
    close("/certificate/max_error", certificate.max_error);
    close("/certificate/p999_error", certificate.p999_error);
    close("/certificate/median_error", certificate.median_error);
    close("/certificate/points", certificate.points as f64);
    close("/certificate/seed", certificate.seed as f64);
    let worst = certificate.worst_quantity.name();
    assert_eq!(object["certificate"]["worst_quantity"], worst);
    for (parameter, value) in table.parameters().into_iter().zip(certificate.worst_point) {
        let place = format!("/certificate/worst_point/{}", parameter.name());
        close(&place, value);
    }
    let identities = ["energy_release_rate", "stiffness", "penetration", "load"];
    for (name, error) in identities.into_iter().zip(certificate.identity_errors) {
        match error {
            Some(error) => close(&format!("/certificate/identity_errors/{name}"), error),
            None => assert!(object["certificate"]["identity_errors"][name].is_null()),
        }
    }
    assert_eq!(object["bytes"], bytes);
}

#[test]
fn json_holds_what_the_table_holds() {
    let workdir = workdir!();
    let object = |args: &str| -> Value { workdir.json(format!("{args} --json")) };
    let size = |name: &str| std::fs::metadata(workdir.path(name)).expect("a file").len();
    let count = |object: &Value| object.as_object().expect("an object").len();

    let paper = object(&format!("info {}", paper_table()));
    let bytes = std::fs::metadata(paper_table()).expect("a file").len();
    let table = Table::read(paper_table()).expect("a sound table");
    assert_describes(&paper, &table, bytes);
    assert_eq!(count(&paper), 12);
    let embedded = Table::embedded();
    let bytes = embedded.to_packed().expect("it was packed").len() as u64;
    assert_describes(&object("info embedded"), embedded, bytes);

    // A substrate at infinity, and identities that are not known.
    workdir.write("scene.toml", TWO_QUANTITIES.replace("1e-2", "1e-1"));
    let made = object("generate scene.toml --certificate-points 50");
    let table = Table::open(workdir.path("scene.h5")).expect("a sound table");
    assert_describes(&made, &table, size("scene.h5"));
    assert_eq!(made["axes"]["e0_over_e2"]["to"], "inf");
    assert_eq!(made["path"], "scene.h5");
    assert_eq!(made["points_solved"], 36);
    assert_eq!(made["points_resumed"], 0);
    assert_eq!(made["refined"], serde_json::json!([]));
    let seconds = |name: &str| number(&made, name);
    assert!(seconds("seconds") >= seconds("seconds_solving"));
    assert_eq!(count(&made), 19);

    let packed = object("pack scene.h5 -o table.bin");
    let table = Table::read(workdir.path("table.bin")).expect("a sound table");
    assert_describes(&packed, &table, size("table.bin"));
    assert_eq!(packed["path"], "table.bin");
    let tight = "pack scene.h5 -o low.bin --tolerance 1e-1";
    let packed = object(tight);
    let table = Table::read(workdir.path("low.bin")).expect("a sound table");
    assert!(packed["ranks"].is_array());
    assert_describes(&packed, &table, size("low.bin"));

    let checked = object(&format!("check {} --points 20 --seed 3", paper_table()));
    assert_eq!(checked["certified"], paper["certificate"]);
    assert_eq!(checked["tolerance"], paper["tolerance"]);
    let measured = &checked["measured"];
    assert_eq!(measured["points"], 20);
    assert_eq!(measured["seed"], 3);
    assert_eq!(checked["holds"], true);
}
