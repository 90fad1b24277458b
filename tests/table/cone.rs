//! Tables that hold `delta1`: the contact of a cone and of other odd powers of the radius.

use acceptance::{Data, all_bits, assert_names, larger, low_rank, table, workdir};
use contact::{Contact, Control, Input};
use interp::{Elastic, Error, Material, Parameter, Probe, Quantity, System, Table};
use tabulate::table::{Scene, certify};

/// The table of one material.
fn of_one_material([e1, nu1, e0, nu0]: [f64; 4], quantities: &str) -> Table {
    table(&format!(
        "title = 'One film'\ntolerance = 1e-8\nquantities = {quantities}\n\
         a_over_t = {{ from = 1e-3, to = 200 }}\ne1_over_e2 = {e1:?}\nnu1 = {nu1:?}\n\
         e0_over_e2 = {e0:?}\nnu0 = {nu0:?}\n"
    ))
}

const GAMMA: &str = "['gamma', 'delta1']";
const ALL: &str = "['pi0', 'eeq', 'gamma', 'delta0', 'delta1']";

#[test]
fn cones_and_odd_powers_are_those_of_the_reference() {
    let data = Data::read("shapes");
    let mut tables: Vec<([f64; 4], [Table; 2])> = Vec::new();
    let (mut worst, mut count) = (0.0, 0);
    for case in data.cases() {
        let n = case.get("n") as u32;
        if !matches!(n, 1 | 3) {
            continue;
        }
        let material = ["e1_over_e2", "nu1", "e0_over_e2", "nu0"].map(|name| case.get(name));
        if !tables.iter().any(|(of, _)| *of == material) {
            let both = [GAMMA, ALL].map(|quantities| of_one_material(material, quantities));
            tables.push((material, both));
        }
        let of = tables.iter().find(|(of, _)| *of == material);
        let (_, tables) = of.expect("it has just been made");
        let [e1, nu1, e0, nu0] = material;
        let material = Material::new(e1, nu1, e0, nu0).expect("physical");
        for table in tables {
            let curve = table.curve(&material).expect("in the table");
            let odd = curve.odd_power(n).expect("delta1 is held");
            let x = case.get("a_over_t");
            let misses = [
                odd.pi(x).expect("in range") / case.get("pi_n") - 1.0,
                odd.delta(x).expect("in range") / case.get("delta_n") - 1.0,
            ];
            let allowed = table.description().certificate.max_error;
            for miss in misses {
                worst = larger(worst, miss.abs());
                assert!(miss.abs() <= allowed, "r^{n} at {x} with {e1}: {misses:?}");
            }
            count += 1;
        }
    }
    println!("{count} comparisons: at most {worst:.1e}");
    assert_eq!(count, 2 * 36);
}

/// Systems in the box of [`BOX`]: probe, film modulus and Poisson ratio, substrate modulus.
fn systems() -> Vec<System> {
    let films = [(3.5e6, 0.47), (9e5, 0.49), (2.5e7, 0.41)];
    let probes = [
        Probe::Cone { half_angle: 1.2 },
        Probe::PowerLaw {
            coefficient: 1e9,
            exponent: 3.0,
        },
        Probe::PowerLaw {
            coefficient: 1e20,
            exponent: 5.0,
        },
    ];
    let system = |(probe, film): (&Probe, (f64, f64))| System {
        probe: probe.clone(),
        sphere_modulus: 2e6,
        film: Elastic::new(film.0, film.1).expect("physical"),
        film_thickness: 1e-5,
        substrate: Elastic::new(2e8, 0.25).expect("physical"),
    };
    let pairs = probes
        .iter()
        .flat_map(|probe| films.map(|film| (probe, film)));
    pairs.map(system).collect()
}

/// Two axes of the material beside `a/t`.
const BOX: &str = "
    title      = 'Cones'
    tolerance  = 1e-6
    quantities = ['gamma', 'delta1']
    a_over_t   = { from = 1e-3, to = 100 }
    e1_over_e2 = { from = 0.3, to = 30 }
    nu1        = { from = 0.4, to = 0.5 }
    e0_over_e2 = 100
";

fn without_delta1(scene: &str) -> String {
    scene.replace(", 'delta1'", "")
}

/// The contact by `delta1` is that by the field of the flat punch, which needs `Gamma` alone.
#[test]
fn contacts_are_those_of_a_table_without_delta1() {
    let with = table(BOX);
    let [with, without, compressed] = [
        with.clone(),
        table(&without_delta1(BOX)),
        low_rank(&with, 2e-7),
    ];
    assert!(with.description().certificate.max_error <= 1e-6);
    let mut worst = 0.0;
    for system in systems() {
        let by_field = Contact::in_table(&without, &system).expect("in the table");
        for table in [&with, &compressed] {
            let contact = Contact::in_table(table, &system).expect("in the table");
            for i in 0..60 {
                // From below the table to close to its end.
                let a = 1e-8 * 1.17_f64.powi(i);
                let [ours, theirs] = [&contact, &by_field]
                    .map(|contact| contact.load_and_penetration(a, 0.0).expect("in range"));
                for (ours, theirs) in [(ours.0, theirs.0), (ours.1, theirs.1)] {
                    worst = larger(worst, (ours / theirs - 1.0).abs());
                }
                let adhesive = [&contact, &by_field]
                    .map(|contact| contact.load_and_penetration(a, 0.04).expect("in range"));
                let size = (adhesive[1].0 - theirs.0).abs() + theirs.0;
                assert!((adhesive[0].0 - adhesive[1].0).abs() < 1e-5 * size);
            }
            let pull_off = [&contact, &by_field].map(|contact| {
                contact
                    .pull_off(0.04, Control::Load)
                    .expect("in range")
                    .load
            });
            assert!(
                (pull_off[0] / pull_off[1] - 1.0).abs() < 1e-5,
                "{pull_off:?}"
            );
        }
    }
    println!("difference of both ways: {worst:.1e}");
    assert!(worst < 4e-6);
}

/// Derivatives with respect to every input, against differences of contacts.
#[test]
fn gradients_are_differences() {
    let table = table(BOX);
    let at = |system: &System, a: f64| {
        let contact = Contact::in_table(&table, system).expect("in the table");
        contact.load_and_penetration(a, 0.04).expect("in range")
    };
    let mut worst = 0.0;
    for system in systems() {
        for x in [2e-3, 0.05, 1.0, 20.0] {
            let a = x * system.film_thickness;
            let contact = Contact::in_table_with_gradient(&table, &system).expect("in the table");
            let gradient = contact.gradient(a, 0.04).expect("in range");
            let film = |young: f64, poisson: f64| System {
                film: Elastic::new(young, poisson).expect("physical"),
                ..system.clone()
            };
            let (young, poisson) = (system.film.young(), system.film.poisson());
            type Changed<'a> = Box<dyn Fn(f64) -> (System, f64) + 'a>;
            let inputs: [(Input, f64, Changed<'_>); 4] = [
                (
                    Input::ContactRadius,
                    a,
                    Box::new(|s| (system.clone(), a * s)),
                ),
                (
                    Input::FilmThickness,
                    system.film_thickness,
                    Box::new(|s| {
                        let film_thickness = s * system.film_thickness;
                        (
                            System {
                                film_thickness,
                                ..system.clone()
                            },
                            a,
                        )
                    }),
                ),
                (
                    Input::FilmModulus,
                    young,
                    Box::new(|s| (film(s * young, poisson), a)),
                ),
                (
                    Input::FilmPoisson,
                    poisson,
                    Box::new(|s| (film(young, s * poisson), a)),
                ),
            ];
            for (input, value, changed) in &inputs {
                const STEP: f64 = 1e-4;
                let [more, less] = [1.0 + STEP, 1.0 - STEP].map(|s| {
                    let (system, a) = changed(s);
                    at(&system, a)
                });
                let found = gradient.by(*input).expect("known");
                let own = at(&system, a);
                let terms = [
                    (found.load, more.0 - less.0, own.0),
                    (found.penetration, more.1 - less.1, own.1),
                ];
                for (found, difference, own) in terms {
                    let expected = difference / (2.0 * STEP);
                    let size = own.abs() + expected.abs();
                    let miss = (value * found - expected).abs() / size;
                    worst = larger(worst, miss);
                    assert!(
                        miss < 2e-5,
                        "{input:?} at {x}: {found:e} {expected:e} {:?}",
                        system.probe
                    );
                }
            }
        }
    }
    println!("{worst:.1e}");
}

/// Sneddon's cone, and a film of the substrate's material.
#[test]
fn limits_are_exact() {
    let table = of_one_material([0.7, 0.3, 0.7, 0.3], GAMMA);
    let material = Material::new(0.7, 0.3, 0.7, 0.3).expect("physical");
    let es = material.sphere_film_modulus();
    let curve = table.curve(&material).expect("in the table");
    for n in [1, 3, 5] {
        let odd = curve.odd_power(n).expect("delta1 is held");
        let exact = 4.0 * es * f64::from(n) / f64::from(n + 1);
        for x in [1e-5, 1e-3, 0.1, 7.0, 200.0] {
            assert!((odd.delta(x).expect("in range") - 1.0).abs() < 1e-8);
            assert!((odd.pi(x).expect("in range") / exact - 1.0).abs() < 1e-8);
        }
    }
    // `Delta_n = 1 + c n/(n + 1)` with `c = es/Eeq - 1`, and the limit of `Pi_n`, to third order.
    let table = of_one_material([1.75, 0.5, 1e5, 0.25], GAMMA);
    let material = Material::new(1.75, 0.5, 1e5, 0.25).expect("physical");
    let es = material.sphere_film_modulus();
    let curve = table.curve(&material).expect("in the table");
    for n in [1, 3, 5] {
        let odd = curve.odd_power(n).expect("delta1 is held");
        let order = f64::from(n);
        for x in [1e-6, 1e-4, 9e-4, 1e-3, 1.1e-3, 3e-3] {
            let c = es / curve.quantity(Quantity::Eeq, x).expect("in range") - 1.0;
            let delta = 1.0 + c * order / (order + 1.0);
            let pi = 4.0 * es * order / (order + 1.0);
            assert!((odd.delta(x).expect("in range") - delta).abs() < 2e-8 + x.powi(3));
            assert!((odd.pi(x).expect("in range") / pi - 1.0).abs() < 2e-8 + x.powi(3));
        }
        assert!(matches!(odd.pi(201.0), Err(Error::OutsideTable { .. })));
    }
    // `Pi_1 = 2 einf (1 - 2 L_0/x)` with `Eeq = einf (1 - L_0/x)`, up to the second order in
    // `ln(x)/x`, which falls by 8.7 from 50 to 200.
    for of in [[1.0, 0.3, 10.0, 0.3], [0.3, 0.4, 5.0, 0.2]] {
        let [e1, nu1, e0, nu0] = of;
        let material = Material::new(e1, nu1, e0, nu0).expect("physical");
        let curve = of_one_material(of, GAMMA).curve(&material);
        let curve = curve.expect("in the table");
        let cone = curve.odd_power(1).expect("delta1 is held");
        let einf = material.sphere_substrate_modulus();
        let [far, farther] = [50.0, 200.0].map(|x| {
            let eeq = curve.quantity(Quantity::Eeq, x).expect("in range");
            let pi = 2.0 * einf * (1.0 - 2.0 * (1.0 - eeq / einf));
            (cone.pi(x).expect("in range") / pi - 1.0).abs()
        });
        println!("departures from the limit of thin films: {far:.1e}, {farther:.1e}");
        assert!(far < 1e-2 && farther < far / 6.0);
    }
}

#[test]
fn what_is_missing_is_named() {
    let with = of_one_material([1.75, 0.5, 1e5, 0.25], GAMMA);
    let material = Material::new(1.75, 0.5, 1e5, 0.25).expect("physical");
    let curve = with.curve(&material).expect("in the table");
    for n in [0, 2, 4, 6, 7, u32::MAX] {
        let refused = curve.odd_power(n).expect_err("no odd power up to 5");
        assert_names(&refused.to_string(), &["exponent", "1, 3 or 5"]);
    }
    let without = of_one_material([1.75, 0.5, 1e5, 0.25], "['gamma']");
    let curve = without.curve(&material).expect("in the table");
    for refused in [
        curve.odd_power(1).map(|_| ()),
        curve.quantity(Quantity::Delta1, 1.0).map(|_| ()),
        curve.slope(Quantity::Delta1, 1.0).map(|_| ()),
        curve.quantity_at_all(Quantity::Delta1, &[1.0], &mut [0.0]),
    ] {
        assert!(matches!(refused, Err(Error::MissingQuantity("delta1"))));
    }
}

#[test]
fn scenes_name_what_delta1_needs() {
    let scene = |quantities: &str| {
        let text = BOX.replace("['gamma', 'delta1']", quantities);
        Scene::parse(&text, None)
    };
    for sound in [GAMMA, ALL, "['delta1', 'gamma']"] {
        assert!(scene(sound).is_ok(), "{sound}");
    }
    for wrong in [
        "['delta1']",
        "['pi0', 'delta1']",
        "['eeq', 'gamma', 'delta1']",
        "['pi0', 'eeq', 'gamma', 'delta1']",
    ] {
        let refused = scene(wrong).expect_err(wrong);
        assert_names(&refused, &["delta1 goes with gamma alone"]);
    }
    let twice = scene("['gamma', 'delta1', 'delta1']").expect_err("twice");
    assert_names(&twice, &["each once"]);
    let stack = "title = 'x'\nquantities = ['gamma', 'delta1']\na_over_t = { from = 0.1, to = 1 }\n\
                 e1_over_e2 = 1\n[stack]\nbase = { young_modulus = inf }\n[[stack.layers]]\n\
                 young_modulus = 1e6\npoisson_ratio = 0.3\nthickness = 1e-6\n";
    let refused = Scene::parse(stack, None).expect_err("a stack");
    assert_names(
        &refused,
        &["delta1 does not go with [stack]", "--exponent 1"],
    );
}

/// The certificate counts errors of `delta1`, and of the load that follows from it.
#[test]
fn the_certificate_finds_wrong_values_of_a_cone() {
    let sound = of_one_material([1.75, 0.5, 1e5, 0.25], GAMMA);
    let values = |change: f64| {
        Quantity::TABULATED.map(|quantity| {
            let mut values = sound.values(quantity)?.to_vec();
            if quantity == Quantity::Delta1 {
                values.iter_mut().for_each(|value| *value *= 1.0 + change);
            }
            Some(values)
        })
    };
    for change in [1e-4, -1e-4] {
        let (description, axes) = (sound.description().clone(), sound.axes());
        let wrong = Table::new(description, axes, values(change)).expect("whole");
        let found = certify(&wrong, 100, 1, &|_| {}).expect("within reach");
        assert_eq!(found.worst_quantity, Quantity::Delta1);
        // The load is `4 (Delta_1 Eeq - mu_1)`. Both terms have the error but where the integral of
        // the second one begins, and there the first one is twice their difference.
        let error = found.max_error / change.abs();
        assert!((1.0 - 1e-3..2.01).contains(&error), "{error}");
    }
    assert!(sound.description().certificate.max_error <= 1e-8);
}

#[test]
fn files_keep_delta1() {
    let workdir = workdir!();
    for quantities in [GAMMA, ALL] {
        let dense = of_one_material([1.75, 0.5, 1e5, 0.25], quantities);
        for table in [dense.clone(), low_rank(&dense, 1e-9)] {
            let packed = table.to_packed().expect("packed");
            let read = Table::from_packed(&packed).expect("sound");
            assert_eq!(read.quantities(), table.quantities());
            assert_eq!(read.to_packed().expect("packed"), packed);
            workdir.write("table.bin", packed);
            workdir.succeed(&["unpack", "table.bin", "-o", "table.h5"]);
            workdir.succeed(&["pack", "table.h5", "-o", "again.bin"]);
            let again = Table::from_packed(&workdir.read("again.bin")).expect("sound");
            let expanded = table.expand().expect("sound");
            assert_eq!(all_bits(&again), all_bits(&expanded));
            assert_eq!(again.quantities(), table.quantities());
            let text = workdir.succeed(&["info", "table.h5"]);
            assert_names(&text, &["gamma", "delta1"]);
        }
    }
    // The column of `delta1`, as of a solve.
    workdir.write(
        "points.csv",
        "a_over_t,e1_over_e2,nu1,e0_over_e2\n2,1.75,0.5,1e5\n",
    );
    let queried = workdir.succeed(&["query", "table.h5", "--points", "points.csv"]);
    let solved = workdir.succeed(&["solve", "--points", "points.csv", "--exponent", "1"]);
    let [queried, solved] = [queried, solved].map(|text| Data::parse("points", &text));
    let [ours, theirs] = [(&queried, "delta1"), (&solved, "delta_1")]
        .map(|(data, column)| data.cases().next().expect("a row").get(column));
    assert!((ours / theirs - 1.0).abs() < 1e-8);
    let curve = ["curve", "table.h5", "--probe", "cone", "--half-angle", "70"];
    let settings = [
        "--film-thickness",
        "1e-5",
        "--from",
        "1e-6",
        "--to",
        "1e-4",
        "--points",
        "5",
    ];
    let printed = Data::parse("curve", &workdir.succeed(&[&curve[..], &settings].concat()));
    assert_eq!(printed.cases().count(), 5);
    workdir.succeed(&["check", "table.h5", "--points", "50"]);
}

/// Damaged tables are refused, or answered without a panic.
#[test]
fn forged_values_of_delta1_are_refused() {
    let sound = of_one_material([1.75, 0.5, 1e5, 0.25], GAMMA);
    let table = |delta1: Option<Vec<f64>>, gamma: bool| {
        let own = sound.values(Quantity::Gamma).map(<[f64]>::to_vec);
        let values = [None, None, own.filter(|_| gamma), None, delta1];
        Table::new(sound.description().clone(), sound.axes(), values)
    };
    let nodes = sound.axis(Parameter::AOverT).len();
    assert!(table(Some(vec![1.0; nodes]), true).is_ok());
    let wrong = [
        (table(Some(vec![1.0; nodes - 1]), true), "delta1 has"),
        (table(Some(vec![f64::NAN; nodes]), true), "delta1 holds NaN"),
        (
            table(Some(vec![1.0; nodes]), false),
            "no quantity of a sphere",
        ),
    ];
    for (refused, words) in wrong {
        assert_names(&refused.expect_err(words).to_string(), &[words]);
    }
    // Beyond all reason between the nodes.
    let mut values = vec![1.0; nodes];
    values.iter_mut().step_by(2).for_each(|value| *value = 1e30);
    let forged = table(Some(values), true).expect("in the range at the nodes");
    let material = Material::new(1.75, 0.5, 1e5, 0.25).expect("physical");
    let refused = forged.curve(&material).expect_err("unreasonable");
    assert_names(&refused.to_string(), &["delta1 reaches"]);
}
