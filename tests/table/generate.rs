//! `tabulate generate`: scenes, the file that it writes, and its certificate.

use acceptance::{Workdir, all_bits, assert_cases, assert_names, table, workdir};

const SCENE: &str = "\
title = 'A small box'
tolerance = 1e-1
a_over_t = { from = 0.1, to = 10, nodes = 8 }
e1_over_e2 = { from = 0.3, to = 3, nodes = 4 }
nu1 = 0.5
e0_over_e2 = inf
";
/// An incompressible film between rigid bodies. The method loses too many digits to rounding for
/// this tolerance.
const OUT_OF_REACH: &str = "\
title = 'Out of reach'
tolerance = 1e-10
a_over_t = { from = 1e3, to = 1e4, nodes = 2 }
e1_over_e2 = 0
nu1 = 0.5
e0_over_e2 = inf
";

fn workdir() -> Workdir {
    let workdir = workdir!();
    workdir.write("scene.toml", SCENE);
    workdir.write("out_of_reach.toml", OUT_OF_REACH);
    workdir
}

#[test]
fn a_table_is_written_beside_its_scene_or_where_it_is_asked_for() {
    let workdir = workdir();
    let summary = workdir.succeed("generate scene.toml --certificate-points 50 --seed 7");
    let found = workdir.table("scene.h5");
    assert_eq!(all_bits(&found), all_bits(&table(SCENE)));
    let description = found.description();
    assert_eq!(description.title, "A small box");
    assert_eq!((&*description.scene, description.tolerance), (SCENE, 1e-1));
    let certificate = description.certificate;
    assert_eq!((certificate.points, certificate.seed), (50, 7));
    let version = concat!("tabulate ; ", env!("CARGO_PKG_VERSION"));
    assert_names(&description.created_by, version);
    let words = "A small box; scene.h5; 32 points; 50 direct solves, seed 7";
    assert_names(&summary, words);

    let other = "generate scene.toml -o other.h5 --certificate-points 50 --seed 7 --tolerance 5e-2";
    workdir.succeed(other);
    assert_eq!(workdir.table("other.h5").description().tolerance, 5e-2);
    let files = ["other.h5", "out_of_reach.toml", "scene.h5", "scene.toml"];
    assert_eq!(workdir.files(), files);
}

#[test]
fn an_output_that_cannot_be_written_fails_before_any_solving() {
    let workdir = workdir();
    std::fs::create_dir(workdir.path("folder")).expect("a new folder");
    let before = workdir.files();
    // This scene fails when it is solved. The output is refused before.
    for output in ["missing/table.h5", "folder", "scene.toml/table.h5"] {
        let message = workdir.fail(1, format!("generate out_of_reach.toml -o {output}"));
        assert_names(&message, &["cannot write", output]);
        assert!(!message.contains("tolerance"), "{message}");
    }
    assert_eq!(workdir.files(), before);
}

#[test]
fn a_failing_generate_leaves_the_table_that_was_there_and_nothing_else() {
    let workdir = workdir();
    workdir.succeed("generate scene.toml -o table.h5 --certificate-points 50");
    let (bytes, files) = (workdir.read("table.h5"), workdir.files());
    let message = workdir.fail(1, "generate out_of_reach.toml -o table.h5");
    assert_names(&message, "tolerance; is not reached; estimated error");
    workdir.write("wrong.toml", "title = 1\n");
    workdir.fail(1, "generate wrong.toml -o table.h5");
    std::fs::remove_file(workdir.path("wrong.toml")).expect("it is there");
    assert_eq!(workdir.files(), files);
    assert!(workdir.read("table.h5") == bytes, "the table has changed");
}

#[test]
fn a_table_that_misses_its_tolerance_is_written_and_the_status_is_1() {
    let workdir = workdir();
    workdir.write("coarse.toml", SCENE.replace("nodes = 8", "nodes = 4"));
    let run = workdir.run("generate coarse.toml --tolerance 1e-5 --certificate-points 100");
    assert_eq!(run.status, 1, "{run:?}");
    let table = workdir.table("coarse.h5");
    assert_eq!(table.description().tolerance, 1e-5);
    let error = table.description().certificate.max_error;
    assert!(error > 1e-5, "{error}");
    let words = format!("coarse.h5; {error:.1e}; 1e-5; is written; exceeds the tolerance");
    assert_names(&run.stderr, &words);
    // No progress bar where there is no terminal.
    assert_eq!(run.stderr.lines().count(), 1, "{run:?}");
    assert_names(&run.stdout, &["certified error", &format!("{error:.1e}")]);
    let files = "coarse.h5 coarse.toml out_of_reach.toml scene.toml";
    assert_eq!(workdir.files().join(" "), files);
}

/// The corners of the box are nodes, at which a table has no error.
#[test]
fn a_few_points_are_off_the_nodes() {
    let workdir = workdir();
    let scene = "title = 'x'\na_over_t = { from = 1e-2, to = 1e2, nodes = 3 }\ne1_over_e2 = 1\nnu1 = 0.5\ne0_over_e2 = 1e4\n";
    workdir.write("scene.toml", scene);
    for points in ["1", "2", "10"] {
        let run = workdir.run(format!("generate scene.toml --certificate-points {points}"));
        assert_eq!(run.status, 1, "{points} points");
        let table = workdir.table("scene.h5");
        let error = table.description().certificate.max_error;
        assert!(error > 1e-2, "{points} points: {error:e}");
    }
}

/// Near a Poisson ratio of -1 the film's moduli span fifteen decades, in a part of the range that
/// holds no node but the first.
#[test]
fn a_range_that_no_number_of_nodes_resolves_is_an_error_that_names_it() {
    let workdir = workdir();
    workdir.write("steep.toml", "title = 'x'\ntolerance = 1e-8\na_over_t = 1\ne1_over_e2 = 1\nnu1 = { from = -0.999999999999999, to = 0.5 }\ne0_over_e2 = 10\n");
    let before = workdir.files();
    let words = "nu1 would take; nodes or more; 1e-8; smaller range";
    workdir.refuses(format!("1 | generate steep.toml | {words}"));
    assert_eq!(workdir.files(), before);
}

#[test]
fn a_plan_says_what_is_made_and_makes_nothing() {
    let workdir = workdir();
    let scene = SCENE.replace(", nodes = 8", "").replace(", nodes = 4", "");
    workdir.write("box.toml", scene.replace("1e-1", "1e-4"));
    let before = workdir.files();
    let plan = workdir.succeed("generate box.toml --plan");
    assert_eq!(workdir.files(), before);
    workdir.succeed("generate box.toml --certificate-points 50");
    let [n_a, n_e1, ..] = workdir.table("box.h5").shape();
    let nodes = [
        format!("0.1 to 10, {n_a} nodes"),
        format!("0.3 to 3, {n_e1} nodes"),
        format!("{} and 5000 for the certificate", n_a * n_e1),
    ];
    assert_names(&plan, &nodes.each_ref().map(String::as_str));
    assert_names(&plan, &["time", "about", "memory", "MB", "size", "kB"]);
}

#[test]
fn a_wrong_scene_is_named_with_key_value_and_range() {
    // The line that is changed, its new text, and words of the error.
    let changes = r"
        nu1 = 0.5 | nu1 = 0.5\nnu2 = 0.3 | nu2; nu1
        e0_over_e2 = inf | e0_over_e2 = inf\n[[layers]]\nthickness = 1 | layers; [stack]; [[stack.layers]]; e1_over_e2
        nu1 = 0.5 | nu1 = 0.5\nstack = 'primer.toml' | stack; primer.toml; base = { .. }; layers
        title = 'A small box' |  | title
        nu1 = 0.5 |  | nu1
        title = 'A small box' | title = 3 | title; string
        nu1 = 0.5 | nu1 = 'half' | nu1; half; a number or a range
        nu1 = 0.5 | nu1 = [0.3, 0.5] | nu1; a number or a range
        nu1 = 0.5 | nu1 = { from = 0.3 } | nu1; to
        nu1 = 0.5 | nu1 = { from = 0.3, to = 0.5, steps = 3 } | nu1; steps
        nu1 = 0.5 | nu1 = 0.6 | nu1; 0.6; (-1, 0.5]
        nu1 = 0.5 | nu1 = nan | nu1; NaN
        nu1 = 0.5 | nu1 = { from = 0.3, to = 0.500001 } | nu1.to; 0.500001; (-1, 0.5]
        nu1 = 0.5 | nu1 = { from = 0.5, to = 0.3 } | nu1; empty; 0.5; 0.3
        nu1 = 0.5 | nu1 = { from = 0.3, to = 0.5, nodes_per_decade = 3 } | nu1; nodes_per_decade
        nodes = 8 | nodes = 8, nodes_per_decade = 4 | a_over_t; both nodes and nodes_per_decade
        nodes = 8 | nodes = 1 | a_over_t; 1 nodes; 2 to
        nodes = 8 | nodes = 2.5 | a_over_t; 2.5 nodes; whole
        nodes = 8 | nodes = -3 | a_over_t; -3 nodes; 2 to
        nodes = 8 | nodes = 8.5 | a_over_t; 8.5
        from = 0.1, to = 10 | from = 1, to = 1 | a_over_t; empty; 1
        from = 0.1, to = 10 | from = 0, to = 10 | a_over_t.from; 0; 1e-6 to 1e6
        from = 0.3, to = 3 | from = 0.3, to = inf | e1_over_e2.to; inf; is outside 1e-30 to 1e30
        e0_over_e2 = inf | e0_over_e2 = 0 | e0_over_e2; 0; is outside 1e-30 to 1e30; e0_over_e2 = inf
        e0_over_e2 = inf | e0_over_e2 = -3.0 | e0_over_e2; -3; is outside 1e-30 to 1e30
        e0_over_e2 = inf | e0_over_e2 = inf\nnu0 = 0.7 | nu0; 0.7; (-1, 0.5]
        tolerance = 1e-1 | tolerance = 1e-20 | tolerance; 1e-10 to 1e-1
        tolerance = 1e-1 | quantities = [] | quantities; pi0, eeq, gamma, delta0
        tolerance = 1e-1 | quantities = ['pi0', 'pi0'] | quantities; each once
        tolerance = 1e-1 | quantities = ['pi1'] | quantities; pi1; pi0
        ";
    let workdir = workdir();
    assert_cases(changes, |[line, change, _]| {
        assert!(SCENE.contains(line));
        let change = change.replace("\\n", "\n");
        workdir.write("changed.toml", SCENE.replacen(line, &change, 1));
        let message = workdir.fail(1, "generate changed.toml -o table.h5");
        assert!(message.contains("changed.toml"), "{change}: {message}");
        message
    });
    assert!(!workdir.files().contains(&"table.h5".to_owned()));
    workdir.refuses("1 | generate missing.toml | missing.toml; No such file");
}

#[test]
fn wrong_arguments_are_named() {
    let workdir = workdir();
    workdir.write("scene", SCENE);
    workdir.refuses(
        "
        2 | generate scene.toml --jobs 0 | --jobs; 0
        2 | generate scene.toml --certificate-points 0 | --certificate-points; 0
        1 | generate scene.toml --tolerance -1 | tolerance; -1
        1 | generate scene.toml --tolerance nan | tolerance; NaN
        2 | generate scene.toml -o scene.toml | scene.toml; let the name end in .h5
        1 | generate scene -o scene | scene; it is the input
        ",
    );
    let files = ["out_of_reach.toml", "scene", "scene.toml"];
    assert_eq!(workdir.files(), files);
}
