//! Wrong inputs of a page: in its address, and typed into its fields.

use acceptance::{assert_names, rounded_cone, rows, table};
use interp::Probe;
use serde_json::{Value, json};
use tabulate::large_contact::LARGE_CONTACT;
use tabulate::report::report;

use crate::browser::{browse, choose, fill};
use crate::shown::look_at;
use crate::{FOUR_AXES, GAMMA_ALONE, RIGID_SPHERE, SPHERE};

fn page(scene: &str) -> String {
    report(&table(scene), &[], &SPHERE).expect("a report")
}

/// Asserts that each address of a page, the first cell of a table, has its message and no curve, or
/// a curve if that is `-`.
fn assert_messages(scene: &str, cases: &str) {
    let cases = rows(cases);
    let addresses: Vec<String> = cases.iter().map(|[address, _]| (*address).into()).collect();
    let Some(seen) = browse(&page(scene), &addresses) else {
        return;
    };
    for ([address, message], look) in cases.iter().zip(seen["looks"].as_array().expect("looks")) {
        let messages = look["messages"].as_str().expect("text");
        assert_eq!(look["hidden"], *message != "-", "{address}: {messages}");
        if *message != "-" {
            assert_eq!(messages, *message, "{address}");
        }
    }
}

#[test]
fn outside_the_box_there_is_a_message_and_no_curve() {
    // After the wrong ones, it comes back.
    let cases = "
        substrate_modulus=2e11 | E₀/E₂* is 100000; the table holds 10 to 1000. Change the substrate modulus or the sphere reduced modulus.
        film_modulus=1e3 | E₁/E₂* is 0.0005; the table holds 0.3 to 3. Change the film modulus or the sphere reduced modulus.
        film_poisson_ratio=0.51 | ν₁ is 0.51; the table holds 0.3 to 0.5. Change the film Poisson ratio.
        film_thickness=-1 | The film thickness must be a number above 0.
        work_of_adhesion=much | The work of adhesion must be a number that is 0 or larger.
        film_thickness=1e-3&sphere_radius=1e-7 | A contact of 10.00 µm, where the table’s a/t begins, is not smaller than the sphere. Change the sphere radius or the film thickness.
        film_colour=3 | The address sets “film_colour”, which is not a setting of this table.
        sphere_modulus=1e400 | The sphere reduced modulus must be a number above 0.
        sphere_radius=1e-3 | -
        sphere_modulus=2e+6 | -
    ";
    assert_messages(FOUR_AXES, cases);
}

#[test]
fn a_contact_radius_that_is_not_small_compared_with_the_spheres_is_noted() {
    let notes = |messages: &str| -> Vec<bool> {
        let texts = [LARGE_CONTACT, "The curve ends at the sphere’s radius R."];
        texts.map(|text| messages.contains(text)).to_vec()
    };
    // The contact radius at zero load over that of the sphere is near (9 pi w/(2 E* R))^{1/3}:
    // 0.07, 0.3 and 3, with the modulus of sphere and film.
    let cases = [
        ("sphere_radius=1e-3", [false, false]),
        ("sphere_radius=1e-5", [true, false]),
        ("sphere_radius=1e-8&film_thickness=1e-7", [true, true]),
    ];
    let addresses = cases.map(|(address, _)| address.to_owned());
    let Some(seen) = browse(&page(FOUR_AXES), &addresses) else {
        return;
    };
    let looks = seen["looks"].as_array().expect("looks");
    for ((address, expected), look) in cases.iter().zip(looks) {
        let messages = look["messages"].as_str().expect("text");
        assert_eq!(notes(messages), expected, "{address}: {messages}");
    }
}

#[test]
fn a_curve_that_begins_where_the_table_does_says_so() {
    let address = "film_thickness=1e-2&sphere_radius=2e-3&work_of_adhesion=1e-3";
    let Some(look) = look_at(&table(FOUR_AXES), &SPHERE, address) else {
        return;
    };
    assert_eq!(look["states"]["zero-load"]["load"], Value::Null);
    assert_names(
        look["messages"].as_str().expect("text"),
        "The curve begins at a = 100.0 µm, where the table’s a/t begins: 0.01.",
    );
}

#[test]
fn a_wrong_field_is_marked_as_invalid_with_its_message_until_it_is_mended() {
    // The field, the text typed into it, and the fields that are wrong then, each with the number of
    // its message.
    let entries = [
        ("film_thickness", "thin", "film_thickness:0"),
        ("film_thickness", "", "film_thickness:0"),
        ("sphere_radius", "-1", "film_thickness:0 sphere_radius:1"),
        ("sphere_radius", "1000", "film_thickness:0"),
        ("film_thickness", "1", ""),
        // The two moduli whose ratio is outside the table.
        (
            "substrate_modulus",
            "200000",
            "substrate_modulus:0 sphere_modulus:0",
        ),
        ("substrate_modulus", "2000", ""),
        ("film_poisson_ratio", "0.6", "film_poisson_ratio:0"),
        ("film_poisson_ratio", "0,5", ""),
        // A thousand or one.
        ("film_thickness", " 1,000 ", "film_thickness:0"),
        ("film_thickness", "1,000e3", "film_thickness:0"),
        ("film_thickness", "0x1", "film_thickness:0"),
        ("film_thickness", "1,0", ""),
    ];
    let typed = entries.map(|(field, text, _)| (field, text));
    let Some(seen) = fill(&page(FOUR_AXES), &typed) else {
        return;
    };
    for ((entry, text, wrong), look) in entries.iter().zip(seen.as_array().expect("looks")) {
        assert_eq!(look["hidden"], !wrong.is_empty(), "{entry}, {text:?}");
        let messages = look["messages"].as_str().expect("text").lines();
        let messages: Vec<&str> = messages.filter(|text| !text.is_empty()).collect();
        let twofold = text.contains("1,000");
        let advice = messages.iter().any(|text| text.contains(" Write 1000"));
        assert_eq!(advice, twofold, "{messages:?}");
        let fields = look["fields"].as_object().expect("fields");
        assert_eq!(fields.len(), 7);
        for (field, state) in fields {
            let number = |wrong: &str| -> Option<usize> {
                wrong
                    .strip_prefix(field.as_str())?
                    .strip_prefix(':')?
                    .parse()
                    .ok()
            };
            let expected = match wrong.split(' ').find_map(number) {
                Some(number) => json!({ "invalid": "true", "text": messages[number] }),
                None => json!({ "invalid": "false", "text": "" }),
            };
            assert_eq!(*state, expected, "{field} after {entry}, {text:?}");
        }
    }
}

#[test]
fn rigid_bodies_and_free_poisson_ratios_have_messages_of_their_own() {
    let cases = "
        film_modulus=1e6&sphere_modulus=rigid | -
        film_modulus=1e6&substrate_modulus=∞ | -
        sphere_modulus=-inf | The sphere reduced modulus must be a number above 0, or “rigid”.
        film_modulus=rigid | The film modulus must be a number above 0.
        film_poisson_ratio=0.6 | The film Poisson ratio must be a number from 0 to 0.5.
        film_modulus=4e12&film_poisson_ratio=0.45 | E₁*/E∞* is 2507860; the table holds 0 to 1000000. Change the film modulus or the substrate modulus or the sphere reduced modulus.
        film_modulus=1e8&substrate_modulus=1e7&sphere_modulus=inf&substrate_poisson_ratio=0.5 | ν₁ of the equivalent film is 0.0833333; the table holds 0.3 to 0.5. Change the film Poisson ratio or the substrate Poisson ratio.
        film_modulus=1e8&substrate_modulus=1e7&sphere_modulus=inf&substrate_poisson_ratio=0.3 | -
    ";
    assert_messages(GAMMA_ALONE, cases);
}

#[test]
fn a_probe_is_chosen_with_its_radius_its_drawings_and_its_messages() {
    let probes = ["flat-punch", "sphere", "paraboloid"];
    let Some(seen) = choose(&page(FOUR_AXES), &probes, 1.0) else {
        return;
    };
    let beyond = "The radius of the punch over the film thickness is 1000; the table holds 0.01 to 100. \
                  Change the punch radius or the film thickness.";
    let expected = [
        ("punch radius R", 0, beyond, "#probe=flat-punch"),
        ("sphere radius R", 2, "", "#probe=sphere"),
        // The address holds what differs from the page as it opens.
        ("sphere radius R", 2, "", "#film_thickness=0.000001"),
    ];
    for (expected, look) in expected.into_iter().zip(seen.as_array().expect("looks")) {
        let (radius, drawings, messages, address) = expected;
        assert_eq!(look["radius"], radius);
        assert_eq!(look["messages"], messages);
        assert_eq!(look["address"], address);
        if messages.is_empty() {
            assert_eq!(look["drawings"], drawings);
        }
    }
}

#[test]
fn a_page_opens_with_the_probe_that_was_asked_for() {
    let table = table(FOUR_AXES);
    let probe = Probe::FlatPunch { radius: 2e-5 };
    let page = report(&table, &[], &probe).expect("a report");
    // Without an address.
    let Some(seen) = browse(&page, &[String::new()]) else {
        return;
    };
    let command = seen["looks"][0]["command"].as_str().expect("a command");
    assert_names(command, &["--probe flat-punch", "--sphere-radius 0.00002"]);
    assert_eq!(seen["sliders"][0]["back"], true);
}

#[test]
fn a_page_with_a_probe_that_it_does_not_compute_is_refused() {
    let [all, two] = [table(FOUR_AXES), table(RIGID_SPHERE)];
    let refused = |table, probe| report(table, &[], &probe).expect_err("refused").to_string();
    let cone = refused(&all, Probe::Cone { half_angle: 1.0 });
    assert_names(&cone, "no cone; paraboloid; flat punch; `tabulate curve`");
    let half_angle = 1.0;
    let rounded = rounded_cone(1e-6, half_angle);
    assert_names(
        &refused(&all, rounded),
        "no rounded cone; paraboloid; flat punch",
    );
    let sphere = refused(&two, Probe::Sphere { radius: 1e-3 });
    assert_names(&sphere, &["no sphere", "eeq, gamma", "`tabulate curve`"]);
}
