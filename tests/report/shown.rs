//! What a page shows: compared with `tabulate curve` and with the library.

use std::collections::HashMap;

use acceptance::{Data, ends, workdir};
use contact::{Contact, Control};
use interp::{Parameter, Probe, Quantity, Table};
use serde_json::Value;
use tabulate::report::report;

use crate::browser::browse;
use crate::setting::settings;
use crate::{DIFFERENCE, PICTURE, SPHERE};

pub fn number(value: &Value) -> f64 {
    value
        .as_str()
        .and_then(|text| text.parse().ok())
        .unwrap_or_else(|| panic!("{value} is no number"))
}

/// Returns what a report, which opens with a `probe`, shows at an address; none without Chromium.
pub fn look_at(table: &Table, probe: &Probe, address: &str) -> Option<Value> {
    let page = report(table, &[], probe).expect("a report");
    Some(browse(&page, &[address.to_owned()])?["looks"][0].clone())
}

/// Asserts that the `load` of a page at radius `a` agrees with the library. The difference is
/// relative to the sum of the adhesionless load and the part that adhesion subtracts.
pub fn assert_load(contact: &Contact, adhesion: f64, a: f64, load: f64, what: &str) {
    let truth = contact.load(a, adhesion).expect("in the table");
    let adhesionless = contact.load(a, 0.0).expect("in the table");
    let size = adhesionless + (adhesionless - truth).abs();
    assert!(
        (load - truth).abs() < DIFFERENCE * size,
        "{what}, a = {a:e}: {load:e} {truth:e}"
    );
}

/// Asserts that the states in the CSV of a page lie on the line of a flat punch, and that the first
/// one is the separation that the program prints.
fn assert_punch(contact: &Contact, csv: &Data, printed: &Data, what: &str) {
    let close = |ours: f64, theirs: f64| (ours - theirs).abs() <= DIFFERENCE * theirs.abs();
    let (first, separation) = (csv.cases().next(), printed.cases().next());
    let (first, separation) = (first.expect("a row"), separation.expect("a row"));
    assert_eq!(printed.cases().count(), 1, "{what}");
    for column in ["contact_radius", "load", "penetration", "jkr_ordinate"] {
        let (ours, theirs) = (first.get(column), separation.get(column));
        assert!(close(ours, theirs), "{what}: {column} {ours:e} {theirs:e}");
    }
    assert!(first.get("load") < 0.0, "{what}: the punch sticks");
    for case in csv.cases() {
        assert_eq!(case.text("jkr_abscissa"), "NaN");
        let stiffness = contact.stiffness(case.get("contact_radius"));
        let load = stiffness.expect("in the table") * case.get("penetration");
        assert!(close(case.get("load"), load), "{what}: {load:e}");
    }
}

/// Asserts that the page of a table agrees with `tabulate curve` and with `interp` at each of the
/// settings, which are lines, and has the sliders. Returns the content of the page; none without
/// Chromium.
pub fn assert_shows(table: &Table, lines: &'static str, names: &str) -> Option<Value> {
    let (workdir, settings) = (workdir!(), settings(lines));
    workdir.pack("table.bin", table);
    let page = report(table, &[], &SPHERE).expect("a report");
    let addresses: Vec<String> = settings
        .iter()
        .map(|setting| setting.address(table))
        .collect();
    let seen = browse(&page, &addresses)?;
    for (setting, look) in settings
        .iter()
        .zip(seen["looks"].as_array().expect("looks"))
    {
        let (contact, what) = (setting.contact(table), setting.address(table));
        assert_eq!(look["hidden"], false, "{what}: {}", look["messages"]);
        let penetrates = table.answers().contains(&Quantity::Delta0);

        // The command in the page prints the curve of the page's CSV file.
        let command = look["command"].as_str().expect("a command");
        let words = command.split(' ').skip(1);
        let words = words.map(|word| if word == "TABLE" { "table.bin" } else { word });
        let arguments = words.collect::<Vec<_>>().join(" ");
        let csv = Data::parse("the page's", look["csv"].as_str().expect("CSV"));
        let columns = "contact_radius load penetration jkr_abscissa jkr_ordinate";
        assert_eq!(csv.columns().join(" "), columns);
        assert_eq!(csv.cases().count(), 150);
        // The program may also say how much friction would change.
        let printed = || Data::parse("the program's", &workdir.run(&arguments).stdout);
        if setting.probe == "flat-punch" {
            assert_punch(&contact, &csv, &printed(), &what);
        } else if penetrates {
            let printed = printed();
            const COLUMNS: [&str; 4] = ["load", "penetration", "jkr_abscissa", "jkr_ordinate"];
            // A picture shows differences relative to the whole curve.
            let sizes = COLUMNS.map(|column| {
                let sizes = printed.cases().map(|case| case.get(column).abs());
                sizes.fold(0.0, f64::max)
            });
            for (ours, theirs) in csv.cases().zip(printed.cases()) {
                let a = theirs.get("contact_radius");
                assert!((ours.get("contact_radius") / a - 1.0).abs() < 1e-14);
                assert_load(&contact, setting.adhesion, a, ours.get("load"), &what);
                for (column, size) in COLUMNS.into_iter().zip(sizes) {
                    let (ours, theirs) = (ours.get(column), theirs.get(column));
                    assert!(
                        (ours - theirs).abs() < PICTURE * size,
                        "{what}: {column} {ours:e} {theirs:e} at {a:e}"
                    );
                }
            }
        } else {
            assert!(csv.cases().all(|case| case.text("penetration").is_empty()));
        }

        let points = look["points"].as_array().expect("points");
        for point in points.iter().filter(|_| setting.probe != "flat-punch") {
            let [a, load] = ["contact_radius", "load"].map(|name| number(&point[name]));
            assert_load(&contact, setting.adhesion, a, load, &what);
        }
        let pull_off = |control| contact.pull_off(setting.adhesion, control);
        let states = [
            ("pull-off-load", pull_off(Control::Load)),
            ("pull-off-penetration", pull_off(Control::Displacement)),
            ("zero-load", contact.zero_load(setting.adhesion)),
        ];
        let has_states = setting.adhesion > 0.0 && penetrates;
        let shown = look["states"].as_object().map(serde_json::Map::len);
        assert!(!has_states || shown == Some(states.len()), "{what}");
        for (id, state) in states.into_iter().filter(|_| has_states) {
            let row = &look["states"][id];
            // The library goes on beyond the table's a/t where an expansion is accurate.
            let shown = |state: &contact::State| {
                let (from, to) = ends(table, Parameter::AOverT);
                (from..=to).contains(&(state.contact_radius / setting.thickness))
            };
            let Some(state) = state.ok().filter(shown) else {
                assert_eq!(row["load"], Value::Null, "{what}: {id}");
                continue;
            };
            let close = |name: &str, truth: f64, tolerance: f64| {
                let value = number(&row[name]);
                assert!(
                    (value - truth).abs() <= tolerance * truth.abs().max(1e-12),
                    "{what}: {id}, {name} {value:e} {truth:e}"
                );
            };
            let of_load = if id == "zero-load" { 1.0 } else { PICTURE };
            close("load", state.load, of_load);
            close("penetration", state.penetration, PICTURE);
            close("contact_radius", state.contact_radius, PICTURE);
        }
        // The contacts that are unstable even at fixed penetration are the smallest, and dashed: left of the others in the
        // drawing against contact radii.
        let separates = !look["states"]["pull-off-penetration"]["load"].is_null();
        if separates && setting.probe != "flat-punch" {
            let [dashed, whole] = [2, 3].map(|path| {
                let place = look["paths"][path].as_str()?.split(['M', ' ']).nth(1)?;
                place.parse::<f64>().ok()
            });
            let is_left = dashed.is_some() && dashed < whole;
            assert!(is_left, "{what}: {dashed:?} and {whole:?}");
        }
    }
    let penetrates = table.answers().contains(&Quantity::Delta0);
    let curves = if penetrates { 4 } else { 2 };
    let sliders = seen["sliders"].as_array().expect("sliders");
    let ids = sliders.iter().map(|slider| slider["id"].as_str());
    let ids: Option<Vec<&str>> = ids.collect();
    assert_eq!(ids.expect("names").join(" "), names);
    for slider in sliders {
        let moved = slider["moved"].as_array().expect("flags").iter();
        let moved: Vec<bool> = moved.map(|flag| flag == true).collect();
        // Each drawing has a stable and an unstable path, one of which may be empty. The last entry
        // is the number.
        let (number, paths) = moved.split_last().expect("flags");
        let are_drawn = paths.chunks(2).all(|pieces| pieces.contains(&true));
        assert!(are_drawn && paths.len() == curves, "{slider}");
        assert!(*number && slider["label"] == 1 && slider["back"] == true);
    }
    let pairs = |address: &str| -> HashMap<String, f64> {
        let pairs = address.split('&').filter_map(|pair| pair.split_once('='));
        let pairs = pairs.map(|(name, text)| (name.to_owned(), text.parse().expect("a number")));
        pairs.collect()
    };
    let last = settings.last().expect("a setting").address(table);
    let address = seen["address"].as_str().expect("an address");
    assert_eq!(pairs(address.trim_start_matches('#')), pairs(&last));
    Some(seen)
}
