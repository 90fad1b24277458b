//! `tabulate history`: the numbers of the library, the columns, and what mistakes are told.

use acceptance::{Case, Data, Workdir, assert_names, assert_near, workdir};

const GEL: &str = "history --sphere-radius=10um --sphere-modulus=inf --film-modulus=1kPa \
     --film-poisson-ratio=0.5 --film-thickness=3.5um --substrate-modulus=inf \
     --substrate-poisson-ratio=0.25 --relaxation=prony --relaxed-fraction=0.3 \
     --relaxation-time=0.6";
/// Runs the program, which must succeed, and returns its rows. The warning about the strain is
/// meant.
fn rows(workdir: &Workdir, arguments: &str) -> Data {
    Data::parse("history", &workdir.answer(arguments).stdout)
}

/// A cone with a flat end of 1 um.
const FLAT: &str = "history --probe=flat-ended-cone --half-angle=70 --sphere-radius=1um --sphere-modulus=inf \
     --film-modulus=1kPa --film-poisson-ratio=0.5 --substrate-modulus=inf --relaxation=power-law -n=0.2 \
     --program 'penetration 0:0 1:1nm'";

const PROGRAM: &str = "--program 'penetration 0:0 1:1um 2:1um 3:0'";

/// The independent series that has this gel.
#[test]
fn the_columns_hold_an_independent_series() {
    let workdir = workdir!();
    let data = Data::read("viscoelastic");
    let of_gel = |row: &Case<'_>| row.text("protocol") == "approach-hold-retract-sls";
    let series: Vec<_> = data.cases().filter(of_gel).collect();
    let times: Vec<&str> = series.iter().map(|row| row.text("time")).collect();
    let at = format!("--at={}", times.join(","));
    let own = rows(&workdir, &format!("{GEL} {PROGRAM} {at}"));
    let columns = "time penetration load contact_radius phase";
    assert_eq!(own.columns().join(" "), columns);
    assert_eq!(own.cases().count(), series.len());
    for (own, row) in own.cases().zip(&series) {
        for (column, largest) in [
            ("time", 3.0),
            ("penetration", 1e-6),
            ("load", 1.84e-8),
            ("contact_radius", 4.4e-6),
        ] {
            assert_near(own.get(column), row.get(column), 1e-8 * largest);
        }
    }
    let phases: Vec<String> = own.cases().map(|row| row.text("phase").into()).collect();
    let spans = [
        ("advancing", 3),
        ("resting", 2),
        ("receding", 5),
        ("separated", 1),
    ];
    assert_eq!(
        phases,
        spans.map(|(phase, rows)| vec![phase; rows]).concat()
    );
}

/// The table, the curve of direct solves, a file and the text, a held end: one history.
#[test]
fn all_ways_to_ask_agree() {
    let workdir = workdir!();
    let loads = |arguments: &str| rows(&workdir, &format!("{GEL} {arguments}")).column("load");
    let close = |a: &[f64], b: &[f64], tolerance: f64| {
        assert_eq!(a.len(), b.len());
        for (a, b) in a.iter().zip(b) {
            assert_near(*a, *b, tolerance * 2e-8);
        }
    };
    let solved = loads(&format!("{PROGRAM} --points 7"));
    let at = format!("{PROGRAM} --at=0,0.5,1,1.5,2,2.5,3");
    close(&solved, &loads(&at), 1e-8);
    let embedded = format!("embedded {PROGRAM} --points 7");
    close(&solved, &loads(&embedded), 1e-4);
    for text in [
        "# a file\nnote,time,penetration\n,0,0\n,1,1um\n,2,1e-6\n,3,0\n",
        "time [ms],Penetration (nm)\n0,0\n1000,1000\n2000,1um\n3000,0\n",
    ] {
        workdir.write("moves.csv", text);
        close(&solved, &loads("--program moves.csv --points 7"), 1e-8);
    }
    // Held, and in another order.
    let held = loads("--program 'penetration 0:0 1:1um' --at=1.5,0.5,1");
    close(&held, &[solved[3], solved[1], solved[2]], 1e-8);
    // Under the loads of a creep test the penetration grows.
    let creep = "--program 'load 0:0 0.5:10nN' --at=0.5,1,10";
    let depths = rows(&workdir, &format!("{GEL} {creep}")).column("penetration");
    assert!(depths[0] < depths[1] && depths[1] < depths[2], "{depths:?}");
    // A stiff cantilever imposes the penetration.
    let heights = "--program 'height 0:0 1:1um 2:1um 3:0' --stiffness=100kN/m --points=7";
    close(&solved, &loads(heights), 2e-5);
}

#[test]
fn adhesion_pulls_on_the_way_out_only() {
    let workdir = workdir!();
    let adhesive = "--work-of-adhesion-receding=20uJ/m^2 --points=31";
    let [adhesive, plain] = [adhesive, "--points=31"]
        .map(|more| rows(&workdir, &format!("{GEL} {PROGRAM} {more}")).column("load"));
    // Both are within the default tolerance of the largest load.
    let largest = plain.iter().copied().fold(0.0, f64::max);
    for (own, plain) in adhesive.iter().zip(&plain).take(21) {
        assert_near(*own, *plain, 2e-8 * largest);
    }
    assert!(adhesive.iter().any(|load| *load < -1e-10));
    assert!(plain.iter().all(|load| *load >= 0.0));
}

#[test]
fn the_error_and_the_doubts_are_stated() {
    let workdir = workdir!();
    let run = workdir.answer(format!("{GEL} {PROGRAM} --points=3"));
    assert_names(
        &run.stderr,
        "would compress the film by 29 % of the thickness",
    );
    assert!(!run.stderr.contains("estimated"), "{}", run.stderr);
    let glued = format!("{GEL} {PROGRAM} --interface-stiffness=100MPa/m");
    let told = "all layers, and springs between them, relax by one law";
    assert_names(&workdir.answer(&glued).stderr, told);
    for silent in [
        format!("{glued} --all-relax"),
        format!("{GEL} {PROGRAM} --interface=sliding"),
    ] {
        assert!(!workdir.answer(silent).stderr.contains(told));
    }
    // The paper's sphere yields, and not its film.
    let penetration = "-p 'penetration 0:0 1:0.5um' --points 3";
    let law = "--all-relax --relaxation power-law -n 0.2";
    let run = workdir.answer(format!("history --specimen paper {law} {penetration}"));
    assert_eq!(run.stderr, "");
    // A second approach is followed by elements, whose error is told.
    let again = "--program 'penetration 0:0 1:100nm 2:0 3:100nm' --points=3";
    let run = workdir.answer(format!("{GEL} {again}"));
    assert!(run.stderr.contains("\n# estimated error: "), "{run:?}");
    let soft = "--substrate-modulus=20kPa";
    let gel = GEL.replace("--substrate-modulus=inf", soft);
    let error = workdir.fail(1, format!("{gel} {PROGRAM}"));
    assert_names(&error, &["do not relax", "2e-2"]);
    workdir.answer(format!("{gel} {PROGRAM} --all-relax"));
    let stiffer = "--substrate-modulus=1MPa";
    let gel = GEL.replace("--substrate-modulus=inf", stiffer);
    let run = workdir.answer(format!("{gel} {PROGRAM}"));
    assert_names(&run.stderr, "warning; do not relax");
}

#[test]
fn mistakes_are_told() {
    let workdir = workdir!();
    let (film, _) = GEL.split_once(" --relaxation=").expect("a law");
    for (file, text) in [
        ("radii.csv", "time,contact_radius\n0,1\n"),
        ("both.csv", "time,load,penetration\n0,0,0\n"),
        ("twice.csv", "time,time,load\n0,0,0\n"),
        ("untimed.csv", "t,load\n0,0\n"),
        ("swapped.csv", "time,penetration\n0,0\n1e-6,1\n0,2\n"),
        ("semicolons.csv", "time;load\n0;0\n"),
        ("parsecs.csv", "time [parsec],load\n0,0\n"),
        ("words.csv", "time,load\r\n0,0\r\n# later\r\n1,much\r\n"),
    ] {
        workdir.write(file, text);
    }
    let two = "--relaxation=prony --relaxed-fraction=0.3 --relaxation-time=1,2";
    workdir.refuses(format!(
        "
        2 | {GEL} | --program
        2 | {film} {PROGRAM} | --relaxation
        2 | {film} {PROGRAM} --relaxation=sls | prony; power-law; fractional-zener
        1 | {film} {PROGRAM} --relaxation=power-law | --relaxation-exponent; 0.2
        1 | {film} {PROGRAM} --relaxation=power-law --relaxation-exponent=0.2 --relaxed-fraction=0.1 | power-law has no --relaxed-fraction
        1 | {film} {PROGRAM} --relaxation=prony | --relaxed-fraction
        1 | {film} {PROGRAM} {two} | --relaxation-weight; one weight for each time
        1 | {film} {PROGRAM} {two} --relaxation-weight=0.3,0.3 | sum; must be 1
        1 | {GEL} --program '0:0 1:1um' | penetration, load or height; 0:0
        1 | {GEL} --program 'penetration 0:0 1um' | 1um; time:value
        1 | {GEL} --program 'penetration 0:0 1:1nN' | 1nN
        1 | {GEL} --program 'height 0:0 1:1um' | --stiffness
        1 | {GEL} {PROGRAM} --stiffness=1 | --stiffness; height
        1 | {GEL} --program moves.csv | moves.csv; CSV file, or text
        1 | {GEL} --program radii.csv | radii.csv; heading penetration or height; penetration [um]; contact_radius
        1 | {GEL} --program both.csv | only one
        1 | {GEL} --program untimed.csv | t, load; column of times
        1 | {GEL} --program swapped.csv | point 3; 0.0 s; rise
        1 | {GEL} --program semicolons.csv | separate the columns by commas
        1 | {GEL} --program words.csv | words.csv; line 4; much
        1 | {GEL} {PROGRAM} --work-of-adhesion=1mJ/m^2 | --work-of-adhesion-receding
        2 | {GEL} {PROGRAM} --at=1 --points=3 | --points
        1 | {GEL} --program 'penetration 0:0 1:1mm' | penetration
        1 | {GEL} --program parsecs.csv | time [parsec]; parsec; a time
        1 | {GEL} --program twice.csv | time, time, load; one column of times
        1 | {FLAT} --film-thickness=1nm | flat end of the probe, 1e-6 m; give a TABLE
        "
    ));
}

/// A load that falls is followed by elements, which reach no tolerance of 1e-5 here. Without a tolerance the
/// answer comes with its error, which is true beside a run to a tolerance of its own.
#[test]
fn a_load_that_falls_comes_with_its_error() {
    let workdir = workdir!();
    let gel = GEL.split(" --relaxation").next().expect("a text");
    let program = "--relaxation=power-law --relaxation-exponent=0.2 --program 'load 0:0 1:1nN 2:0' --points 5";
    let run = workdir.answer(format!("{gel} {program}"));
    let (_, stated) = run.stderr.split_once("# estimated error: ").expect("it");
    let (stated, _) = stated.split_once(" of ").expect("an error");
    let stated: f64 = stated.parse().expect("a number");
    assert!(1e-5 < stated && stated < 1e-2, "{stated}");
    let message = workdir.fail(1, format!("{gel} {program} --tolerance=1e-5"));
    assert_names(&message, &["tolerance 1e-5 is not reached; give one above"]);
    let own = Data::parse("history", &run.stdout).column("penetration");
    let other = rows(&workdir, &format!("{gel} {program} --tolerance=1e-3"));
    let largest = own.iter().copied().fold(0.0, f64::max);
    for (own, other) in own.iter().zip(other.column("penetration")) {
        assert_near(*own, other, (stated + 1e-3) * largest);
    }
}

/// The flat end is as wide as a tenth of the film is thick, and times of a file have units.
#[test]
fn a_flat_end_and_times_with_units() {
    let workdir = workdir!();
    workdir.write("units.csv", "time,penetration\n0,0\n1e3ms,0.1um\n");
    let flat = FLAT.split(" --program").next().expect("a text");
    let of = |program: &str| {
        let more = format!("--film-thickness=10um --program {program} --points 2");
        rows(&workdir, &format!("{flat} {more}")).column("load")
    };
    let loads = of("units.csv");
    assert_eq!(loads, of("'penetration 0:0 1:0.1um'"));
    assert!(loads[1] > 0.0);
    // On a film 100,000 times as thick as the flat end is wide, the curve begins at its edge.
    let thick = flat.replace("=1um", "=10nm") + " --film-thickness=1mm --points=2";
    let wide = rows(
        &workdir,
        &format!("{thick} --program 'penetration 0:0 1:200um'"),
    );
    assert!(wide.column("contact_radius")[1] > 1e-4);
}

const RELAXING: &str = "history --sphere-radius=10um --sphere-modulus=inf --film-poisson-ratio=0.5 \
     --substrate-poisson-ratio=0.25 --relaxation=prony --relaxed-fraction=0.3 --relaxation-time=0.6 \
     --points 5";

#[test]
fn a_stiff_film_on_a_soft_base_that_relax_together_is_told_of() {
    let workdir = workdir!();
    let bodies = "--film-thickness=100um --program 'penetration 0:0 1:0.1um'";
    for (film, base, told) in [
        ("10kPa", "1kPa", true),
        ("1kPa", "10kPa", false),
        ("2kPa", "1kPa", false),
    ] {
        let moduli = format!("--film-modulus={film} --substrate-modulus={base} --all-relax");
        let run = workdir.answer(format!("{RELAXING} {bodies} {moduli}"));
        let is_told = run.stderr.contains("pull at the probe inside");
        assert_eq!(is_told, told, "{run:?}");
    }
    let alone = "--film-modulus=1MPa --substrate-modulus=0.2MPa --film-thickness=10um";
    let program = "--program 'penetration 0:0 1:1nm'";
    let run = workdir.answer(format!("{RELAXING} {alone} {program}"));
    assert!(!run.stderr.contains("pull at the probe"), "{run:?}");
}

/// What a contact leaves out in a force curve, it leaves out in time: friction on a thin film that keeps its volume, and the
/// bending of a stiff one under a cone.
#[test]
fn what_curves_are_told_of_histories_are_told_of() {
    let workdir = workdir!();
    let notes = |bodies: &str| {
        let law = "--relaxation=prony --relaxed-fraction=0.3 --relaxation-time=0.6 --points 3";
        let run = workdir.answer(format!("history --sphere-modulus=inf {law} {bodies}"));
        run.stderr
    };
    let gel = "--sphere-radius=100um --film-modulus=100kPa --film-poisson-ratio=0.5 --film-thickness=10um \
               --substrate-modulus=inf --program 'penetration 0:0 1:0.9um'";
    let gel = notes(gel);
    assert_names(
        &gel,
        &["full friction", "a flat punch", "would be stiffer by 1"],
    );
    assert!(!gel.contains("--friction"), "{gel}");
    let narrow = "--sphere-radius=100um --film-modulus=100kPa --film-poisson-ratio=0.5 --film-thickness=100um \
                  --substrate-modulus=inf --program 'penetration 0:0 1:0.9um'";
    assert_eq!(notes(narrow), "");
    let stiff = "--probe=cone --half-angle=89 --film-modulus=1GPa --film-poisson-ratio=0.3 --film-thickness=1um \
                 --substrate-modulus=1MPa --substrate-poisson-ratio=0.3 --all-relax --program 'penetration 0:0 1:0.4um'";
    assert_names(
        &notes(stiff),
        &["may be no disc", "touches the probe farther outside"],
    );
}
