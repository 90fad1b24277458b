//! The force curve of a page: compared with `tabulate curve` and with the library.

use std::collections::HashMap;

use acceptance::{Data, Workdir, assert_names, ends, low_rank, shipped, table, workdir};
use interp::{
    Contact, Control, Elastic, Error, Parameter, Probe, Quantity, SubstratePoissonRatio, System,
    Table,
};
use serde_json::Value;
use tabulate::report::report;

use crate::browser::browse;
use crate::{DIFFERENCE, FOUR_AXES, GAMMA_ALONE, RIGID_SPHERE, SPHERE, embedded_universal};

/// A rigid sphere with adhesion, without `delta0`: enough for load against contact radius.
const NO_PENETRATION: &str = "
    title      = 'Rigid sphere and substrate'
    tolerance  = 1e-6
    quantities = ['pi0', 'eeq', 'gamma']
    a_over_t   = { from = 1e-2, to = 30 }
    e1_over_e2 = 0
    nu1        = 0.4
    e0_over_e2 = inf
";

/// The settings of a page, in SI units. `film` and `substrate` are Young's modulus and Poisson
/// ratio.
#[derive(Clone, Copy)]
struct Setting {
    /// The value of --probe.
    probe: &'static str,
    thickness: f64,
    film: [f64; 2],
    substrate: [f64; 2],
    radius: f64,
    sphere: f64,
    adhesion: f64,
}

/// The settings of the paper, with a film of 1 um.
const PAPER: Setting = Setting {
    probe: "paraboloid",
    thickness: 1e-6,
    film: [3.5e6, 0.5],
    substrate: [2e11, 0.25],
    radius: 1e-3,
    sphere: 2e6,
    adhesion: 0.04,
};

impl Setting {
    /// Returns the address that sets the parameters that the table leaves free.
    fn address(&self, table: &Table) -> String {
        let [_, film, nu1, substrate] = table.parameters();
        let free = |parameter| table.axis(parameter).len() > 1;
        let rigid_sphere = table.unit() == "E1*";
        let settings = [
            (true, "film_thickness", self.thickness),
            (rigid_sphere || free(film), "film_modulus", self.film[0]),
            (free(nu1), "film_poisson_ratio", self.film[1]),
            (free(substrate), "substrate_modulus", self.substrate[0]),
            (
                table.description().nu0 == SubstratePoissonRatio::Paired,
                "substrate_poisson_ratio",
                self.substrate[1],
            ),
            (true, "sphere_radius", self.radius),
            (!rigid_sphere, "sphere_modulus", self.sphere),
            (
                answers(table, Quantity::Gamma),
                "work_of_adhesion",
                self.adhesion,
            ),
        ];
        let free = settings
            .iter()
            .filter(|(free, ..)| *free)
            .map(|(_, name, value)| format!("{name}={value:e}"));
        let probe = (self.probe != "paraboloid").then(|| format!("probe={}", self.probe));
        probe.into_iter().chain(free).collect::<Vec<_>>().join("&")
    }

    fn contact(&self, table: &Table) -> Contact {
        let solid = |[young, poisson]: [f64; 2]| Elastic::new(young, poisson).expect("physical");
        let radius = self.radius;
        let system = System {
            probe: match self.probe {
                "paraboloid" => Probe::Paraboloid { radius },
                "sphere" => Probe::Sphere { radius },
                "flat-punch" => Probe::FlatPunch { radius },
                other => panic!("{other}"),
            },
            sphere_modulus: self.sphere,
            film: solid(self.film),
            film_thickness: self.thickness,
            substrate: solid(self.substrate),
        };
        table.contact(&system).expect("in the table")
    }
}

/// Returns whether a table holds a quantity, or derives it from `Gamma` alone.
fn answers(table: &Table, quantity: Quantity) -> bool {
    table.holds(quantity) || table.quantities() == [Quantity::Gamma]
}

fn number(value: &Value) -> f64 {
    value
        .as_str()
        .and_then(|text| text.parse().ok())
        .unwrap_or_else(|| panic!("{value} is no number"))
}

/// Asserts that the `load` of a page at radius `a` agrees with the library. The difference is
/// relative to the sum of the adhesionless load and the part that adhesion subtracts.
fn assert_load(contact: &Contact, adhesion: f64, a: f64, load: f64, what: &str) {
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
/// settings. Returns the content of the page; none without Chromium.
fn assert_shows(
    workdir: &Workdir,
    name: &str,
    table: &Table,
    settings: &[Setting],
) -> Option<Value> {
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
        let penetrates = answers(table, Quantity::Delta0);

        // The command in the page prints the curve of the page's CSV file.
        let command = look["command"].as_str().expect("a command");
        let arguments: Vec<&str> = command
            .split(' ')
            .skip(1)
            .map(|word| if word == "TABLE" { name } else { word })
            .collect();
        let csv = Data::parse("the page's", look["csv"].as_str().expect("CSV"));
        assert_eq!(
            csv.columns(),
            [
                "contact_radius",
                "load",
                "penetration",
                "jkr_abscissa",
                "jkr_ordinate"
            ]
        );
        assert_eq!(csv.cases().count(), 150);
        if setting.probe == "flat-punch" {
            let printed = Data::parse("the program's", &workdir.succeed(&arguments));
            assert_punch(&contact, &csv, &printed, &what);
        } else if penetrates {
            let printed = Data::parse("the program's", &workdir.succeed(&arguments));
            for (ours, theirs) in csv.cases().zip(printed.cases()) {
                let a = theirs.get("contact_radius");
                assert!((ours.get("contact_radius") / a - 1.0).abs() < 1e-14);
                assert_load(&contact, setting.adhesion, a, ours.get("load"), &what);
                // No radius is so close to a zero of a column that its relative error grows.
                for column in ["load", "penetration", "jkr_abscissa", "jkr_ordinate"] {
                    let (ours, theirs) = (ours.get(column), theirs.get(column));
                    assert!(
                        (ours / theirs - 1.0).abs() < 1e-4,
                        "{what}: {column} {ours:e} {theirs:e} at {a:e}"
                    );
                }
            }
        } else {
            assert!(csv.cases().all(|case| case.text("penetration").is_empty()));
        }

        let points = look["points"].as_array().expect("points");
        for point in points.iter().filter(|_| setting.probe != "flat-punch") {
            assert_load(
                &contact,
                setting.adhesion,
                number(&point["contact_radius"]),
                number(&point["load"]),
                &what,
            );
        }
        let mut states: HashMap<&str, Result<interp::State, Error>> = HashMap::new();
        if setting.adhesion > 0.0 && penetrates {
            states.insert(
                "pull-off-load",
                contact.pull_off(setting.adhesion, Control::Load),
            );
            states.insert(
                "pull-off-penetration",
                contact.pull_off(setting.adhesion, Control::Displacement),
            );
            states.insert("zero-load", contact.zero_load(setting.adhesion));
            assert_eq!(
                look["states"].as_object().map(serde_json::Map::len),
                Some(states.len())
            );
        }
        for (id, state) in states {
            let row = &look["states"][id];
            // The library goes on beyond the table's a/t where an expansion is accurate.
            let shown = |state: &interp::State| {
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
            close(
                "load",
                state.load,
                if id == "zero-load" { 1.0 } else { 1e-6 },
            );
            close("penetration", state.penetration, 1e-5);
            // Where the load is least its slope vanishes, and with it the digits of the contact
            // radius.
            close("contact_radius", state.contact_radius, 1e-4);
        }
    }
    let curves = if answers(table, Quantity::Delta0) {
        4
    } else {
        2
    };
    for slider in seen["sliders"].as_array().expect("sliders") {
        let moved: Vec<bool> = slider["moved"]
            .as_array()
            .expect("flags")
            .iter()
            .map(|flag| flag == true)
            .collect();
        // Each drawing has a stable and an unstable path, one of which may be empty. The last entry
        // is the number.
        assert!(
            moved.len() == curves + 1
                && moved[..curves]
                    .chunks(2)
                    .all(|pieces| pieces.contains(&true)),
            "{slider}"
        );
        assert!(
            moved[curves] && slider["label"] == 1 && slider["back"] == true,
            "{slider}"
        );
    }
    let last = settings.last().expect("a setting").address(table);
    let value =
        |(name, text): (&str, &str)| (name.to_owned(), text.parse::<f64>().expect("a number"));
    let pairs = |address: &str| -> HashMap<String, f64> {
        address
            .split('&')
            .filter_map(|pair| pair.split_once('='))
            .map(value)
            .collect()
    };
    assert_eq!(
        pairs(
            seen["address"]
                .as_str()
                .and_then(|text| text.strip_prefix('#'))
                .expect("an address")
        ),
        pairs(&last)
    );
    Some(seen)
}

fn sliders(seen: &Value) -> Vec<&str> {
    seen["sliders"]
        .as_array()
        .expect("sliders")
        .iter()
        .map(|slider| slider["id"].as_str().expect("a name"))
        .collect()
}

#[test]
fn a_page_of_the_embedded_table_shows_what_the_program_prints() {
    let (workdir, table) = (
        workdir!(),
        Table::read(embedded_universal()).expect("the embedded table"),
    );
    workdir.write(
        "universal.bin",
        std::fs::read(embedded_universal()).expect("the embedded table"),
    );
    let settings = [
        PAPER,
        Setting {
            thickness: 1e-5,
            ..PAPER
        },
        Setting {
            thickness: 1e-4,
            film: [1e5, 0.499],
            substrate: [7e10, 0.25],
            ..PAPER
        },
        // A probe of an atomic force microscope on a thin polymer film.
        Setting {
            probe: "paraboloid",
            thickness: 5e-8,
            film: [2e9, 0.35],
            substrate: [1.3e11, 0.25],
            radius: 2e-6,
            sphere: 7e10,
            adhesion: 0.1,
        },
        Setting {
            adhesion: 0.0,
            ..PAPER
        },
        // Pull-off is beyond the table's a/t.
        Setting {
            thickness: 1e-8,
            ..PAPER
        },
        // Contact radii up to 0.4 R, on a film and on two thin ones.
        Setting {
            probe: "sphere",
            radius: 1e-5,
            ..PAPER
        },
        Setting {
            probe: "sphere",
            thickness: 1e-7,
            radius: 1e-5,
            film: [1e5, 0.499],
            ..PAPER
        },
        Setting {
            probe: "sphere",
            thickness: 5e-8,
            film: [2e9, 0.35],
            substrate: [1.3e11, 0.25],
            radius: 2e-6,
            sphere: 7e10,
            adhesion: 0.1,
        },
        Setting {
            probe: "flat-punch",
            radius: 1e-5,
            ..PAPER
        },
        // All parameters matter.
        Setting {
            probe: "paraboloid",
            thickness: 1e-3,
            film: [5e6, 0.0],
            substrate: [2e6, 0.25],
            radius: 1e-2,
            sphere: 1e6,
            adhesion: 5.0,
        },
    ];
    assert_shows(&workdir, "universal.bin", &table, &settings);
}

#[test]
fn a_page_with_all_axes_shows_what_the_program_prints() {
    let (workdir, table) = (workdir!(), table(FOUR_AXES));
    workdir.write("table.bin", table.to_packed().expect("packed"));
    let setting = Setting {
        substrate: [1e9, 0.2],
        ..PAPER
    };
    let settings = [
        setting,
        // Pull-off is beyond the table's a/t.
        Setting {
            thickness: 1e-8,
            ..setting
        },
        // Four quantities that the table holds. Without adhesion the curve ends at 0.1 R.
        Setting {
            probe: "sphere",
            radius: 1e-5,
            ..setting
        },
        Setting {
            probe: "sphere",
            radius: 1e-5,
            adhesion: 0.0,
            ..setting
        },
        Setting {
            probe: "flat-punch",
            radius: 1e-5,
            ..setting
        },
        // All parameters matter.
        Setting {
            probe: "paraboloid",
            thickness: 1e-3,
            film: [4e6, 0.3],
            substrate: [4e7, 0.2],
            radius: 1e-2,
            sphere: 2e6,
            adhesion: 5.0,
        },
    ];
    let Some(seen) = assert_shows(&workdir, "table.bin", &table, &settings) else {
        return;
    };
    let all = [
        "film_thickness",
        "film_modulus",
        "film_poisson_ratio",
        "substrate_modulus",
        "sphere_modulus",
        "sphere_radius",
    ];
    assert_eq!(sliders(&seen), [&all[..], &["work_of_adhesion"]].concat());
    let beyond = &seen["looks"][1];
    assert_names(
        beyond["messages"].as_str().expect("text"),
        &["The curve ends at a = 1.00000 µm, where the table’s a/t ends: 100"],
    );
    assert_eq!(beyond["states"]["pull-off-load"]["load"], Value::Null);
}

#[test]
fn a_page_of_gamma_alone_shows_every_kind_of_contact() {
    // In low-rank form, which is in the page unchanged.
    let (workdir, table) = (workdir!(), low_rank(&table(GAMMA_ALONE), 1e-6));
    let tiles = table.low_rank().map(<[_]>::len);
    assert_eq!(tiles, Some(5), "the settings are in several tiles");
    workdir.write("gamma.bin", table.to_packed().expect("packed"));
    // A soft film on glass under glass.
    let soft = Setting {
        thickness: 1e-5,
        film: [1e6, 0.49],
        substrate: [7e10, 0.22],
        sphere: 7e10,
        ..PAPER
    };
    let settings = [
        soft,
        // A soft sphere, and a thicker film.
        Setting {
            thickness: 1e-4,
            sphere: 2e6,
            ..soft
        },
        Setting {
            sphere: f64::INFINITY,
            ..soft
        },
        Setting {
            substrate: [f64::INFINITY, 0.3],
            ..soft
        },
        Setting {
            sphere: f64::INFINITY,
            substrate: [f64::INFINITY, 0.3],
            film: [1e6, 0.5],
            adhesion: 0.0,
            radius: 1e-2,
            ..soft
        },
        Setting {
            sphere: f64::INFINITY,
            film: [1e10, 0.4],
            substrate: [1e7, 0.3],
            ..soft
        },
        // A film stiffer than the substrate: all parameters matter.
        Setting {
            film: [1e9, 0.35],
            substrate: [2e7, 0.3],
            sphere: 1e9,
            adhesion: 0.06,
            ..soft
        },
    ];
    let Some(seen) = assert_shows(&workdir, "gamma.bin", &table, &settings) else {
        return;
    };
    let expected = [
        "film_thickness",
        "film_modulus",
        "film_poisson_ratio",
        "substrate_modulus",
        "substrate_poisson_ratio",
        "sphere_modulus",
        "sphere_radius",
        "work_of_adhesion",
    ];
    assert_eq!(sliders(&seen), expected);
}

#[test]
fn a_page_of_the_papers_table_shows_what_the_program_prints() {
    let (workdir, path) = (workdir!(), shipped("paper.h5"));
    let settings = [
        PAPER,
        Setting {
            thickness: 1e-4,
            ..PAPER
        },
        Setting {
            film: [1e8, 0.5],
            adhesion: 0.4,
            radius: 1e-2,
            ..PAPER
        },
    ];
    let table = Table::open(&path).expect("the shipped table");
    let Some(seen) = assert_shows(
        &workdir,
        path.to_str().expect("a path in UTF-8"),
        &table,
        &settings,
    ) else {
        return;
    };
    assert_eq!(
        sliders(&seen),
        [
            "film_thickness",
            "film_modulus",
            "sphere_modulus",
            "sphere_radius",
            "work_of_adhesion"
        ]
    );
}

#[test]
fn a_rigid_sphere_without_adhesion_has_no_sliders_for_either() {
    let (workdir, table) = (workdir!(), table(RIGID_SPHERE));
    workdir.write("rigid.bin", table.to_packed().expect("packed"));
    let rigid = Setting {
        sphere: f64::INFINITY,
        adhesion: 0.0,
        film: [1e6, 0.4],
        substrate: [1e9, 0.25],
        ..PAPER
    };
    let settings = [
        Setting {
            film: [5e8, 0.2],
            ..rigid
        },
        Setting {
            thickness: 3e-5,
            substrate: [3e6, 0.25],
            ..rigid
        },
    ];
    let Some(seen) = assert_shows(&workdir, "rigid.bin", &table, &settings) else {
        return;
    };
    let expected = [
        "film_thickness",
        "film_modulus",
        "film_poisson_ratio",
        "substrate_modulus",
        "sphere_radius",
    ];
    assert_eq!(sliders(&seen), expected);
}

#[test]
fn without_penetration_there_is_load_against_contact_radius() {
    let (workdir, table) = (workdir!(), table(NO_PENETRATION));
    workdir.write("rigid.bin", table.to_packed().expect("packed"));
    let setting = Setting {
        sphere: f64::INFINITY,
        film: [1e6, 0.4],
        substrate: [f64::INFINITY, 0.25],
        thickness: 1e-5,
        ..PAPER
    };
    let Some(seen) = assert_shows(&workdir, "rigid.bin", &table, &[setting]) else {
        return;
    };
    let states = &seen["looks"][0]["states"];
    assert_eq!(states.as_object().map(serde_json::Map::len), Some(2));
    // The least load; the library has no call for it without penetrations.
    let contact = setting.contact(&table);
    let pull_off = &states["pull-off-load"];
    let (a, load) = (
        number(&pull_off["contact_radius"]),
        number(&pull_off["load"]),
    );
    assert_load(&contact, setting.adhesion, a, load, "pull-off");
    for nearby in [0.9 * a, 0.99 * a, 1.01 * a, 1.1 * a] {
        assert!(
            contact
                .load(nearby, setting.adhesion)
                .expect("in the table")
                > load
        );
    }
}
