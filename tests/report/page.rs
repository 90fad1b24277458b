//! The report of a table: what the file holds, and what it does in a browser.

use std::collections::HashMap;
use std::env;
use std::io::{Write, stderr};
use std::path::{Path, PathBuf};
use std::process::Command;

use acceptance::{Contacts, Data, Desk, assert_names, ends, larger, shipped, table};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use interp::Parameter;
use interp::{Contact, Control, Elastic, Error, Quantity, System, Table};
use serde_json::Value;
use tabulate::report::report;

/// By how much the quantities in a page may differ from the table's, as its documentation states.
const DIFFERENCE: f64 = 1e-6;

const FOUR_AXES: &str = "
    title      = 'Ångström & <Söhne>'
    tolerance  = 1e-6
    a_over_t   = { from = 1e-2, to = 1e2 }
    e1_over_e2 = { from = 0.3, to = 3 }
    nu1        = { from = 0.3, to = 0.5 }
    e0_over_e2 = { from = 10, to = 1000 }
    nu0        = 0.2
";
/// A rigid sphere without adhesion.
const RIGID_SPHERE: &str = "
    title      = 'Rigid sphere, no adhesion'
    tolerance  = 1e-6
    quantities = ['pi0', 'delta0']
    a_over_t   = { from = 1e-2, to = 10 }
    e1_over_e2 = 0
    nu1        = { from = 0.2, to = 0.45 }
    e0_over_e2 = { from = 1, to = 1e4 }
    nu0        = 0.25
";
/// What a force against a contact radius takes, and no more; a rigid sphere with adhesion.
const NO_PENETRATION: &str = "
    title      = 'Rigid sphere and substrate'
    tolerance  = 1e-6
    quantities = ['pi0', 'eeq', 'gamma']
    a_over_t   = { from = 1e-2, to = 30 }
    e1_over_e2 = 0
    nu1        = 0.4
    e0_over_e2 = inf
";

fn desk() -> Desk {
    Desk::new(env!("CARGO_BIN_EXE_tabulate-under-test"))
}

fn embedded_default() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../crates/interp/embedded/default.bin")
}

/// The table in a page.
fn packed(page: &str) -> Table {
    let (_, rest) = page
        .split_once("id=\"packed\">")
        .expect("the page has data");
    let (data, _) = rest.split_once('<').expect("the data ends");
    Table::from_packed(&STANDARD.decode(data).expect("base64")).expect("a packed table")
}

#[test]
fn the_file_is_whole_and_the_same_twice() {
    let desk = desk();
    let source = shipped("paper.bin");
    let source = source.to_str().expect("a path in UTF-8");
    for name in ["one.html", "two.html"] {
        assert_eq!(desk.succeed(&["report", source, "-o", name]), "");
    }
    let page = String::from_utf8(desk.read("one.html")).expect("UTF-8");
    assert_eq!(page.as_bytes(), desk.read("two.html"));
    assert_eq!(desk.files(), ["one.html", "two.html"]);
    let table = Table::read(shipped("paper.bin")).expect("the shipped table");
    let description = table.description();
    let certificate = &description.certificate;
    let words = [
        format!("<title>{}</title>", description.title),
        format!("<dd>{:.1e}</dd>", certificate.max_error),
        format!("<dd>{:.1e}</dd>", certificate.median_error),
        format!(
            "<dd>{} direct solves, seed {}</dd>",
            certificate.points, certificate.seed
        ),
        format!(
            "{} at a/t = {}",
            certificate.worst_quantity.name(),
            &certificate.worst_point[0].to_string()[..5]
        ),
        description.created_by.clone(),
        description.scene.trim_end().replace('"', "&quot;"),
    ];
    assert_names(&page, &words.each_ref().map(String::as_str));
    assert_eq!(
        page.matches("<figure><img alt=").count(),
        4,
        "the error map, and the paper's figures"
    );
    assert!(!page.contains("{{") && !page.contains("}}"));
    // A name of XML, which is no address to fetch from.
    assert!(
        !page
            .replace("http://www.w3.org/2000/svg", "")
            .contains("://")
    );
}

#[test]
fn what_a_table_says_is_text() {
    let page = report(&table(FOUR_AXES), &[]).expect("a report");
    assert_names(&page, &["<title>Ångström &amp; &lt;Söhne&gt;</title>"]);
    assert!(!page.contains("<Söhne>"));
}

#[test]
fn the_table_in_the_page_is_the_table() {
    let tables = [
        Table::read(shipped("paper.bin")).expect("the shipped table"),
        table(FOUR_AXES),
        table(RIGID_SPHERE),
    ];
    for table in tables {
        let embedded = packed(&report(&table, &[]).expect("a report"));
        assert_eq!(embedded.description(), table.description());
        let mut contacts = Contacts::new(1);
        let mut largest = 0.0;
        for _ in 0..2000 {
            let (x, material) = contacts.point_of(&table);
            let [ours, theirs] = [&table, &embedded]
                .map(|table| table.curve(&material).expect("a material in the box"));
            let difference = |quantity: Quantity| {
                let [ours, theirs] = [&ours, &theirs]
                    .map(|curve| curve.quantity(quantity, x).expect("held and in range"));
                (theirs / ours - 1.0).abs()
            };
            largest = table
                .quantities()
                .into_iter()
                .map(difference)
                .fold(largest, larger);
        }
        assert!(
            largest < DIFFERENCE,
            "{}: {largest:e}",
            table.description().title
        );
    }
    // One that is in this form already is in the page as it is.
    let table = Table::read(embedded_default()).expect("the embedded table");
    let embedded = packed(&report(&table, &[]).expect("a report"));
    assert_eq!(
        embedded.to_packed().expect("packed"),
        table.to_packed().expect("packed")
    );
}

#[test]
fn nothing_is_written_on_top_of_the_table() {
    let desk = desk();
    desk.write(
        "table.bin",
        std::fs::read(shipped("paper.bin")).expect("the shipped table"),
    );
    let message = desk.fail(1, &["report", "table.bin", "-o", "table.bin"]);
    assert_names(&message, &["table.bin", "it is the input"]);
    desk.fail(2, &["report", "table.bin"]);
    assert_names(
        &desk.succeed(&["report", "--help"]),
        &["TABLE", "-o", "--output", "REPORT.html"],
    );
}

/// What a page, in Chromium, leaves in its element `seen`; none if there is no Chromium.
fn seen(page: &str) -> Option<String> {
    let Some(chromium) = env::var_os("CHROMIUM") else {
        // Not `eprintln`, which tests keep to themselves.
        let _ = writeln!(
            stderr(),
            "skipped: there is no browser: install Chromium and run `cargo xtask test`, or set CHROMIUM"
        );
        return None;
    };
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("report.html");
    std::fs::write(&path, page).expect("written");
    let mut command = Command::new(chromium);
    command.args([
        "--headless",
        "--no-sandbox",
        "--disable-gpu",
        "--disable-quic",
        "--no-first-run",
        "--disable-background-networking",
    ]);
    command.args([
        "--disable-component-update",
        "--disable-sync",
        "--enable-logging=stderr",
        "--virtual-time-budget=600000",
    ]);
    command.arg(format!(
        "--user-data-dir={}",
        folder.path().join("profile").display()
    ));
    command
        .arg("--dump-dom")
        .arg(format!("file://{}", path.display()));
    // The page's clock runs ahead whenever the page waits, for instance for its own address to
    // change; on a busy machine the whole budget of it may pass meanwhile.
    let text = (0..3).find_map(|_| {
        let output = command.output().expect("Chromium runs");
        let [dom, log] =
            [&output.stdout, &output.stderr].map(|bytes| String::from_utf8_lossy(bytes));
        let lines: Vec<&str> = log
            .lines()
            .filter(|line| line.contains("CONSOLE"))
            .collect();
        assert!(lines.is_empty(), "{lines:?}");
        dom.split_once("id=\"seen\">")
            .and_then(|(_, rest)| rest.split_once('<'))
            .map(|(text, _)| text.to_owned())
    });
    Some(text.expect("the page comes to its end"))
}

/// What a report shows in Chromium at each of the addresses; none if there is no Chromium.
fn browse(page: &str, addresses: &[String]) -> Option<Value> {
    let collect = "<head><script>const complaints = [];
        addEventListener('error', (event) => complaints.push(String(event.message)));
        addEventListener('unhandledrejection', (event) => complaints.push(String(event.reason)));
        addEventListener('securitypolicyviolation', (event) => complaints.push(event.violatedDirective));
        for (const kind of ['error', 'warn']) console[kind] = (...words) => complaints.push(words.join(' '));</script>";
    let harness = include_str!("report.js")
        .replace("CASES", &serde_json::to_string(addresses).expect("text"));
    let page = page.replacen("<head>", collect, 1).replace(
        "</body>",
        &format!("<script type=\"module\">{harness}</script></body>"),
    );
    let seen: Value =
        serde_json::from_slice(&STANDARD.decode(seen(&page)?).expect("base64")).expect("JSON");
    assert_eq!(seen["complaints"], Value::Array(Vec::new()));
    assert_eq!(seen["fetched"], 0);
    Some(seen)
}

/// Settings as in an address and in a command line, and the work of adhesion.
#[derive(Clone, Copy)]
struct Setting {
    thickness: f64,
    film: [f64; 2],
    substrate: [f64; 2],
    radius: f64,
    sphere: f64,
    adhesion: f64,
}

/// The paper's, with a film of 1 um.
const PAPER: Setting = Setting {
    thickness: 1e-6,
    film: [3.5e6, 0.5],
    substrate: [2e11, 0.25],
    radius: 1e-3,
    sphere: 2e6,
    adhesion: 0.04,
};

impl Setting {
    /// The address that sets what the table leaves free.
    fn address(&self, table: &Table) -> String {
        let free = |parameter| ends(table, parameter).0 < ends(table, parameter).1;
        let rigid_sphere = ends(table, Parameter::E1OverE2).0 == 0.0;
        let settings = [
            (true, "film_thickness", self.thickness),
            (
                rigid_sphere || free(Parameter::E1OverE2),
                "film_modulus",
                self.film[0],
            ),
            (free(Parameter::Nu1), "film_poisson_ratio", self.film[1]),
            (
                free(Parameter::E0OverE2),
                "substrate_modulus",
                self.substrate[0],
            ),
            (true, "sphere_radius", self.radius),
            (!rigid_sphere, "sphere_modulus", self.sphere),
            (
                table.holds(Quantity::Gamma),
                "work_of_adhesion",
                self.adhesion,
            ),
        ];
        let free = settings
            .iter()
            .filter(|(free, ..)| *free)
            .map(|(_, name, value)| format!("{name}={value:e}"));
        free.collect::<Vec<_>>().join("&")
    }

    fn contact(&self, table: &Table) -> Contact {
        let solid = |[young, poisson]: [f64; 2]| Elastic::new(young, poisson).expect("physical");
        let system = System {
            sphere_radius: self.radius,
            sphere_modulus: self.sphere,
            film: solid(self.film),
            film_thickness: self.thickness,
            substrate: solid(self.substrate),
        };
        table.contact(&system).expect("in the table")
    }
}

fn number(value: &Value) -> f64 {
    value
        .as_str()
        .and_then(|text| text.parse().ok())
        .unwrap_or_else(|| panic!("{value} is no number"))
}

/// Asserts that the page agrees with the library about a contact, relative to the two parts that
/// the load is the difference of.
fn assert_load(contact: &Contact, adhesion: f64, a: f64, load: f64, what: &str) {
    let truth = contact.load(a, adhesion).expect("in the table");
    let adhesionless = contact.load(a, 0.0).expect("in the table");
    let size = adhesionless + (adhesionless - truth).abs();
    assert!(
        (load - truth).abs() < DIFFERENCE * size,
        "{what}, a = {a:e}: {load:e} {truth:e}"
    );
}

/// Asserts that the page of a table shows what `tabulate curve` prints of it, and `interp`
/// computes, at these settings.
fn assert_shows(desk: &Desk, name: &str, table: &Table, settings: &[Setting]) -> Option<Value> {
    let page = report(table, &[]).expect("a report");
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
        let penetrates = table.holds(Quantity::Delta0);

        // The command that the page gives prints what the page writes.
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
        if penetrates {
            let printed = Data::parse("the program's", &desk.succeed(&arguments));
            for (ours, theirs) in csv.cases().zip(printed.cases()) {
                let a = theirs.get("contact_radius");
                assert!((ours.get("contact_radius") / a - 1.0).abs() < 1e-14);
                assert_load(&contact, setting.adhesion, a, ours.get("load"), &what);
                // No radius is that close to the one at which a value changes its sign.
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

        for point in look["points"].as_array().expect("points") {
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
            let Ok(state) = state else {
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
    let curves = if table.holds(Quantity::Delta0) { 4 } else { 2 };
    for slider in seen["sliders"].as_array().expect("sliders") {
        let moved: Vec<bool> = slider["moved"]
            .as_array()
            .expect("flags")
            .iter()
            .map(|flag| flag == true)
            .collect();
        // A stable and an unstable piece in each drawing, of which one may be empty; and the
        // number.
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
fn a_page_with_all_axes_shows_what_the_program_prints() {
    let (desk, table) = (
        desk(),
        Table::read(embedded_default()).expect("the embedded table"),
    );
    desk.write(
        "default.bin",
        std::fs::read(embedded_default()).expect("the embedded table"),
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
        // All parameters matter.
        Setting {
            thickness: 1e-3,
            film: [5e6, 0.0],
            substrate: [2e6, 0.25],
            radius: 1e-2,
            sphere: 1e6,
            adhesion: 5.0,
        },
    ];
    let Some(seen) = assert_shows(&desk, "default.bin", &table, &settings) else {
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
    let last = &seen["looks"][5];
    assert_names(
        last["messages"].as_str().expect("text"),
        &["The curve ends at a = 10.0000 µm, where the table’s a/t ends: 1000"],
    );
    assert_eq!(last["states"]["pull-off-load"]["load"], Value::Null);
}

#[test]
fn a_page_of_the_papers_table_shows_what_the_program_prints() {
    let (desk, path) = (desk(), shipped("paper.h5"));
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
        &desk,
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
    let (desk, table) = (desk(), table(RIGID_SPHERE));
    desk.write("rigid.bin", table.to_packed().expect("packed"));
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
    let Some(seen) = assert_shows(&desk, "rigid.bin", &table, &settings) else {
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
    let (desk, table) = (desk(), table(NO_PENETRATION));
    desk.write("rigid.bin", table.to_packed().expect("packed"));
    let setting = Setting {
        sphere: f64::INFINITY,
        film: [1e6, 0.4],
        substrate: [f64::INFINITY, 0.25],
        thickness: 1e-5,
        ..PAPER
    };
    let Some(seen) = assert_shows(&desk, "rigid.bin", &table, &[setting]) else {
        return;
    };
    let states = &seen["looks"][0]["states"];
    assert_eq!(states.as_object().map(serde_json::Map::len), Some(2));
    // The least load of all, which no library call without penetrations gives.
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

#[test]
fn outside_the_box_there_is_a_message_and_no_curve() {
    let page = report(
        &Table::read(embedded_default()).expect("the embedded table"),
        &[],
    )
    .expect("a report");
    let cases = [
        (
            "sphere_modulus=2e4",
            "E₀/E₂* = 10000000 is outside the table’s 1 to 1000000.",
        ),
        (
            "film_modulus=1e3",
            "E₁/E₂* = 0.0005 is outside the table’s 0.001 to 1000.",
        ),
        (
            "film_poisson_ratio=0.51",
            "ν₁ = 0.51 is outside the table’s 0 to 0.5.",
        ),
        (
            "film_thickness=-1",
            "The film thickness must be a number above 0.",
        ),
        (
            "work_of_adhesion=much",
            "The work of adhesion must be a number that is 0 or more.",
        ),
        (
            "film_colour=3",
            "The address sets “film_colour”, which is no setting of this table.",
        ),
    ];
    let addresses = cases.map(|(address, _)| address.to_owned());
    let Some(seen) = browse(
        &page,
        &[&addresses[..], &["sphere_radius=1e-3".to_owned()]].concat(),
    ) else {
        return;
    };
    let looks = seen["looks"].as_array().expect("looks");
    for ((address, message), look) in cases.iter().zip(looks) {
        assert_eq!(
            (look["hidden"].as_bool(), look["messages"].as_str()),
            (Some(true), Some(*message)),
            "{address}"
        );
    }
    assert_eq!(looks[cases.len()]["hidden"], false, "it comes back");
}

#[test]
fn a_phone_and_a_desktop_show_it_without_moving_it_sideways() {
    let page = report(
        &Table::read(shipped("paper.bin")).expect("the shipped table"),
        &[],
    )
    .expect("a report");
    let escaped = page.replace('&', "&amp;").replace('"', "&quot;");
    let frame = |width| format!("<iframe style='width:{width}px' srcdoc=\"{escaped}\"></iframe>");
    let measure = "<script>addEventListener('load', () => {
        const pages = [...document.querySelectorAll('iframe')].map((frame) => frame.contentDocument);
        const text = pages.flatMap((page) => [page.documentElement.scrollWidth, page.querySelectorAll('#charts svg').length]);
        document.body.append(Object.assign(document.createElement('pre'), { id: 'seen', textContent: text.join(' ') }));
    });</script>";
    let Some(text) = seen(&format!(
        "<body>{}{}{measure}</body>",
        frame(390),
        frame(1280)
    )) else {
        return;
    };
    let numbers: Vec<u32> = text
        .split(' ')
        .map(|number| number.parse().expect("a number"))
        .collect();
    assert!(
        numbers[0] <= 390 && numbers[2] <= 1280 && numbers[1] == 2 && numbers[3] == 2,
        "{numbers:?}"
    );
}
