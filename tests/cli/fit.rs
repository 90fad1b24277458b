//! `tabulate fit`

use acceptance::{
    Data, Workdir, assert_estimate, assert_names, assert_near, json, kinds, number, workdir,
};
use serde_json::Value;

/// A measurement to be simulated and fitted: the arguments of both commands, those of one, those of
/// the other, and the truth.
struct Case {
    system: &'static str,
    simulate: &'static str,
    fit: &'static str,
    truth: &'static [(&'static str, f64)],
}

const LENS: Case = Case {
    system: "--specimen paper --film-thickness 1e-5",
    simulate: "--kind load-radius --from 4.2e-5 --to 1.3e-4 --noise 2e-6 --value load-offset=2e-5",
    fit: "--free sphere-modulus,work-of-adhesion,load-offset --noise 2e-6",
    truth: &[
        ("sphere_modulus", 2e6),
        ("work_of_adhesion", 0.04),
        ("load_offset", 2e-5),
    ],
};

const GEL: Case = Case {
    system: "--sphere-radius 1e-5 --sphere-modulus inf --film-thickness 2e-5 --film-modulus 5e3 \
         --film-poisson-ratio 0.5 --substrate-modulus 7e10 --substrate-poisson-ratio 0.25 \
         --stiffness 0.1",
    simulate: "--kind force-height --work-of-adhesion 1e-4 --from 2e-6 --to -1e-6 --points 300 \
         --noise 5e-11 --value contact-point=2e-7 --value baseline=1e-9",
    fit: "",
    truth: &[
        ("film_modulus", 5e3),
        ("work_of_adhesion", 1e-4),
        ("contact_point", 2e-7),
        ("baseline", 1e-9),
    ],
};

fn simulate(workdir: &Workdir, case: &Case, file: &str, seed: u32) {
    let more = format!("--seed {seed} -o {file}");
    workdir.simulate(format!("{} {} {more}", case.simulate, case.system));
}

fn fit(workdir: &Workdir, case: &Case, more: &str) -> Value {
    workdir.json(format!("fit --json {} {} {more}", case.system, case.fit))
}

/// `tests/fit` has the other kinds.
#[test]
fn what_is_simulated_is_found() {
    let workdir = workdir!();
    for case in [&LENS, &GEL] {
        simulate(&workdir, case, "data.csv", 7);
        let found = fit(&workdir, case, "data.csv");
        assert_eq!(found["converged"], true);
        for (name, truth) in case.truth {
            assert_estimate(&found, name, *truth, f64::INFINITY);
        }
    }
}

#[test]
fn the_object_has_the_keys_of_its_help() {
    let workdir = workdir!();
    simulate(&workdir, &LENS, "lens.csv", 1);
    let object = fit(&workdir, &LENS, "lens.csv");
    let keys = |object: &Value| {
        let keys = object.as_object().expect("an object").keys();
        keys.cloned().collect::<Vec<_>>().join(" ")
    };
    assert_eq!(
        keys(&object),
        "created_by command read converged parameters correlation reduced_chi_squared noise abscissa_noise a_over_t left_out \
         without_film fixed_values warnings"
    );
    // The command makes the object again.
    let command = object["command"].as_str().expect("text");
    let command = command.replacen("tabulate", "exec $0", 1);
    assert_eq!(json(&workdir.script(&command).stdout), object);
    let parameters = &object["parameters"];
    assert_eq!(
        keys(parameters),
        "sphere_modulus work_of_adhesion load_offset"
    );
    assert_eq!(keys(&parameters["load_offset"]), "value stderr unit");
    assert_eq!(parameters["work_of_adhesion"]["unit"], "J/m^2");
    assert_eq!(object["noise"], 2e-6);
    let correlation = object["correlation"].as_array().expect("a matrix");
    assert_eq!(correlation.len(), 3);
    assert_near(number(&object, "correlation/2/2"), 1.0, 1e-9);
    let chi = number(&object, "reduced_chi_squared");
    assert!((0.4..1.9).contains(&chi), "{chi}");
    let modulus = &object["without_film"]["modulus"];
    assert_eq!(modulus["parameter"], "sphere_modulus");
    // The order of the parameters, which is that of the correlation, is that of --free.
    let text = workdir.succeed(format!("fit lens.csv --json {} {}", LENS.system, LENS.fit));
    let names = LENS.truth.iter().map(|(name, _)| *name);
    let place = |name| text.find(&format!("\"{name}\":{{\"value\""));
    let places = names.map(|name| place(name).expect("a parameter"));
    assert!(places.is_sorted(), "{text}");
}

/// Three decimals of a small contact radius over a thickness would be one digit or none.
#[test]
fn contacts_far_smaller_than_the_film_are_told_as_small() {
    let workdir = workdir!();
    let bodies = "--film-poisson-ratio 0.5 --film-thickness 1mm --substrate-modulus inf --sphere-radius 10um --sphere-modulus inf \
                  --work-of-adhesion 0";
    let plan = "--kind load-radius --film-modulus 1MPa --from 500nm --to 2um --noise 1nN";
    workdir.answer(format!("simulate {plan} {bodies} -o thick.csv"));
    let report = workdir.succeed(format!("fit thick.csv {bodies} --free film-modulus"));
    let words = "thick.csv: contact radii from 500 nm to 2.00 um, over the thickness from 5.00e-4 to 2.00e-3\n";
    assert!(report.contains(words), "{report}");
}

#[test]
fn an_offset_that_is_not_fitted_and_a_film_that_matters_are_told() {
    let workdir = workdir!();
    simulate(&workdir, &LENS, "lens.csv", 1);
    let arguments = format!("fit lens.csv --noise 2e-6 {}", LENS.system);
    let words = "warning: ; load-offset; lens.csv: 40 points, load-radius";
    assert_names(&workdir.succeed(arguments), words);
    let with_offset = format!("fit lens.csv {} {}", LENS.system, LENS.fit);
    let report = workdir.succeed(&with_offset);
    let words = "contact_radius from \"contact_radius\" in SI units; sphere-radius             1 mm; \
        film-thickness            10 um; MPa; mJ/m^2; correlation; \
        the film matters: sphere-modulus is off by ; standard errors) without it; reduced chi^2";
    assert_names(&report, words);
    // The only doubt is that a film is taken as bonded.
    let mut warnings = report.lines().filter(|line| line.starts_with("warning: "));
    let is_of_bond = |line: &str| line.contains("takes the film as bonded");
    assert!(warnings.all(is_of_bond), "{report}");
    let units = "--units sphere-modulus=kPa,work-of-adhesion=J/m^2";
    let report = workdir.succeed(format!("{with_offset} {units}"));
    assert_names(&report, " kPa;  J/m^2");
}

#[test]
fn csv_and_pictures_are_written() {
    let workdir = workdir!();
    simulate(&workdir, &GEL, "gel.csv", 1);
    for (picture, start) in [("gel.svg", &b"<svg"[..]), ("gel.png", b"\x89PNG")] {
        let files = format!("gel.csv --csv points.csv --plot {picture}");
        fit(&workdir, &GEL, &files);
        assert!(workdir.read(picture).starts_with(start), "{picture}");
    }
    let text = workdir.text("points.csv");
    let data = Data::parse("points", &text);
    let expected = "file,line,segment,height,load,fit,residual,branch,outlier,without_film";
    assert_eq!(data.columns().join(","), expected);
    assert_eq!(data.cases().count(), 600);
    let count = |column, word| data.cases().filter(|row| row.text(column) == word).count();
    for segment in ["approach", "retract"] {
        assert_eq!(count("segment", segment), 300);
    }
    for branch in ["advancing", "baseline"] {
        assert!(count("branch", branch) > 50, "{branch}");
    }
    for row in data.cases() {
        assert_eq!(row.text("file"), "gel.csv");
        if !row.text("fit").is_empty() {
            assert_eq!(row.get("residual"), row.get("load") - row.get("fit"));
        }
    }
    workdir.refuses("1 | fit gel.csv --csv gel.csv | gel.csv; it is the input");
}

#[test]
fn films_of_two_thicknesses_are_fitted_at_once() {
    let workdir = workdir!();
    for (thickness, file, seed) in [("1e-5", "thick.csv", "1"), ("2e-6", "thin.csv", "2")] {
        workdir.succeed(format!(
            "simulate --kind load-radius --from 4.2e-5 --to 1.3e-4 --noise 5e-6 \
             --film-thickness {thickness} --seed {seed} -o {file}"
        ));
    }
    let both = Case {
        system: "--specimen paper --value film-thickness=10um,2um",
        fit: "--free sphere-modulus,film-modulus,work-of-adhesion,load-offset --noise 5e-6",
        ..LENS
    };
    let found = fit(&workdir, &both, "thick.csv thin.csv");
    let of_lists = [&found["parameters"]["load_offset"], &found["correlation"]];
    let lengths = of_lists.map(|list| list.as_array().map(Vec::len));
    assert_eq!(lengths, [Some(2), Some(5)]);
    assert_eq!(found["noise"], serde_json::json!([5e-6, 5e-6]));
    for (name, truth) in [("sphere_modulus", 2e6), ("film_modulus", 3.5e6)] {
        assert_estimate(&found, name, truth, f64::INFINITY);
    }
    let more = format!("--plot both.svg {} {}", both.system, both.fit);
    let report = workdir.succeed(format!("fit thick.csv thin.csv {more}"));
    assert_names(&report, "load-offset (thick.csv); load-offset (thin.csv)");
}

#[test]
fn bounds_and_priors_hold() {
    let workdir = workdir!();
    simulate(&workdir, &LENS, "lens.csv", 1);
    let bounds = "lens.csv --bounds sphere-modulus=2.5e6..4e6";
    let found = fit(&workdir, &LENS, bounds);
    let value = number(&found, "parameters/sphere_modulus/value");
    assert!((2.5e6..2.6e6).contains(&value), "{value}");
    assert!(kinds(&found).contains(&"at-bound"), "{found}");
    let prior = "lens.csv --prior load-offset=0+-1e-12";
    let found = fit(&workdir, &LENS, prior);
    assert_near(number(&found, "parameters/load_offset/value"), 0.0, 1e-10);
    // The report states them.
    let flags = "--bounds sphere-modulus=0.5MPa..4MPa --prior work-of-adhesion=45mJ/m^2+-10mJ/m^2 --robust huber";
    let report = workdir.succeed(format!("fit lens.csv {} {} {flags}", LENS.system, LENS.fit));
    let words = "E2*, bounds 0.5 to 4 MPa\n; mJ/m^2, prior 45 +- 10 mJ/m^2\n; robust: Huber's loss, threshold 1.345\n";
    assert_names(&report, words);
}

#[test]
fn a_fit_that_cannot_be_made_is_an_error_that_names_the_reason() {
    let workdir = workdir!();
    simulate(&workdir, &LENS, "lens.csv", 1);
    workdir.write("empty.csv", "");
    workdir.write_files(
        r"
        gel.csv | z [nm],defl [nm]\n3,0\n2,0\n1,1\n0,2\n-1,3\n-2,4\n
        bad.csv | contact_radius,load\n1e-5,1e-6\n2e-5,x\n
        z.csv | height,force\n2e-6,0\n1e-6,0\n0,1e-9\n
        ",
    );
    let fit = "fit --specimen paper";
    workdir.refuses(format!(
        r#"
        2 | {fit} | DATA
        1 | {fit} missing.csv | missing.csv
        1 | {fit} bad.csv | bad.csv, line 3, column 2 "load"; "x"
        1 | {fit} empty.csv | empty.csv; the file is empty
        1 | {fit} gel.csv | gel.csv, column 2 "defl [nm]"; --stiffness
        1 | {fit} gel.csv --stiffness 1 --free stiffness | stiffness; fix it
        1 | {fit} z.csv | z.csv; --stiffness
        2 | {fit} lens.csv --free E1 | E1; film-modulus
        1 | {fit} lens.csv --bounds film-modulus=1e5..2e5 | film-modulus; not free
        1 | {fit} lens.csv --noise 1,2 | --noise; 2 values for 1 files
        1 | {fit} lens.csv --noise -1 | noise; -1
        1 | {fit} lens.csv --film-poisson-ratio 0.6 | film; 0.6
        "#
    ));
}

/// A work of adhesion that is taken for far smaller than it is leaves points beyond the end of the branch.
#[test]
fn a_fit_of_a_third_of_the_points_is_an_error_unless_allowed() {
    let workdir = workdir!();
    let bodies = "--specimen paper --film-thickness 10um --film-modulus 500kPa --stiffness 200";
    workdir.simulate(format!(
        "--kind force-height --from 8um --to=-0.5um --points 100 --segments retract --noise 0.1uN \
         --value contact-point=4um {bodies} -o data.csv"
    ));
    let fit = format!("fit data.csv {bodies} --work-of-adhesion 1e-3 --free contact-point");
    workdir.refuses(format!(
        "
        1 | {fit} | data.csv; more than a third; beyond the end of the fitted branch; --allow left-out
        2 | {fit} --allow leftout | leftout; left-out
        "
    ));
    let allowed = format!("{fit} --allow left-out");
    let words = "data.csv: left out ; warning: data.csv: ; points in contact do not count";
    assert_names(&workdir.succeed(&allowed), words);
    let object = workdir.json(format!("{allowed} --json"));
    let groups = object["left_out"].as_array().expect("a list");
    let of = |reason: &str| {
        let group = groups.iter().find(|group| group["reason"] == reason);
        group.map_or(0, |group| group["points"].as_u64().expect("a number"))
    };
    assert!(of("beyond-end") > 20, "{object}");
}

/// Where each file has a thickness of its own, radii are told beside it, and so are doubts.
#[test]
fn the_contact_radii_of_each_film_are_beside_its_own_thickness() {
    let workdir = workdir!();
    for (name, thickness) in [("thin", "10um"), ("thick", "40um")] {
        let data = workdir.simulate(format!(
            "--kind load-radius --specimen paper --film-thickness {thickness} --from 20um --to 100um --points 30 --noise 1uN"
        ));
        workdir.write(&format!("{name}.csv"), data);
    }
    let report = workdir.succeed(
        "fit thin.csv thick.csv --specimen paper --value film-thickness=10um,40um --noise 1uN \
         --free film-thickness,work-of-adhesion --own film-thickness",
    );
    for (name, truth) in [("thin", 10.0), ("thick", 2.5)] {
        let radii =
            format!("{name}.csv: contact radii from 20.0 um to 100 um, over the thickness from ");
        let (_, ends) = report.split_once(&radii).expect("a line");
        let (_, most) = ends.split_once(" to ").expect("two ends");
        let most: f64 = most
            .lines()
            .next()
            .expect("a line")
            .parse()
            .expect("a number");
        assert!((most / truth - 1.0).abs() < 0.05, "{report}");
        assert_names(
            &report,
            &format!("warning: film-thickness of {name}.csv changes by"),
        );
    }
}
