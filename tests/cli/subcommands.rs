//! The command line: help, exit status, and what `solve`, `query`, `curve` and `info` print.

use acceptance::{
    Contacts, Data, Desk, assert_names, larger, material, paper_system, shipped, table,
};
use interp::Parameter;
use interp::{Material, Mechanics, Table};
use serde_json::Value;
use tabulate::solve::{Solution, solve};

/// The columns of every CSV output of `solve` and `query`.
const COLUMNS: [&str; 10] = [
    "a_over_t",
    "e1_over_e2",
    "nu1",
    "e0_over_e2",
    "nu0",
    "pi0",
    "eeq",
    "gamma",
    "delta0",
    "error",
];
/// The tolerance of `solve` where none is given.
const DEFAULT_TOLERANCE: f64 = 1e-10;

const TWO_QUANTITIES: &str = "
    title      = 'Two quantities'
    tolerance  = 1e-2
    quantities = ['delta0', 'eeq']
    a_over_t   = { from = 0.1, to = 10, nodes = 9 }
    e1_over_e2 = { from = 1, to = 2, nodes = 4 }
    nu1        = 0.5
    e0_over_e2 = inf
    nu0        = 0.1
";

fn desk() -> Desk {
    Desk::new(env!("CARGO_BIN_EXE_tabulate-under-test"))
}

fn solved(x: f64, material: &Material, tolerance: f64) -> Solution {
    solve(x, material, tolerance).expect("moderate contrasts converge")
}

/// The path of the shipped table, as an argument.
fn paper_table() -> String {
    shipped("paper.bin")
        .to_str()
        .expect("a path in UTF-8")
        .to_owned()
}

#[test]
fn the_help_of_every_command_has_its_arguments_and_the_program_says_whose_modulus() {
    let desk = desk();
    let commands: [(&str, &[&str]); 9] = [
        (
            "generate",
            &[
                "SCENE.toml",
                "-o",
                "--output",
                "TABLE.h5",
                "--tolerance",
                "--jobs",
                "--resume",
                "--plan",
                "--budget",
                "--certificate-points",
                "--seed",
            ],
        ),
        (
            "solve",
            &[
                "--a-over-t",
                "--e1-over-e2",
                "--nu1",
                "--e0-over-e2",
                "--nu0",
                "--tolerance",
                "--json",
                "--points",
                "-o",
                "--output",
            ],
        ),
        ("query", &["TABLE", "--points", "-o", "--output"]),
        (
            "curve",
            &[
                "TABLE",
                "--film-thickness",
                "--sphere-radius",
                "--work-of-adhesion",
                "--sphere-modulus",
                "-o",
                "--output",
            ],
        ),
        ("info", &["TABLE"]),
        ("cost", &["solve"]),
        ("check", &["TABLE", "--points", "--seed"]),
        ("unpack", &["TABLE.bin", "-o", "--output", "TABLE.h5"]),
        (
            "pack",
            &[
                "TABLE.h5",
                "-o",
                "--output",
                "TABLE.bin",
                "--tolerance",
                "--points",
                "--seed",
            ],
        ),
    ];
    let program = desk.succeed(&["--help"]);
    assert_names(
        &program,
        &[
            "generate",
            "solve",
            "query",
            "curve",
            "info",
            "check",
            "pack",
            "unpack",
            "cost",
            "REDUCED",
            "E2* = E2/(1 - nu2^2)",
            "inf",
        ],
    );
    for (command, arguments) in commands {
        let help = desk.succeed(&[command, "--help"]);
        assert_names(&help, arguments);
        assert_names(&help, &[&format!("Usage: tabulate {command}")]);
    }
    for command in ["solve", "curve"] {
        assert_names(
            &desk.succeed(&[command, "--help"]),
            &["educed modulus E2*", "inf"],
        );
    }
    assert_names(
        &desk.succeed(&["--version"]),
        &["tabulate ", env!("CARGO_PKG_VERSION")],
    );
}

#[test]
fn wrong_usage_ends_with_2_and_failed_work_with_1() {
    let desk = desk();
    desk.write(
        "points.csv",
        "a_over_t,e1_over_e2,nu1,e0_over_e2\n1,1,0.5,inf\n",
    );
    let one = [
        "solve",
        "--a-over-t",
        "1",
        "--e1-over-e2",
        "1",
        "--nu1",
        "0.5",
        "--e0-over-e2",
        "inf",
    ];
    let with = |more: &[&'static str]| [&one, more].concat();
    let usage: [(Vec<&str>, &str); 11] = [
        (vec![], "Usage"),
        (vec!["plough"], "plough"),
        (with(&["--plough"]), "--plough"),
        (one[..7].to_vec(), "--e0-over-e2"),
        (with(&["--nu0", "quarter"]), "quarter"),
        (with(&["--points", "points.csv"]), "--points"),
        (with(&["-o", "out.csv"]), "--output"),
        (vec!["solve", "--points", "points.csv", "--json"], "--json"),
        (vec!["query", "table.h5"], "--points"),
        (vec!["pack", "table.h5"], "--output"),
        (
            vec!["curve", "table.h5", "--tolerance", "1e-3"],
            "--tolerance",
        ),
    ];
    for (arguments, word) in usage {
        assert_names(&desk.fail(2, &arguments), &[word]);
    }
    let failed: [(Vec<&str>, &[&str]); 10] = [
        (with(&["--nu0", "0.6"]), &["nu0", "0.6", "(-1, 0.5]"]),
        (with(&["--nu0", "nan"]), &["nu0", "NaN"]),
        (with(&["--tolerance", "1e-20"]), &["tolerance", "1e-20"]),
        (
            ["solve", "--a-over-t", "-1"]
                .into_iter()
                .chain(one[3..].iter().copied())
                .collect(),
            &["a_over_t", "-1", "1e-6", "10000"],
        ),
        (vec!["solve", "--points", "missing.csv"], &["missing.csv"]),
        (
            vec!["query", "missing.h5", "--points", "points.csv"],
            &["missing.h5"],
        ),
        (vec!["info", "points.csv"], &["points.csv"]),
        (
            vec!["pack", "points.csv", "-o", "table.bin"],
            &["not a coated-contact table"],
        ),
        (
            vec!["curve", "--film-thickness", "-1"],
            &["film_thickness", "-1"],
        ),
        (
            vec!["curve", "--film-poisson-ratio", "0.6"],
            &["film", "Poisson ratio", "0.6"],
        ),
    ];
    for (arguments, words) in failed {
        assert_names(&desk.fail(1, &arguments), words);
    }
    desk.succeed(&one);
    assert_eq!(desk.files(), ["points.csv"]);
}

#[test]
fn solve_prints_one_point_to_the_last_bit() {
    let desk = desk();
    let mut contacts = Contacts::new(70);
    for round in 0..12 {
        let given = if round == 0 {
            material([0.0, 0.3, f64::INFINITY, 0.2])
        } else {
            contacts.material([1e-2, 1e2], [1e-1, 1e6])
        };
        let x = contacts.log_uniform(1e-2, 1e2);
        let tolerance = if round % 2 == 0 {
            DEFAULT_TOLERANCE
        } else {
            1e-6
        };
        let expected = solved(x, &given, tolerance);
        let values_given = [
            x,
            given.e1_over_e2(),
            given.nu1(),
            given.e0_over_e2(),
            given.nu0(),
        ];
        let flags = [
            "--a-over-t",
            "--e1-over-e2",
            "--nu1",
            "--e0-over-e2",
            "--nu0",
            "--tolerance",
        ];
        let values: Vec<String> = values_given
            .iter()
            .chain([&tolerance])
            .map(|value| format!("{value:?}"))
            .collect();
        let mut arguments = vec!["solve"];
        arguments.extend(
            flags
                .iter()
                .zip(&values)
                .flat_map(|(flag, value)| [*flag, value])
                .take(if round % 2 == 0 { 10 } else { 12 }),
        );

        let [pi0, eeq, gamma, delta0] = expected.quantities.to_array();
        let rows = [
            ("pi0", pi0),
            ("eeq", eeq),
            ("gamma", gamma),
            ("delta0", delta0),
            ("error", expected.error),
        ];
        let plain = desk.succeed(&arguments);
        let lines: Vec<(&str, &str)> = plain
            .lines()
            .map(|line| line.split_once(" = ").expect("name = value"))
            .collect();
        let numbers = lines[..5]
            .iter()
            .map(|(name, value)| (name.trim(), value.parse().expect("a number")));
        assert_eq!(numbers.collect::<Vec<(&str, f64)>>(), rows);
        let symbol = given.normalisation().symbol();
        assert_eq!(lines[5..], [("normalised_by", symbol)]);

        arguments.push("--json");
        let text = desk.succeed(&arguments);
        let object: Value = serde_json::from_str(&text).expect("JSON");
        assert_eq!(object["normalised_by"], symbol);
        assert_eq!(object["modes"], expected.modes);
        assert_eq!(object["method"], expected.method.name());
        if given.e0_over_e2() == f64::INFINITY {
            assert_eq!(object["e0_over_e2"], "inf");
        }
        assert_eq!(object.as_object().expect("an object").len(), 13);
        let names = ["a_over_t", "e1_over_e2", "nu1", "e0_over_e2", "nu0"];
        for (name, value) in names.into_iter().zip(values_given).chain(rows) {
            // The digits themselves: serde_json's own reading may be one bit off.
            let (_, rest) = text
                .split_once(&format!("\"{name}\":"))
                .expect("the name is there");
            let digits = rest
                .split([',', '}'])
                .next()
                .expect("a value")
                .trim_matches('"');
            assert_eq!(
                digits.parse::<f64>().expect("a number").to_bits(),
                value.to_bits(),
                "{name}: {text}"
            );
        }
    }
}

#[test]
fn solve_takes_columns_in_any_order_and_gives_numbers_that_read_back() {
    let desk = desk();
    desk.write(
        "ordered.csv",
        "a_over_t,e1_over_e2,nu1,e0_over_e2,nu0\n1,1.75,0.5,1e5,0.25\n0.1,0,0.3,inf,0.1\n",
    );
    desk.write("mixed.csv", "# a comment\nnu0, e0_over_e2 ,nu1,a_over_t,e1_over_e2\n0.25,1e5,0.5,1,1.75\n0.1, inf,0.3,0.1,0\n");
    let answer = desk.succeed(&["solve", "--points", "ordered.csv"]);
    assert_eq!(answer, desk.succeed(&["solve", "--points", "mixed.csv"]));
    assert_eq!(
        desk.succeed(&["solve", "--points", "mixed.csv", "-o", "out.csv"]),
        ""
    );
    assert_eq!(answer.as_bytes(), desk.read("out.csv"));

    // Awkward numbers, without a column nu0: all come back as they were given.
    let mut contacts = Contacts::new(71);
    let points: Vec<[f64; 4]> = (0..50)
        .map(|_| {
            let material = contacts.material([1e-2, 1e2], [1e-1, 1e6]);
            [
                contacts.log_uniform(1e-2, 1e2),
                material.e1_over_e2(),
                material.nu1(),
                material.e0_over_e2(),
            ]
        })
        .collect();
    let rows: String = points
        .iter()
        .map(|[x, e1, nu1, e0]| format!("{x},{e1},{nu1},{e0}\n"))
        .collect();
    desk.write(
        "points.csv",
        format!("a_over_t,e1_over_e2,nu1,e0_over_e2\n{rows}"),
    );
    for (arguments, nu0, tolerance) in [
        (&[][..], 0.25, DEFAULT_TOLERANCE),
        (&["--nu0", "0.1", "--tolerance", "1e-6"], 0.1, 1e-6),
    ] {
        let data = Data::parse(
            "output",
            &desk.succeed(&[&["solve", "--points", "points.csv"], arguments].concat()),
        );
        assert_eq!(data.columns(), COLUMNS);
        assert_eq!(data.cases().count(), points.len());
        for (case, [x, e1, nu1, e0]) in data.cases().zip(&points) {
            assert_eq!(
                COLUMNS[..5]
                    .iter()
                    .map(|name| case.get(name))
                    .collect::<Vec<_>>(),
                [*x, *e1, *nu1, *e0, nu0]
            );
            let expected = solved(*x, &material([*e1, *nu1, *e0, nu0]), tolerance);
            assert_eq!(case.quantities(), expected.quantities);
            assert_eq!(case.get("error"), expected.error);
        }
    }
}

#[test]
fn query_prints_what_the_library_looks_up_and_the_certificate() {
    let desk = desk();
    let table = table(TWO_QUANTITIES);
    desk.write("table.bin", table.to_packed().expect("a small table"));
    desk.write(
        "points.csv",
        "e0_over_e2,nu1,a_over_t,e1_over_e2\ninf,0.5,0.1,1\ninf,0.5,3.3,1.9\n",
    );
    let answer = desk.succeed(&["query", "table.bin", "--points", "points.csv"]);
    let mut lines = answer.lines();
    assert_eq!(
        lines
            .next()
            .expect("a header")
            .split(',')
            .collect::<Vec<_>>(),
        COLUMNS
    );
    for (line, [x, e1]) in lines.by_ref().zip([[0.1, 1.0], [3.3, 1.9]]) {
        let fields: Vec<&str> = line.split(',').collect();
        // The table's substrate stands in where the points have none.
        let curve = table
            .curve(&material([e1, 0.5, f64::INFINITY, 0.1]))
            .expect("inside");
        let numbers = [x, e1, 0.5, f64::INFINITY, 0.1]
            .into_iter()
            .map(Some)
            .chain(quantities_at(&table, &curve, x));
        let expected: Vec<Option<f64>> = numbers
            .chain([Some(table.description().certificate.max_error)])
            .collect();
        let found: Vec<Option<f64>> = fields
            .iter()
            .map(|field| (!field.is_empty()).then(|| field.parse().expect("a number")))
            .collect();
        assert_eq!(found, expected);
    }
    assert_eq!(lines.next(), None);
    assert_eq!(
        desk.succeed(&[
            "query",
            "table.bin",
            "--points",
            "points.csv",
            "-o",
            "out.csv"
        ]),
        ""
    );
    assert_eq!(desk.read("out.csv"), answer.as_bytes());
}

#[test]
fn query_prints_the_derivatives_that_the_table_knows() {
    let desk = desk();
    let table =
        table(&TWO_QUANTITIES.replace("['delta0', 'eeq']", "['pi0', 'eeq', 'gamma', 'delta0']"));
    desk.write("table.bin", table.to_packed().expect("a small table"));
    desk.write(
        "points.csv",
        "a_over_t,e1_over_e2,nu1,e0_over_e2\n3.3,1.9,0.5,inf\n",
    );
    let answer = desk.succeed(&["query", "table.bin", "--points", "points.csv", "--gradient"]);
    let data = Data::parse("query", &answer);
    assert_eq!(data.columns()[..10], COLUMNS);
    let curve = table
        .curve_with_gradient(&material([1.9, 0.5, f64::INFINITY, 0.1]))
        .expect("inside");
    let gradient = curve.gradient(3.3).expect("inside");
    let case = data.cases().next().expect("a point");
    for quantity in interp::Quantity::ALL {
        let name = |parameter: &str| format!("d_{}_d_{parameter}", quantity.name());
        assert_eq!(
            case.get(&name("a_over_t")),
            gradient.slopes().get(quantity) / 3.3
        );
        let by_film = gradient.by(Parameter::E1OverE2).expect("an axis");
        assert_eq!(case.get(&name("e1_over_e2")), by_film.get(quantity));
        // The scene fixes it; a rigid substrate changes nothing.
        assert_eq!(case.text(&name("nu1")), "");
        assert_eq!(
            (case.get(&name("e0_over_e2")), case.get(&name("nu0"))),
            (0.0, 0.0)
        );
    }
    desk.write(
        "table.bin",
        acceptance::table(TWO_QUANTITIES)
            .to_packed()
            .expect("a small table"),
    );
    let message = desk.fail(
        1,
        &["query", "table.bin", "--points", "points.csv", "--gradient"],
    );
    assert!(message.contains("does not hold pi0"), "{message}");
}

/// The quantities at `x`, `None` where the table does not hold them.
fn quantities_at(
    table: &Table,
    curve: &interp::Curve,
    x: f64,
) -> impl Iterator<Item = Option<f64>> {
    interp::Quantity::ALL
        .map(|q| {
            table
                .holds(q)
                .then(|| curve.quantity(q, x).expect("inside"))
        })
        .into_iter()
}

/// Wrong files of points, with words of the error that each must cause beside the file's name.
const BAD_POINTS: [(&str, &str, &[&str]); 13] = [
    (
        "missing column",
        "a_over_t,e1_over_e2,nu1\n1,1,0.5\n",
        &["e0_over_e2", "header"],
    ),
    (
        "unknown column",
        "a_over_t,e1_over_e2,nu1,e0_over_e2,nu2\n1,1,0.5,inf,0.3\n",
        &["nu2", "header"],
    ),
    (
        "column twice",
        "a_over_t,e1_over_e2,nu1,e0_over_e2,nu1\n1,1,0.5,inf,0.3\n",
        &["nu1", "header", "twice"],
    ),
    (
        "text",
        "a_over_t,e1_over_e2,nu1,e0_over_e2\n1,1,0.5,inf\n1,1,half,inf\n",
        &["line 3", "nu1", "half"],
    ),
    (
        "no number",
        "a_over_t,e1_over_e2,nu1,e0_over_e2\n1,1,,inf\n",
        &["line 2", "nu1"],
    ),
    (
        "too few fields",
        "a_over_t,e1_over_e2,nu1,e0_over_e2\n1,1,0.5,inf\n1,1,0.5\n",
        &["line", "3"],
    ),
    (
        "too many fields",
        "a_over_t,e1_over_e2,nu1,e0_over_e2\n1,1,0.5,inf,1\n",
        &["line", "2"],
    ),
    ("empty", "", &["no points"]),
    (
        "header only",
        "a_over_t,e1_over_e2,nu1,e0_over_e2\n",
        &["no points"],
    ),
    (
        "nan material",
        "a_over_t,e1_over_e2,nu1,e0_over_e2\n1,nan,0.5,inf\n",
        &["line 2", "e1_over_e2", "NaN"],
    ),
    (
        "unphysical",
        "a_over_t,e1_over_e2,nu1,e0_over_e2\n1,1,0.5,inf\n1,1,0.6,inf\n",
        &["line 3", "nu1", "0.6", "(-1, 0.5]"],
    ),
    (
        "nan a_over_t",
        "a_over_t,e1_over_e2,nu1,e0_over_e2\n1,1,0.5,inf\nnan,1,0.5,inf\n",
        &["line 3", "a_over_t", "NaN"],
    ),
    (
        "negative a_over_t",
        "a_over_t,e1_over_e2,nu1,e0_over_e2\n-1,1,0.5,inf\n",
        &["line 2", "a_over_t", "-1"],
    ),
];

#[test]
fn a_bad_file_of_points_is_named_with_the_line() {
    let desk = desk();
    desk.write(
        "table.bin",
        table(TWO_QUANTITIES).to_packed().expect("a small table"),
    );
    let mut wrong = Vec::new();
    for (what, text, words) in BAD_POINTS {
        desk.write("points.csv", text);
        for command in [&["solve"][..], &["query", "table.bin"]] {
            let message = desk.fail(
                1,
                &[command, &["--points", "points.csv", "-o", "out.csv"]].concat(),
            );
            if !words
                .iter()
                .chain(&["points.csv"])
                .all(|word| message.contains(word))
            {
                wrong.push(format!("{what}: {command:?} says {message:?}"));
            }
        }
    }
    assert_eq!(desk.files(), ["points.csv", "table.bin"]);
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn curve_is_the_papers_by_default_and_the_same_from_the_table() {
    /// Largest difference in units of what table and solves allow, and of the sum of both terms.
    /// Measured: 0.13.
    const OF_BOTH: f64 = 1.0;
    let desk = desk();
    let table_path = paper_table();
    let outputs = [
        desk.succeed(&["curve"]),
        desk.succeed(&["curve", &table_path]),
    ];
    let [direct, looked_up] = outputs.each_ref().map(|text| Data::parse("curve", text));
    assert_eq!(
        direct.columns(),
        [
            "contact_radius",
            "load",
            "penetration",
            "jkr_abscissa",
            "jkr_ordinate"
        ]
    );
    assert_eq!(direct.columns(), looked_up.columns());
    assert_eq!(direct.cases().count(), 150);

    let (system, w) = (paper_system(1e-6), 0.04);
    let (mechanics, material) = (
        Mechanics::new(&system).expect("physical"),
        system.material().expect("physical"),
    );
    let table = Table::read(&table_path).expect("a sound table");
    let contact = table.contact(&system).expect("the table is the paper's");
    let certified = table.description().certificate.max_error;
    let mut worst = 0.0;
    for (i, (direct, looked_up)) in direct.cases().zip(looked_up.cases()).enumerate() {
        let a = direct.get("contact_radius");
        assert_eq!(a, looked_up.get("contact_radius"));
        assert!((a / (1e-6 * (i + 1) as f64) - 1.0).abs() <= 1e-12, "{a}");
        let edge = mechanics.edge_singularity(a, w).expect("physical");
        let quantities = solved(a / 1e-6, &material, 1e-8).quantities;
        let expected = mechanics.load_and_penetration(a, edge, &quantities);
        assert_eq!((direct.get("load"), direct.get("penetration")), expected);
        let from_table = contact.load_and_penetration(a, w).expect("inside");
        assert_eq!(
            (looked_up.get("load"), looked_up.get("penetration")),
            from_table
        );
        for (case, load) in [(&direct, expected.0), (&looked_up, from_table.0)] {
            let jkr = mechanics.jkr_point(a, load);
            assert_eq!(
                (case.get("jkr_abscissa"), case.get("jkr_ordinate")),
                (jkr.abscissa, jkr.ordinate)
            );
        }
        // What adhesion adds has the table's error, and so has what is there without.
        let bare = mechanics.load_and_penetration(a, 0.0, &quantities);
        for (found, expected, bare) in [
            (from_table.0, expected.0, bare.0),
            (from_table.1, expected.1, bare.1),
        ] {
            worst = larger(
                worst,
                (found - expected).abs() / (bare.abs() + (expected - bare).abs()) / certified,
            );
        }
    }
    println!(
        "curve from the table: at most {worst:.2} times the certified {certified:.1e} and the solve's 1e-8 from the direct one"
    );
    assert!(worst <= OF_BOTH);
}

#[test]
fn curve_takes_every_part_of_the_system() {
    let desk = desk();
    let arguments = [
        "curve",
        "--film-thickness",
        "2e-6",
        "--film-modulus",
        "5e6",
        "--film-poisson-ratio",
        "0.4",
        "--substrate-modulus",
        "inf",
        "--substrate-poisson-ratio",
        "0.1",
        "--sphere-radius",
        "5e-4",
        "--sphere-modulus",
        "inf",
        "--work-of-adhesion",
        "0.07",
        "--from",
        "1e-6",
        "--to",
        "3e-6",
        "--points",
        "3",
        "--tolerance",
        "1e-8",
        "-o",
        "curve.csv",
    ];
    assert_eq!(desk.succeed(&arguments), "");
    let output = String::from_utf8(desk.read("curve.csv")).expect("UTF-8");
    let data = Data::parse("curve.csv", &output);
    let solid = |young, poisson| interp::Elastic::new(young, poisson).expect("physical");
    let system = interp::System {
        sphere_radius: 5e-4,
        sphere_modulus: f64::INFINITY,
        film: solid(5e6, 0.4),
        film_thickness: 2e-6,
        substrate: solid(f64::INFINITY, 0.1),
    };
    let (mechanics, material) = (
        Mechanics::new(&system).expect("physical"),
        system.material().expect("physical"),
    );
    assert_eq!(data.cases().count(), 3);
    for (case, a) in data.cases().zip([1e-6, 2e-6, 3e-6]) {
        assert!((case.get("contact_radius") / a - 1.0).abs() <= 4.0 * f64::EPSILON);
        let a = case.get("contact_radius");
        let quantities = solved(a / 2e-6, &material, 1e-8).quantities;
        let edge = mechanics.edge_singularity(a, 0.07).expect("physical");
        assert_eq!(
            (case.get("load"), case.get("penetration")),
            mechanics.load_and_penetration(a, edge, &quantities)
        );
    }
}

#[test]
fn info_prints_axes_quantities_and_certificate() {
    let desk = desk();
    let table_path = paper_table();
    let table = Table::read(&table_path).expect("a sound table");
    let description = table.description();
    let certificate = &description.certificate;
    let [energy, load] = certificate
        .identity_errors
        .map(|error| error.expect("all quantities are held"));
    let [n_a, n_e1, _, _] = table.shape();
    let text = desk.succeed(&["info", &table_path]);
    let lines = [
        ("title", description.title.clone()),
        ("a_over_t", format!("0.001 to 1000, {n_a} nodes")),
        ("e1_over_e2", format!("0.01 to 100, {n_e1} nodes")),
        ("nu1", "0.5".to_owned()),
        ("e0_over_e2", "100000".to_owned()),
        ("nu0", "0.25".to_owned()),
        (
            "quantities",
            "pi0, eeq, gamma, delta0 (normalised by E2*)".to_owned(),
        ),
        ("tolerance", "1e-9".to_owned()),
        (
            "certified error",
            format!(
                "max {:.1e}, 99.9 % {:.1e}, median {:.1e}",
                certificate.max_error, certificate.p999_error, certificate.median_error
            ),
        ),
        (
            "worst",
            format!(
                "{} at a_over_t = {}",
                certificate.worst_quantity.name(),
                certificate.worst_point[0]
            ),
        ),
        (
            "identities",
            format!("Gamma^2 = es (x Eeq)' {energy:.1e}, F0' = S delta0' {load:.1e}"),
        ),
        ("created by", description.created_by.clone()),
        (
            "size",
            std::fs::metadata(&table_path)
                .expect("it is there")
                .len()
                .to_string(),
        ),
    ];
    assert_eq!(text.lines().count(), lines.len(), "{text}");
    for (line, (name, content)) in text.lines().zip(lines) {
        assert!(
            line.strip_prefix(name)
                .is_some_and(|rest| rest.trim_start().starts_with(&content)),
            "{line}: {name}: {content}"
        );
    }
    assert_names(
        &text,
        &[&format!(
            "{} direct solves, seed {}",
            certificate.points, certificate.seed
        )],
    );
    let small = self::table(TWO_QUANTITIES);
    desk.write("small.bin", small.to_packed().expect("a small table"));
    assert_names(
        &desk.succeed(&["info", "small.bin"]),
        &["eeq, delta0 (normalised by E2*)", "inf"],
    );
}
