//! `tabulate pull-off` where the contact is far smaller or wider than the film is thick: it chooses the
//! radii that it solves, and its messages speak of what was given.

use std::f64::consts::PI;

use acceptance::{Data, assert_close, assert_names, number, value, workdir};

#[test]
fn a_film_much_thicker_than_the_sphere_is_solved() {
    let workdir = workdir!();
    let bodies = "--sphere-radius 1e-6 --sphere-modulus inf --film-modulus 2e4 --work-of-adhesion 1e-4 \
         --film-thickness";
    // -1.5 pi w R on a half-space, to the film's (a/t).
    let half_space = -1.5 * PI * 1e-10;
    for thickness in ["1e-4", "1e-3", "1e-2"] {
        let text = workdir.succeed(format!("pull-off {bodies} {thickness}"));
        assert_close(value(&text, "load"), half_space, 0.05);
        let embedded = workdir.succeed(format!("pull-off embedded {bodies} {thickness}"));
        assert_close(value(&text, "load"), value(&embedded, "load"), 1e-5);
    }
    for thickness in ["0.9", "1e3"] {
        let words = "the film is so thick; 1e4 times the radius of the sphere";
        let pull_off = "pull-off --allow magnitudes";
        workdir.refuses(format!("1 | {pull_off} {bodies} {thickness} | {words}"));
    }
}

/// On this film rounding does not let the widest contacts be solved to 1e-9.
#[test]
fn an_incompressible_film_between_rigid_bodies_is_solved() {
    let workdir = workdir!();
    let bodies = "--sphere-radius 10um --sphere-modulus inf --film-modulus 5kPa --film-poisson-ratio 0.5 \
                  --substrate-modulus inf --work-of-adhesion 50uJ/m^2 --film-thickness";
    for thickness in ["20um", "1um"] {
        let load = |command: &str| {
            // On standard error the program says how much friction would change.
            let run = workdir.run(format!("{command} {bodies} {thickness}"));
            value(&run.stdout, "load")
        };
        assert_close(load("pull-off"), load("pull-off embedded"), 2e-6);
    }
}

/// A flat end that is narrower than the smallest contact of the first curve that is solved.
#[test]
fn a_flat_end_far_narrower_than_the_film_is_thick_is_solved() {
    let workdir = workdir!();
    let bodies = "--probe flat-ended-cone --sphere-radius 2e-8 --half-angle 68.75 --sphere-modulus inf \
         --film-modulus 2e4 --film-poisson-ratio 0.5 --film-thickness 1e-3 \
         --substrate-modulus 7e10 --work-of-adhesion 1e-4";
    // The smallest load over all contact radii, by a fine scan.
    for table in ["pull-off", "pull-off embedded"] {
        let text = workdir.succeed(format!("{table} {bodies}"));
        let [load, radius] = ["load", "contact_radius"].map(|name| value(&text, name));
        assert_close(load, -1.100e-10, 1e-3);
        assert_close(radius, 1.419e-7, 1e-3);
    }
}

#[test]
fn a_short_range_on_a_thin_film_is_refused_with_the_reach() {
    let workdir = workdir!();
    let arguments = "pull-off --film-thickness 1e-7 --interaction-range 1e-10";
    let error = workdir.fail(1, arguments);
    assert_names(&error, &["pull-off", "1.200e-5 m", "1e-7 m"]);
    assert!(!error.contains("contact radius"), "{error}");
}

/// Lower layers like the base make the contact wide beside the one that is left.
#[test]
fn a_thin_layer_on_layers_like_the_base_is_refused_with_the_a_over_t_given() {
    let workdir = workdir!();
    let base = "{ young_modulus = 1e6, poisson_ratio = 0.3 }";
    let layer = |young: &str, thickness: &str| {
        format!(
            "[[layers]]\nyoung_modulus = {young}\npoisson_ratio = 0.3\nthickness = {thickness}\n"
        )
    };
    let text = format!(
        "base = {base}\n{}{}",
        layer("1e6", "1e-3"),
        layer("5e6", "1e-9")
    );
    workdir.write("stack.toml", &text);
    let arguments = "solve --stack stack.toml --sphere-modulus 2e6 --a-over-t";
    let error = workdir.fail(1, format!("{arguments} 6.04"));
    assert_names(&error, &["a_over_t = 6.04", "top layer"]);
    assert!(!error.contains("outside the domain"), "{error}");
    workdir.succeed(format!("{arguments} 0.9"));
}

/// The contact is 4000 times as wide as the film is thick; its load is that on the substrate alone.
#[test]
fn a_pull_off_beyond_the_nodes_of_the_table_is_solved_without_it() {
    let workdir = workdir!();
    let bodies = "--specimen paper --film-thickness 10nm";
    let words = "1e-5 m; without a table `tabulate pull-off` solves";
    workdir.refuses(format!("1 | pull-off embedded {bodies} | {words}"));
    let text = workdir.succeed(format!("pull-off {bodies}"));
    let substrate = -1.5 * PI * 0.04 * 1e-3;
    assert_close(value(&text, "load"), substrate, 1e-3);
}

/// The contact of a flat end has one radius, which a narrow range of `a/t` need not hold.
#[test]
fn a_flat_end_of_any_radius_is_pulled_off_without_a_table() {
    let workdir = workdir!();
    let bodies =
        "pull-off --specimen paper --probe flat-punch --film-thickness 10um --sphere-radius";
    let of_table = bodies.replace("pull-off", "pull-off embedded");
    let cone = bodies.replace("flat-punch", "flat-ended-cone --half-angle 70deg");
    for radius in ["5nm", "50mm"] {
        let [solved, looked_up] = [bodies, &of_table].map(|words| {
            let text = workdir.succeed(format!("{words} {radius}"));
            value(&text, "load")
        });
        assert_close(solved, looked_up, 1e-5);
    }
    // The line stays at the edge of so wide an end.
    let loads = [bodies, &cone].map(|words| {
        let text = workdir.succeed(format!("{words} 50mm"));
        value(&text, "load")
    });
    assert_close(loads[0], loads[1], 1e-9);
    let base = "base = { young_modulus = 2e11, poisson_ratio = 0.25 }";
    let layers = [(5e5, 9e-6), (3.5e6, 1e-8)].map(|(modulus, thickness)| {
        format!(
            "[[layers]]\nyoung_modulus = {modulus:e}\npoisson_ratio = 0.5\nthickness = {thickness:e}\n"
        )
    });
    workdir.write("stack.toml", format!("{base}\n{}", layers.concat()));
    let on_stack =
        "pull-off --specimen paper --probe flat-punch --stack stack.toml --sphere-radius";
    let curve = on_stack.replace("pull-off", "curve");
    let text = workdir.succeed(format!("{on_stack} 9um"));
    let lowest = workdir.csv(format!("{curve} 9um")).column("load");
    assert_close(value(&text, "load"), lowest[0], 1e-6);
    workdir.refuses(format!(
        "1 | {on_stack} 11um | 1.100e-5 m; 1.000e-5 m; top layer"
    ));
}

/// The narrowest contact of the first range that is solved is wider than the sphere.
#[test]
fn a_sphere_on_a_film_1000_times_as_thick_is_pulled_off_without_a_table() {
    let workdir = workdir!();
    let bodies = "--specimen paper --probe sphere --sphere-radius 10um --film-thickness 10mm";
    let loads = ["", "embedded"].map(|table| {
        let text = workdir.succeed(format!("pull-off {table} {bodies}"));
        value(&text, "load")
    });
    assert_close(loads[0], loads[1], 1e-6);
}

/// The pull-off of a film that slides, beside the lowest load of a curve over wide contacts.
#[test]
fn a_pull_off_at_400_times_the_thickness_is_found() {
    let workdir = workdir!();
    let film = "--specimen paper --film-thickness 100nm --interface sliding";
    let text = workdir.succeed(format!("pull-off {film}"));
    let [load, radius] = ["load", "contact_radius"].map(|name| value(&text, name));
    assert!(radius > 4e-5, "{text}");
    let curve = workdir.csv(format!("curve {film} --from 40um --to 43um --points 61"));
    let lowest = curve.column("load").into_iter().fold(0.0, f64::min);
    assert_close(load, lowest, 1e-6);
}

/// Between rigid bodies the compression is the whole penetration.
#[test]
fn a_film_that_is_compressed_too_much_is_told_of() {
    let workdir = workdir!();
    let bodies = "--specimen paper --film-thickness 1um --film-modulus 10kPa --film-poisson-ratio 0.3 \
                  --sphere-radius 10um --sphere-modulus inf --substrate-modulus inf";
    for (work, told) in [("10uJ/m^2", false), ("1mJ/m^2", true)] {
        let run = workdir.answer(format!("pull-off {bodies} --work-of-adhesion {work}"));
        let radius = value(&run.stdout, "contact_radius");
        let curve = format!("curve {bodies} --work-of-adhesion 0J/m^2 --points 2");
        let radii = format!("--from {:e} --to {radius:e}", 0.5 * radius);
        let without = workdir.run(format!("{curve} {radii}"));
        let share = Data::parse("curve", &without.stdout)
            .last()
            .get("penetration")
            / 1e-6;
        assert_eq!(share > 0.1, told, "{share}");
        let text = format!("compress the film by {:.0} %", 1e2 * share);
        assert_eq!(run.stderr.contains(&text), told, "{run:?}");
    }
    // Under every probe, and of a film that slides.
    for (probe, table) in [
        ("--probe sphere", "embedded"),
        ("--probe cone --half-angle 70", ""),
        ("--probe cone --half-angle 70", "embedded"),
        ("--interface sliding", ""),
    ] {
        let bodies = match probe.contains("cone") {
            true => bodies.replace("--sphere-radius 10um", ""),
            false => bodies.to_owned(),
        };
        let adhesive = "--work-of-adhesion 1mJ/m^2";
        let run = workdir.answer(format!("pull-off {table} {bodies} {probe} {adhesive}"));
        assert_names(&run.stderr, "would compress the film by");
    }
}

/// A tenth of the load by 0.1 pi E* a/6 on a half-space.
#[test]
fn a_surface_tension_that_would_matter_is_told_of() {
    let workdir = workdir!();
    let bodies = "--half-space --film-poisson-ratio 0.5 --sphere-radius 10um --sphere-modulus inf";
    let curve = |rest: &str| workdir.answer(format!("curve {bodies} --from 1um --to 5um {rest}"));
    let gel = "--film-modulus 5kPa --work-of-adhesion 0J/m^2";
    assert_names(&curve(gel).stderr, "surface tension. One of 1.7e-3 N/m");
    let rubber = curve("--film-modulus 1MPa --work-of-adhesion 0J/m^2");
    assert!(!rubber.stderr.contains("surface tension"), "{rubber:?}");
    let pulled = workdir.answer(format!(
        "pull-off {bodies} --film-modulus 5kPa --work-of-adhesion 0.1mJ/m^2"
    ));
    let tension = 0.1 * PI * 2e4 / 3.0 * value(&pulled.stdout, "contact_radius") / 6.0;
    assert_names(
        &pulled.stderr,
        &format!("surface tension. One of {tension:.1e} N/m"),
    );
}

/// DMT's 2 pi w R under a long range, JKR's 1.5 pi w R on a thick film, and the load of the paper's film, a sliding film and a
/// contact that sticks there and back.
#[test]
fn a_measured_load_gives_the_work_of_adhesion() {
    let workdir = workdir!();
    let found = |command: String| value(&workdir.run(command).stdout, "work_of_adhesion");
    let thick = "--sphere-radius 10um --sphere-modulus inf --film-modulus 1GPa --film-poisson-ratio 0.3 --film-thickness 10mm \
         --substrate-modulus 1GPa --substrate-poisson-ratio 0.3";
    for (more, expected, tolerance) in [
        ("", 1e-6 / (1.5 * PI * 1e-5), 1e-12),
        ("--interaction-range 300nm", 1e-6 / (2.0 * PI * 1e-5), 1e-3),
        (
            "--control displacement",
            1e-6 / (5.0 / 6.0 * PI * 1e-5),
            1e-12,
        ),
    ] {
        let w = found(format!("pull-off {thick} --load -1uN {more}"));
        assert!(
            (w / expected - 1.0).abs() < tolerance,
            "{more}: {w}, not {expected}"
        );
    }
    let film = "--specimen paper --sphere-radius 10um --film-thickness 3um";
    for more in [
        "",
        "--interface sliding",
        "--friction stick",
        "--probe flat-punch",
    ] {
        let there = workdir.run(format!("pull-off {film} {more} --work-of-adhesion 0.05"));
        let load = value(&there.stdout, "load");
        let w = found(format!("pull-off {film} {more} --load {load}"));
        assert!((w / 0.05 - 1.0).abs() < 1e-12, "{more}: {w}");
    }
    let object = workdir.json(format!("pull-off {thick} --load -1uN --json"));
    let w = number(&object, "work_of_adhesion");
    assert_close(w, 1e-6 / (1.5 * PI * 1e-5), 1e-12);
    workdir.refuses(
        "1 | pull-off --load 2uN | below 0; give --load=-2e-6
         1 | pull-off --load 0 | --load 0.0; is a number below 0; leave out --load
         1 | pull-off --load=nan | --load NaN; is a number below 0
         2 | pull-off --load=-2,5uN | the decimal mark is a point
         1 | pull-off --specimen paper --sphere-radius 10um --film-modulus 10kPa --film-thickness 100nm --sphere-modulus inf --control spring --stiffness 10N/m --load=-1uN | --load -1e-6 N: no work of adhesion has the pull-off load; from -1.9; to -9.0; what the machine imposes
         1 | pull-off --load -2uN | what was measured on is missing: give --sphere-radius, --sphere-modulus, --film-thickness
         1 | pull-off --load -2uN --sphere-radius 10um | give --sphere-modulus, --film-thickness; --specimen paper
         1 | pull-off --specimen paper --sphere-radius 10um --load -2 | --load -2.0 N: the pull-off at work of adhesion = 42441; check its unit
         1 | pull-off --specimen paper --load -100mN | --allow magnitudes
         2 | pull-off --load -2mPa | a force is wanted
         2 | pull-off --load | --load
         2 | pull-off --load -2uN --work-of-adhesion 0.04 | cannot be used with",
    );
}
