//! `tabulate solve` and `tabulate query`: one point, and points from CSV.

use acceptance::{
    Contacts, Data, Refused, assert_cases, assert_names, json, material, paper_system, solid,
    table, value, workdir,
};
use contact::{Contact, Input};
use interp::{Probe, System};
use solve::solve_power_laws;

use crate::{TWO_QUANTITIES, solved};

/// The columns of every CSV output of `solve` and `query`.
const COLUMNS: &str = "a_over_t,e1_over_e2,nu1,e0_over_e2,nu0,pi0,eeq,gamma,delta0,error";
/// The tolerance of `solve` where none is given.
const DEFAULT_TOLERANCE: f64 = 1e-10;

#[test]
fn solve_prints_one_point_to_the_last_bit() {
    let workdir = workdir!();
    let mut contacts = Contacts::new(70);
    for round in 0..12 {
        let given = if round == 0 {
            material([0.0, 0.3, f64::INFINITY, 0.2])
        } else {
            contacts.material([1e-2, 1e2], [1e-1, 1e6])
        };
        let x = contacts.log_uniform(1e-2, 1e2);
        let tolerance = [DEFAULT_TOLERANCE, 1e-6][round % 2];
        let expected = solved(x, &given, tolerance);
        let (e1, nu1) = (given.e1_over_e2(), given.nu1());
        let (e0, nu0) = (given.e0_over_e2(), given.nu0());
        let mut arguments = format!(
            "solve --a-over-t {x:?} --e1-over-e2 {e1:?} --nu1 {nu1:?} --e0-over-e2 {e0:?} --nu0 {nu0:?}"
        );
        if round % 2 == 1 {
            arguments += &format!(" --tolerance {tolerance:?}");
        }

        let [pi0, eeq, gamma, delta0] = expected.quantities.to_array();
        let rows = [
            ("pi0", pi0),
            ("eeq", eeq),
            ("gamma", gamma),
            ("delta0", delta0),
            ("error", expected.error),
        ];
        let plain = workdir.succeed(&arguments);
        let printed = rows.map(|(name, _)| (name, value(&plain, name)));
        assert_eq!(printed, rows);
        let symbol = given.normalisation().symbol();
        assert!(plain.ends_with(&format!("normalised_by = {symbol}\n")));

        arguments += " --json";
        let text = workdir.succeed(&arguments);
        let object = json(&text);
        assert_eq!(object["normalised_by"], symbol);
        assert_eq!(object["modes"], expected.modes);
        assert_eq!(object["method"], expected.method.name());
        if given.e0_over_e2() == f64::INFINITY {
            assert_eq!(object["e0_over_e2"], "inf");
        }
        assert_eq!(object.as_object().expect("an object").len(), 13);
        let values_given = [x, e1, nu1, e0, nu0];
        for (name, value) in COLUMNS.split(',').zip(values_given).chain(rows) {
            // The digits themselves: serde_json's own reading may be one bit off.
            let name = format!("\"{name}\":");
            let (_, rest) = text.split_once(&name).expect("the name is there");
            let digits = rest.split([',', '}']).next().expect("a value");
            let found: f64 = digits.trim_matches('"').parse().expect("a number");
            assert_eq!(found.to_bits(), value.to_bits(), "{name} {text}");
        }
    }
}

#[test]
fn solve_takes_columns_in_any_order_and_gives_numbers_that_read_back() {
    let workdir = workdir!();
    workdir.write(
        "ordered.csv",
        "a_over_t,e1_over_e2,nu1,e0_over_e2,nu0\n1,1.75,0.5,1e5,0.25\n0.1,0,0.3,inf,0.1\n",
    );
    workdir.write("mixed.csv", "# a comment\nnu0, e0_over_e2 ,nu1,a_over_t,e1_over_e2\n0.25,1e5,0.5,1,1.75\n0.1, inf,0.3,0.1,0\n");
    let answer = workdir.succeed("solve --points ordered.csv");
    assert_eq!(answer, workdir.succeed("solve --points mixed.csv"));
    assert_eq!(workdir.succeed("solve --points mixed.csv -o out.csv"), "");
    assert_eq!(answer.as_bytes(), workdir.read("out.csv"));

    // Awkward numbers, without a column nu0: all come back as they were given.
    let mut contacts = Contacts::new(71);
    let draw = |_| {
        let material = contacts.material([1e-2, 1e2], [1e-1, 1e6]);
        let (e1, nu1, e0) = (material.e1_over_e2(), material.nu1(), material.e0_over_e2());
        [contacts.log_uniform(1e-2, 1e2), e1, nu1, e0]
    };
    let points: Vec<[f64; 4]> = (0..50).map(draw).collect();
    let rows = points.iter();
    let rows = rows.map(|[x, e1, nu1, e0]| format!("{x},{e1},{nu1},{e0}\n"));
    workdir.write_points(&rows.collect::<String>());
    for (arguments, nu0, tolerance) in [
        ("", 0.25, DEFAULT_TOLERANCE),
        ("--nu0 0.1 --tolerance 1e-6", 0.1, 1e-6),
    ] {
        let data = workdir.csv(format!("solve --points points.csv {arguments}"));
        assert_eq!(data.columns().join(","), COLUMNS);
        assert_eq!(data.cases().count(), points.len());
        for (case, &[x, e1, nu1, e0]) in data.cases().zip(&points) {
            let read = COLUMNS.split(',').take(5).map(|name| case.get(name));
            assert_eq!(read.collect::<Vec<_>>(), [x, e1, nu1, e0, nu0]);
            let expected = solved(x, &material([e1, nu1, e0, nu0]), tolerance);
            assert_eq!(case.quantities(), expected.quantities);
            assert_eq!(case.get("error"), expected.error);
        }
    }
}

#[test]
fn query_prints_what_the_library_looks_up_and_the_certificate() {
    let workdir = workdir!();
    let table = table(TWO_QUANTITIES);
    workdir.pack("table.bin", &table);
    let points = "e0_over_e2,nu1,a_over_t,e1_over_e2\ninf,0.5,0.1,1\ninf,0.5,3.3,1.9\n";
    workdir.write("points.csv", points);
    let run = workdir.answer("query table.bin --points points.csv");
    // The empty fields are explained.
    let why = "points.csv, line 2: fields are empty; does not hold pi0";
    assert_names(&run.stderr, why);
    assert_eq!(run.stderr.lines().count(), 1);
    let answer = run.stdout;
    let data = Data::parse("query", &answer);
    assert_eq!(data.columns().join(","), COLUMNS);
    assert_eq!(data.cases().count(), 2);
    for (case, [x, e1]) in data.cases().zip([[0.1, 1.0], [3.3, 1.9]]) {
        // The table's substrate stands in where the points have none.
        let point = [x, e1, 0.5, f64::INFINITY, 0.1];
        let [_, material @ ..] = point;
        let curve = table.curve(&acceptance::material(material));
        let curve = curve.expect("inside");
        let quantities = interp::Quantity::ALL.map(|of| curve.quantity(of, x).ok());
        let error = Some(table.description().certificate.max_error);
        let expected = [&point.map(Some)[..], &quantities, &[error]].concat();
        let found = COLUMNS.split(',').map(|name| case.text(name).parse().ok());
        assert_eq!(found.collect::<Vec<Option<f64>>>(), expected);
    }
    let to_file = "query table.bin --points points.csv -o out.csv";
    assert_eq!(workdir.run(to_file).stdout, "");
    assert_eq!(workdir.read("out.csv"), answer.as_bytes());
}

#[test]
fn a_table_of_gamma_that_begins_too_late_says_why_fields_are_empty() {
    let workdir = workdir!();
    let scene = TWO_QUANTITIES.replace("['delta0', 'eeq']", "['gamma']");
    for (from, why) in [
        ("0.3", "estimated error is"),
        ("1", "estimated error is inf"),
    ] {
        let late = scene
            .replace("from = 0.1", &format!("from = {from}"))
            .replace("1e-2", "1e-4");
        workdir.pack("late.bin", &table(&late));
        workdir.write_points("3.3,1.9,0.5,inf\n4,1,0.5,inf\n");
        let run = workdir.answer("query late.bin --points points.csv");
        for case in Data::parse("query", &run.stdout).cases() {
            assert!(case.get("gamma") > 0.0);
            assert_eq!(
                ["pi0", "eeq", "delta0"].map(|name| case.text(name)),
                [""; 3]
            );
        }
        let words = "points.csv, line 2: fields are empty; pi0 does not follow from gamma alone";
        assert_names(&run.stderr, &format!("{words}; {why}"));
    }
}

#[test]
fn query_prints_the_derivatives_that_the_table_knows() {
    let workdir = workdir!();
    let table =
        table(&TWO_QUANTITIES.replace("['delta0', 'eeq']", "['pi0', 'eeq', 'gamma', 'delta0']"));
    workdir.pack("table.bin", &table);
    workdir.write_points("3.3,1.9,0.5,inf\n");
    let data = workdir.csv("query table.bin --points points.csv --gradient");
    assert_eq!(data.columns()[..10].join(","), COLUMNS);
    let curve = table.curve_with_gradient(&material([1.9, 0.5, f64::INFINITY, 0.1]));
    let gradient = curve.expect("inside").gradient(3.3).expect("inside");
    let case = data.first();
    for quantity in interp::Quantity::ALL {
        let name = |parameter: &str| format!("d_{}_d_{parameter}", quantity.name());
        let by_radius = gradient.slopes().get(quantity) / 3.3;
        assert_eq!(case.get(&name("a_over_t")), by_radius);
        let by_film = gradient.by(interp::MaterialParameter::E1OverE2);
        let by_film = by_film.expect("an axis").get(quantity);
        assert_eq!(case.get(&name("e1_over_e2")), by_film);
        // The scene fixes it; a rigid substrate changes nothing.
        assert_eq!(case.text(&name("nu1")), "");
        assert_eq!(
            ["e0_over_e2", "nu0"].map(|of| case.get(&name(of))),
            [0.0; 2]
        );
    }
    workdir.pack("table.bin", &acceptance::table(TWO_QUANTITIES));
    let query = "query table.bin --points points.csv --gradient";
    workdir.refuses(format!("1 | {query} | does not hold pi0"));
}

/// A table of a single `a/t` does not tell how the quantities grow with it.
#[test]
fn a_single_a_over_t_has_no_slopes() {
    let workdir = workdir!();
    let table = table(
        "title = 'one'\na_over_t = 1\ne1_over_e2 = { from = 0.5, to = 2 }\nnu1 = 0.5\ne0_over_e2 = inf\n",
    );
    workdir.pack("table.bin", &table);
    workdir.write_points("1,1,0.5,inf\n");
    let data = workdir.csv("query table.bin --points points.csv --gradient");
    let case = data.first();
    assert_eq!(case.text("d_pi0_d_a_over_t"), "");
    assert!(case.get("d_pi0_d_e1_over_e2") != 0.0);

    let curve = table.curve(&material([1.0, 0.5, f64::INFINITY, 0.25]));
    let slope = curve.expect("inside").slope(interp::Quantity::Pi0, 1.0);
    slope.refused("a_over_t; as ranges");
    let system = System {
        probe: Probe::Paraboloid { radius: 1e-4 },
        film: solid(2e6, 0.5),
        substrate: solid(f64::INFINITY, 0.25),
        ..paper_system(1e-6)
    };
    let contact = Contact::in_table_with_gradient(&table, &system).expect("inside");
    let gradient = contact.gradient(1e-6, 0.04).expect("inside");
    for (input, is_known) in [
        (Input::FilmModulus, true),
        (Input::WorkOfAdhesion, true),
        (Input::ContactRadius, false),
        (Input::FilmThickness, false),
    ] {
        assert_eq!(gradient.by(input).is_ok(), is_known, "{input:?}");
    }
}

/// Wrong files of points, with words of the error that each must cause beside the file's name.
const BAD_POINTS: &str = r"
    missing column | a_over_t,e1_over_e2,nu1\n1,1,0.5\n | e0_over_e2; header
    unknown column | a_over_t,e1_over_e2,nu1,e0_over_e2,nu2\n1,1,0.5,inf,0.3\n | nu2; header
    column twice | a_over_t,e1_over_e2,nu1,e0_over_e2,nu1\n1,1,0.5,inf,0.3\n | nu1; header; twice
    text | a_over_t,e1_over_e2,nu1,e0_over_e2\n1,1,0.5,inf\n1,1,half,inf\n | line 3; nu1; half
    no number | a_over_t,e1_over_e2,nu1,e0_over_e2\n1,1,,inf\n | line 2; nu1
    too few fields | a_over_t,e1_over_e2,nu1,e0_over_e2\n1,1,0.5,inf\n1,1,0.5\n | line; 3
    too many fields | a_over_t,e1_over_e2,nu1,e0_over_e2\n1,1,0.5,inf,1\n | line; 2
    empty |  | no points
    header only | a_over_t,e1_over_e2,nu1,e0_over_e2\n | no points
    nan material | a_over_t,e1_over_e2,nu1,e0_over_e2\n1,nan,0.5,inf\n | line 2; e1_over_e2; NaN
    unphysical | a_over_t,e1_over_e2,nu1,e0_over_e2\n1,1,0.5,inf\n1,1,0.6,inf\n | line 3; nu1; 0.6; (-1, 0.5]
    nan a_over_t | a_over_t,e1_over_e2,nu1,e0_over_e2\n1,1,0.5,inf\nnan,1,0.5,inf\n | line 3; a_over_t; NaN
    negative a_over_t | a_over_t,e1_over_e2,nu1,e0_over_e2\n-1,1,0.5,inf\n | line 2; a_over_t; -1
    lines of Windows | a_over_t,e1_over_e2,nu1,e0_over_e2\r\n1,1,0.5,inf\r\n\r\n# next\r\n1,1,0.6,inf\r\n | line 5; nu1; 0.6
    semicolons | a_over_t;e1_over_e2;nu1;e0_over_e2\n1;1;0.5;inf\n | header; separate the columns by commas
    another encoding | a\0_\0 | save it with this encoding
";

#[test]
fn a_bad_file_of_points_is_named_with_the_line() {
    let workdir = workdir!();
    workdir.pack("table.bin", &table(TWO_QUANTITIES));
    for command in ["solve", "query table.bin"] {
        assert_cases(BAD_POINTS, |[_, text, _]| {
            let escapes = [("\\n", "\n"), ("\\r", "\r"), ("\\0", "\0")];
            let replaced = |text: String, (escape, byte)| text.replace(escape, byte);
            let text = escapes.into_iter().fold(text.to_owned(), replaced);
            workdir.write("points.csv", &text);
            let message = workdir.fail(1, format!("{command} --points points.csv -o out.csv"));
            assert!(message.contains("points.csv"), "{text}: {message}");
            message
        });
    }
    assert_eq!(workdir.files(), ["points.csv", "table.bin"]);
}

#[test]
fn solve_adds_the_columns_of_other_probes() {
    let workdir = workdir!();
    let given = material([1.75, 0.5, 1e5, 0.25]);
    let (solution, power_laws) =
        solve_power_laws(3.0, &given, &[1.0, 2.5], DEFAULT_TOLERANCE).expect("within reach");
    let point = "--a-over-t 3 --e1-over-e2 1.75 --nu1 0.5 --e0-over-e2 1e5";
    let probes = "--exponent 1 --exponent 2.5";
    let arguments = format!("solve {point} {probes}");
    let expected = [
        ("pi_1", power_laws[0].pi),
        ("delta_1", power_laws[0].delta),
        ("pi_2.5", power_laws[1].pi),
        ("delta_2.5", power_laws[1].delta),
        ("error", solution.error),
    ];
    let text = workdir.succeed(&arguments);
    let json = workdir.succeed(format!("{arguments} --json"));
    for (name, value) in expected {
        assert_names(&text, &format!("{name:13} = {value:?}\n"));
        assert_names(&json, &format!("\"{name}\":{value:?}"));
    }

    workdir.write_points("3,1.75,0.5,1e5\n");
    let data = workdir.csv(format!("solve --points points.csv {probes}"));
    let further = "pi_1,delta_1,pi_2.5,delta_2.5";
    assert_eq!(data.columns().join(","), format!("{COLUMNS},{further}"));
    for (name, value) in expected {
        assert_eq!(data.column(name), [value], "{name}");
    }

    workdir.write_points("3,1.75,half,1e5\n");
    workdir.refuses(format!(
        "
        1 | solve --points points.csv | line 2; nu1 = \"half\" is not a number; the decimal mark is a point
        1 | curve --specimen paper --from nan | --from is NaN m; --to; not given
        1 | solve {point} --exponent 0 | exponent = 0.0; 0.1 to 20.0
        1 | solve {point} --exponent nan | exponent = NaN; 0.1 to 20.0
        1 | solve {point} --exponent -1 | exponent = -1.0; 0.1 to 20.0
        1 | solve {point} --exponent 1 --exponent 1.0 | --exponent 1; twice
        "
    ));
}
