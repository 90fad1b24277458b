//! The example `fit_jkr` finds the parameters from which direct solves made noisy data.

use std::f64::consts::PI;
use std::fs;
use std::io::{self, ErrorKind, Write};
use std::path::PathBuf;

use acceptance::{Contacts, assert_names, paper_system, table};
use fit::{Against, Data, Estimate, Fit, Parameter, State, fit, print};
use interp::{Contact, Elastic, System, Table};
use rayon::prelude::*;

#[path = "../../crates/interp/examples/fit_jkr/fit/mod.rs"]
mod fit;

/// Work of adhesion of the paper's Table 1, J/m^2.
const W: f64 = 0.04;

/// The parameters that are always fitted.
const ALWAYS: [Parameter; 2] = [Parameter::SphereModulus, Parameter::WorkOfAdhesion];

/// An imagined experiment.
#[derive(Clone, Copy)]
struct Experiment {
    truth: State,
    against: Against,
    /// Contact radii, first and last, m.
    radii: [f64; 2],
    points: usize,
    /// Standard deviation of a load, N.
    noise: f64,
}

impl Experiment {
    /// Measures the paper's system from pull-off to twice the radius at zero load.
    fn paper(film_thickness: f64, against: Against, noise: f64) -> Self {
        let truth = State {
            system: paper_system(film_thickness),
            work_of_adhesion: W,
            offset: 0.0,
        };
        Self {
            truth,
            against,
            radii: [42e-6, 131e-6],
            points: 40,
            noise,
        }
    }

    /// Returns pairs of radius or penetration, and load, without noise, by direct solves.
    fn exact(&self) -> Vec<(f64, f64)> {
        let State {
            system,
            work_of_adhesion,
            offset,
        } = self.truth;
        let [from, to] = self.radii;
        let range = [
            0.9 * from / system.film_thickness,
            1.1 * to / system.film_thickness,
        ];
        let curve = tabulate::solve::curve(&system.material().expect("physical"), range, 1e-9)
            .expect("within reach");
        let contact = Contact::new(&system, curve).expect("its own curve");
        let step = (to - from) / (self.points - 1) as f64;
        let point = |i: usize| {
            let a = from + step * i as f64;
            let (load, penetration) = contact
                .load_and_penetration(a, work_of_adhesion)
                .expect("inside");
            match self.against {
                Against::ContactRadius => (a, load + offset),
                Against::Penetration => (penetration + offset, load),
            }
        };
        (0..self.points).map(point).collect()
    }

    fn with_noise(&self, exact: &[(f64, f64)], seed: u64) -> Data {
        let mut random = Contacts::new(seed);
        // Box and Muller.
        let mut normal = || {
            (-2.0 * random.uniform(f64::MIN_POSITIVE, 1.0).ln()).sqrt()
                * (2.0 * PI * random.uniform(0.0, 1.0)).cos()
        };
        Data {
            against: self.against,
            points: exact
                .iter()
                .map(|&(x, load)| (x, load + self.noise * normal()))
                .collect(),
        }
    }

    fn data(&self, seed: u64) -> Data {
        self.with_noise(&self.exact(), seed)
    }

    /// Fits the two parameters that are always fitted, and `others`, which start from the truth
    /// times `start`.
    fn fit(&self, data: &Data, others: &[Parameter], start: f64, noise: Option<f64>) -> Fit {
        self.fit_in(Table::embedded(), data, others, start, noise)
    }

    /// Fits as [`Self::fit`], with another table than the embedded one.
    fn fit_in(
        &self,
        table: &Table,
        data: &Data,
        others: &[Parameter],
        start: f64,
        noise: Option<f64>,
    ) -> Fit {
        let free = [&ALWAYS, others].concat();
        let film = self.truth.system.film;
        let film = if others.contains(&Parameter::FilmModulus) {
            Elastic::new(start * film.young(), film.poisson())
        } else {
            Ok(film)
        };
        let thickness = if others.contains(&Parameter::FilmThickness) {
            start
        } else {
            1.0
        } * self.truth.system.film_thickness;
        let system = System {
            film: film.expect("physical"),
            film_thickness: thickness,
            sphere_modulus: f64::NAN,
            ..self.truth.system
        };
        fit(table, data, &system, &free, noise).expect("a sound experiment")
    }

    /// Returns the distance of an estimate from the truth in standard errors.
    fn deviation(&self, estimate: &Estimate) -> f64 {
        let truth = self.truth.get(estimate.parameter);
        match estimate.parameter {
            Parameter::Offset => (estimate.value - truth) / estimate.error,
            // Fitted by its logarithm.
            _ => (estimate.value / truth).ln() * estimate.value / estimate.error,
        }
    }

    /// Fits 200 data sets with the seeds from `200 seed` on. Asserts that the intervals of 68 % and
    /// 95 % contain the truth in 68 % and 95 % of them.
    fn assert_coverage(&self, name: &str, others: &[Parameter], noise: Option<f64>, seed: u64) {
        /// The ranges that contain 99.7 % of binomial distributions of 200 with 0.6827 and 0.95.
        const BETWEEN: [[usize; 2]; 2] = [[117, 156], [181, 198]];
        let exact = self.exact();
        let fits: Vec<Fit> = (200 * seed..200 * (seed + 1))
            .into_par_iter()
            .map(|seed| self.fit(&self.with_noise(&exact, seed), others, 1.5, noise))
            .collect();
        for (i, estimate) in fits[0].estimates.iter().enumerate() {
            let covered = [1.0, 1.96].map(|z| {
                fits.iter()
                    .filter(|fit| self.deviation(&fit.estimates[i]).abs() <= z)
                    .count()
            });
            let parameter = estimate.parameter.name();
            println!(
                "{name}: {parameter} to {:.1e}, covered {covered:?} of 200",
                estimate.error / estimate.value.abs()
            );
            for (covered, [least, most]) in covered.into_iter().zip(BETWEEN) {
                assert!(
                    (least..=most).contains(&covered),
                    "{name}, {parameter}: {covered} of 200, not {least} to {most}"
                );
            }
        }
        let warned = fits.iter().filter(|fit| !fit.warnings.is_empty()).count();
        assert_eq!(
            warned,
            0,
            "{name}: {:?}",
            fits.iter().flat_map(|fit| &fit.warnings).next()
        );
    }
}

#[test]
fn the_truth_is_within_the_intervals_of_fits_to_radii() {
    let thin = Experiment::paper(10e-6, Against::ContactRadius, 5e-6);
    thin.assert_coverage("10 um", &[], Some(thin.noise), 1);
    thin.assert_coverage("10 um, noise not known", &[], None, 2);
    let truth = State {
        offset: 2e-5,
        ..thin.truth
    };
    Experiment { truth, ..thin }.assert_coverage(
        "10 um, offset of the load",
        &[Parameter::Offset],
        Some(thin.noise),
        3,
    );
    let thick = Experiment::paper(100e-6, Against::ContactRadius, 5e-7);
    thick.assert_coverage(
        "100 um, film modulus",
        &[Parameter::FilmModulus],
        Some(thick.noise),
        4,
    );
    thick.assert_coverage(
        "100 um, thickness",
        &[Parameter::FilmThickness],
        Some(thick.noise),
        5,
    );
}

#[test]
fn the_truth_is_within_the_intervals_of_fits_to_penetrations() {
    let thin = Experiment::paper(10e-6, Against::Penetration, 5e-6);
    thin.assert_coverage("10 um", &[], Some(thin.noise), 6);
    let truth = State {
        offset: -3e-7,
        ..thin.truth
    };
    Experiment { truth, ..thin }.assert_coverage(
        "10 um, offset of the penetration",
        &[Parameter::Offset],
        Some(thin.noise),
        7,
    );
    let thick = Experiment::paper(100e-6, Against::Penetration, 5e-7);
    thick.assert_coverage(
        "100 um, film modulus",
        &[Parameter::FilmModulus],
        Some(thick.noise),
        8,
    );
}

#[test]
fn a_modulus_that_the_data_do_not_tell_is_warned_of() {
    for against in [Against::ContactRadius, Against::Penetration] {
        let experiment = Experiment::paper(1e-6, against, 5e-6);
        let found = experiment.fit(
            &experiment.data(1),
            &[Parameter::FilmModulus],
            1.5,
            Some(experiment.noise),
        );
        println!("{found}");
        assert_names(
            &found.warnings.join("; "),
            &["film-modulus is not identifiable"],
        );
        // If the film's modulus is known, no other parameter is warned of.
        let known = experiment.fit(&experiment.data(1), &[], 1.0, Some(experiment.noise));
        assert!(known.warnings.is_empty(), "{:?}", known.warnings);
    }
}

#[test]
fn a_model_that_does_not_describe_the_data_is_warned_of() {
    let experiment = Experiment::paper(100e-6, Against::ContactRadius, 5e-6);
    let data = experiment.data(1);
    let system = System {
        film_thickness: 10e-6,
        ..experiment.truth.system
    };
    let found = fit(
        Table::embedded(),
        &data,
        &system,
        &ALWAYS,
        Some(experiment.noise),
    )
    .expect("data of an adhesive contact");
    assert_names(&found.warnings.join("; "), &["reduced chi^2"]);
}

#[test]
fn points_beyond_pull_off_are_warned_of() {
    let experiment = Experiment::paper(10e-6, Against::Penetration, 5e-6);
    let mut data = experiment.data(1);
    data.points.push((-1e-5, 0.0));
    let found = experiment.fit(&data, &[], 1.0, Some(experiment.noise));
    assert_names(
        &found.warnings.join("; "),
        &["beyond the pull-off of the fitted contact: 1"],
    );
}

/// Makes a table of incompressible films that are 10 to 1000 times as soft as the sphere. The
/// embedded table has films of every modulus.
fn limited() -> Table {
    table(
        "title = 'Soft films'\ntolerance = 1e-6\nquantities = ['gamma']
        a_over_t = { from = 1e-3, to = 1e3 }\ne1_over_e2 = { from = 1e-3, to = 0.1 }
        nu1 = 0.5\ne0_over_e2 = { from = 1e4, to = 1e6 }\nnu0 = 0.25",
    )
}

#[test]
fn a_fit_that_would_leave_the_table_is_warned_of() {
    // The fit starts from a film so soft that the sphere is 500 times as stiff. The data are those
    // of 3000 times, and the table ends at 1000.
    let mut experiment = Experiment {
        radii: [90e-6, 200e-6],
        ..Experiment::paper(3e-6, Against::ContactRadius, 5e-6)
    };
    experiment.truth = experiment
        .truth
        .with(Parameter::FilmModulus, 2e6 / 3000.0)
        .expect("physical");
    let found = experiment.fit_in(
        &limited(),
        &experiment.data(1),
        &[Parameter::FilmModulus],
        6.0,
        Some(experiment.noise),
    );
    println!("{found}");
    assert_names(&found.warnings.join("; "), &["the table ends"]);
}

/// Figure 4 of the paper: the lens of Tardivat and Leger on films of 1 to 30 um, with the moduli,
/// the radius and the adhesion of the paper's tables.
#[test]
fn films_below_10_um_change_what_jkr_finds_by_less_than_3_percent() {
    for thickness in [1e-6, 3e-6, 10e-6, 30e-6] {
        let experiment = Experiment {
            radii: [40e-6, 131e-6],
            ..Experiment::paper(thickness, Against::ContactRadius, 1e-6)
        };
        let found = experiment.fit(&experiment.data(7), &[], 1.0, Some(experiment.noise));
        let (jkr, sphere) = (found.homogeneous, experiment.truth.system.sphere_modulus);
        // The paper reads the adhesion with the sphere's modulus.
        let (modulus, work) = (
            jkr.modulus / sphere,
            jkr.work_of_adhesion * jkr.modulus / sphere / W,
        );
        println!(
            "{thickness:e} m: without the film E/E2* = {modulus:.4}, w/w0 = {work:.4}; with it {:?}",
            found.estimates
        );
        let small = (modulus - 1.0).abs() < 0.03 && (work - 1.0).abs() < 0.03;
        assert_eq!(
            small,
            thickness <= 10e-6,
            "{thickness:e} m: E/E2* = {modulus:.4}, w/w0 = {work:.4}"
        );
        for estimate in &found.estimates {
            let deviation = experiment.deviation(estimate);
            assert!(
                deviation.abs() <= 3.0,
                "{thickness:e} m: {estimate:?} is {deviation:.1} standard errors from the truth"
            );
            // Ten times as sure of it as the film's effect is large.
            assert!(
                estimate.error <= 0.003 * estimate.value,
                "{thickness:e} m: {estimate:?}"
            );
        }
    }
}

/// Returns the path of the example's data, and the experiment that they imitate.
fn example() -> (PathBuf, Experiment) {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR"))
        .join("../crates/interp/examples/fit_jkr/synthetic-10um.csv");
    (path, Experiment::paper(10e-6, Against::ContactRadius, 5e-6))
}

#[test]
fn the_example_data_are_made_as_they_say() {
    let (path, experiment) = example();
    let made = experiment.data(10);
    let rows: String = made
        .points
        .iter()
        .map(|(a, load)| format!("{a:.6e},{load:.6e}\n"))
        .collect();
    let text = fs::read_to_string(&path).unwrap_or_default();
    let data = Data::parse(&text).unwrap_or_else(|e| panic!("{e}; it is to hold\n{rows}"));
    assert_eq!(data.points.len(), made.points.len());
    for ((a, load), (made_a, made_load)) in data.points.iter().zip(&made.points) {
        assert!(
            (a / made_a - 1.0).abs() <= 1e-6 && (load - made_load).abs() <= 1e-9,
            "{a:e},{load:e} is to be {made_a:e},{made_load:e}"
        );
    }
}

#[test]
fn the_readme_shows_what_the_example_prints() {
    let (path, experiment) = example();
    let data = Data::parse(&fs::read_to_string(path).expect("the example's data")).expect("sound");
    let readme = concat!(env!("CARGO_MANIFEST_DIR"), "/../crates/interp/README.md");
    let readme = fs::read_to_string(readme).expect("the README of interp");
    let printed = experiment
        .fit(
            &data,
            &[Parameter::FilmModulus],
            1.0,
            Some(experiment.noise),
        )
        .to_string();
    assert!(
        readme.contains(printed.trim_end()),
        "the README does not show\n{printed}"
    );
}

/// An output that fails after some lines, as a pipe does whose reader has ended.
struct Failing(ErrorKind, usize);

impl Write for Failing {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let Self(kind, lines) = self;
        if *lines == 0 {
            return Err((*kind).into());
        }
        *lines -= usize::from(bytes.contains(&b'\n'));
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[test]
fn a_reader_that_stops_early_is_no_error() {
    let (path, experiment) = example();
    let data = Data::parse(&fs::read_to_string(path).expect("the example's data")).expect("sound");
    let found = experiment.fit(&data, &[], 1.0, None);
    let mut whole = Vec::new();
    print(&mut whole, &found).expect("memory takes it all");
    assert_eq!(whole, found.to_string().into_bytes());
    for lines in 0..5 {
        assert_eq!(print(Failing(ErrorKind::BrokenPipe, lines), &found), Ok(()));
        let error = print(Failing(ErrorKind::StorageFull, lines), &found).expect_err("a full disk");
        assert_names(&error, &["cannot write the output", "no storage space"]);
    }
}

#[test]
fn data_that_are_not_understood_are_said_to_be() {
    for (text, words) in [
        ("", &["header"][..]),
        ("# nothing\n\n", &["header"]),
        (
            "a,F\n1,2\n",
            &["a,F", "contact_radius,load", "load,penetration"],
        ),
        ("load\n1\n", &["contact_radius,load"]),
        (
            "load,contact_radius,penetration\n1,2,3\n",
            &["contact_radius,load"],
        ),
        (
            "contact_radius,load\n1e-6\n",
            &["line 2", "1 fields, not 2"],
        ),
        (
            "contact_radius,load\n# comment\n1e-6,x\n",
            &["line 3", "load", "\"x\""],
        ),
        (
            "contact_radius,load\n0,1\n",
            &["line 2", "contact_radius", "not above 0"],
        ),
        (
            "load,penetration\nNaN,1\n",
            &["line 2", "load", "NaN", "finite"],
        ),
        (
            "load,penetration\n1,inf\n",
            &["line 2", "penetration", "inf", "finite"],
        ),
    ] {
        assert_names(&Data::parse(text).expect_err(text), words);
    }
    let either = [
        "contact_radius,load\n1e-6,2e-6\n",
        " load , contact_radius \r\n# comment\r\n\r\n2e-6 , 1e-6\r\n",
    ];
    let expected = Data {
        against: Against::ContactRadius,
        points: vec![(1e-6, 2e-6)],
    };
    assert!(
        either
            .iter()
            .all(|text| Data::parse(text).as_ref() == Ok(&expected))
    );
}

#[test]
fn parameters_are_known_by_name() {
    for parameter in Parameter::ALL {
        assert_eq!(Parameter::named(parameter.name()), Ok(parameter));
    }
    assert_names(
        &Parameter::named("nu1").expect_err("not fitted"),
        &["nu1", "film-modulus", "film-thickness", "offset"],
    );
}

#[test]
fn fits_that_cannot_be_made_say_why() {
    let experiment = Experiment::paper(10e-6, Against::ContactRadius, 5e-6);
    let (table, system, data) = (
        Table::embedded(),
        experiment.truth.system,
        experiment.data(1),
    );
    let first = |count: usize| Data {
        points: data.points[..count].to_vec(),
        ..data.clone()
    };
    let error = |data: &Data, system: &System, noise| {
        fit(table, data, system, &ALWAYS, noise)
            .map(|_| ())
            .expect_err("impossible")
    };
    assert_names(
        &error(&first(2), &system, None),
        &["2 points", "2 parameters"],
    );
    for noise in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert_names(
            &error(&data, &system, Some(noise)),
            &["noise", &format!("{noise:?}")],
        );
    }
    let falling = Data {
        points: data.points.iter().map(|&(a, load)| (a, -load)).collect(),
        ..data.clone()
    };
    assert_names(&error(&falling, &system, None), &["no positive modulus"]);
    assert_names(
        &error(
            &data,
            &System {
                film_thickness: -1.0,
                ..system
            },
            None,
        ),
        &["film_thickness", "-1"],
    );
    assert_names(
        &error(
            &data,
            &System {
                sphere_radius: f64::NAN,
                ..system
            },
            None,
        ),
        &["modulus"],
    );
    // A film 5000 times stiffer than the sphere is not in every table.
    let film = Elastic::new(1e10, 0.5).expect("physical");
    let outside = fit(&limited(), &data, &System { film, ..system }, &ALWAYS, None)
        .map(|_| ())
        .expect_err("outside the table");
    assert_names(&outside, &["where the fit starts", "e1_over_e2"]);
}
