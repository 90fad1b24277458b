//! The places of texts on the page, on wide and on narrow ones, and the system that it opens with.

use acceptance::{assert_names, table};
use interp::{Probe, Table};
use tabulate::report::report;

use crate::browser::crowded;
use crate::shown::look_at;
use crate::{FOUR_AXES, SPHERE, embedded_universal};

#[test]
fn no_text_of_a_chart_meets_another_on_any_page() {
    let table = Table::read(embedded_universal()).expect("the embedded table");
    let page = report(&table, &[], &SPHERE).expect("a report");
    // From a few numbers with many digits to many with few.
    let addresses = [
        "",
        "film_thickness=1e-5",
        "film_thickness=3e-4&work_of_adhesion=1e-4",
        "sphere_radius=3e-8&film_thickness=1e-9&film_modulus=1e9",
        "film_modulus=1e3&sphere_modulus=1e4&work_of_adhesion=1",
        "probe=flat-punch&sphere_radius=2e-5",
        "work_of_adhesion=0",
        "film_thickness=1.7e-6&sphere_radius=7.3e-5&work_of_adhesion=0.021",
    ];
    for width in [1280, 800, 500, 390, 340] {
        let Some(seen) = crowded(&page, &addresses, width) else {
            return;
        };
        for (address, look) in addresses.iter().zip(seen.as_array().expect("looks")) {
            assert_eq!(
                look["texts"],
                serde_json::json!([]),
                "{address} at {width} px"
            );
            assert!(look["charts"].as_u64() > Some(0), "{address} at {width} px");
            assert_eq!(look["scrolls"], false, "{address} at {width} px");
        }
    }
}

/// The table ends at this film's a/t before the sphere is as wide as at zero load.
#[test]
fn the_numbers_of_the_command_are_without_rounding_errors() {
    let Some(look) = look_at(&table(FOUR_AXES), &SPHERE, "film_thickness=5e-7") else {
        return;
    };
    // As numbers, 1e2 * 5e-7 is another number.
    assert_ne!(1e2 * 5e-7, 5e-5);
    let command = look["command"].as_str().expect("a command");
    assert_names(command, &["--film-thickness 5e-7 ", "--to 0.00005 "]);
    for word in command.split(' ') {
        let digits = word.chars().filter(char::is_ascii_digit).count();
        assert!(
            word.trim_end_matches("Pa").parse::<f64>().is_err() || digits <= 14,
            "{word} in {command}"
        );
    }
}

#[test]
fn a_page_opens_on_a_system_whose_curve_reaches_zero_load() {
    // This sphere needs contacts of 65 films of 1 um, and the table ends at 10.
    let thin = FOUR_AXES.replace("to = 1e2", "to = 10");
    let all = Table::read(embedded_universal()).expect("the embedded table");
    for (table, radius) in [
        (table(&thin), 1e-3),
        (table(&thin), 2e-2),
        (table(FOUR_AXES), 2e-2),
        (all, 1e-3),
    ] {
        let probe = Probe::Paraboloid { radius };
        let Some(look) = look_at(&table, &probe, "") else {
            return;
        };
        assert_eq!(look["states"]["zero-load"]["load"], "0", "{look}");
    }
}

#[test]
fn a_rigid_body_is_nothing_that_the_command_must_allow() {
    let table = Table::read(embedded_universal()).expect("the embedded table");
    let Some(look) = look_at(&table, &SPHERE, "sphere_modulus=inf") else {
        return;
    };
    let command = look["command"].as_str().expect("a command");
    assert_names(command, &["--sphere-modulus inf"]);
    assert!(!command.contains("--allow"), "{command}");
}
