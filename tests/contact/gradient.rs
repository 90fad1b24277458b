//! Derivatives of the quantities, of load and penetration, against differences of direct solves and
//! of the interpolant.

use acceptance::{Contacts, larger, material, paper_system, shipped};
use interp::Parameter;
use interp::{
    Contact, Elastic, Error, HalfSpace, Input, Mechanics, Quantities, Quantity, System, Table,
};
use tabulate::solve;

/// The largest error of a derivative of the logarithm of a quantity, in tolerances of the table, in
/// the order `a/t`, `E1`, `nu1`, `E0`, `nu0`. The derivatives are with respect to the logarithm of
/// `a/t` or of a modulus, or to a Poisson ratio. The unit of `nu1` is the range on which the
/// quantities change, `(1 - 2 nu1) + 1/(1 + (a/t)^2)`; that of `nu0` is the range on which it has
/// an equivalent, `1/(1 + E1/E0)`.
const SHARES: [f64; 5] = [20.0, 20.0, 100.0, 20.0, 100.0];

/// Returns the derivatives of `N` functions at 0, from four values or, on one side only, seven.
fn derivatives<const N: usize>(
    step: f64,
    one_sided: bool,
    f: impl Fn(f64) -> [f64; N],
) -> [f64; N] {
    if !one_sided {
        let [near, far] = [1.0, 2.0].map(|steps| [f(steps * step), f(-steps * step)]);
        return std::array::from_fn(|i| {
            (8.0 * (near[0][i] - near[1][i]) - (far[0][i] - far[1][i])) / (12.0 * step)
        });
    }
    let weights = [-2.45, 6.0, -7.5, 20.0 / 3.0, -3.75, 1.2, -1.0 / 6.0];
    let values: [[f64; N]; 7] = std::array::from_fn(|k| f(-step * k as f64));
    std::array::from_fn(|i| {
        let terms = weights.iter().zip(&values);
        terms.map(|(weight, value)| weight * value[i]).sum::<f64>() / -step
    })
}

fn direct(x: f64, parameters: [f64; 4]) -> Quantities {
    solve(x, &material(parameters), 1e-13)
        .or_else(|_| solve(x, &material(parameters), 1e-11))
        .expect("solved")
        .quantities
}

/// Draws points of a box of moduli, with ordinary, nearly incompressible and incompressible films,
/// away from the ends of the box, and some points of thicker films.
fn points() -> Vec<(f64, [f64; 4])> {
    let mut contacts = Contacts::new(301);
    let mut points = Vec::new();
    for i in 0..80 {
        let nu1 = match i % 4 {
            0 => 0.5,
            1 => 0.5 - contacts.log_uniform(1e-7, 1e-2),
            _ => contacts.uniform(0.01, 0.49),
        };
        // On the table's own substrate, and on others that keep the equivalent inside.
        let nu0 = if i % 3 == 0 {
            contacts.uniform(0.26, 0.49)
        } else {
            0.25
        };
        let x = if i < 60 {
            contacts.log_uniform(1.1e-3, 900.0)
        } else {
            contacts.log_uniform(1e-6, 9e-4)
        };
        let (e1, e0) = (
            contacts.log_uniform(2e-3, 5e2),
            contacts.log_uniform(2.0, 5e5),
        );
        if Table::embedded()
            .curve(&material([e1, nu1, e0, nu0]))
            .is_ok()
        {
            points.push((x, [e1, nu1, e0, nu0]));
        }
    }
    assert!(points.len() > 60, "{} points", points.len());
    points
}

/// Draws points with incompressible or nearly incompressible films at the soft end of the box and
/// next to it, where the quantities change most with `nu1`.
fn softest() -> Vec<(f64, [f64; 4])> {
    let mut contacts = Contacts::new(302);
    let point = |i: u32| {
        let nu1 = if i.is_multiple_of(2) {
            0.5
        } else {
            0.5 - contacts.log_uniform(1e-7, 9e-4)
        };
        let e1 = if i % 4 < 2 {
            1e-3
        } else {
            contacts.log_uniform(1e-3, 3e-3)
        };
        (
            contacts.log_uniform(0.1, 100.0),
            [e1, nu1, contacts.log_uniform(2.0, 5e5), 0.25],
        )
    };
    (0..200).map(point).collect()
}

/// Draws points on the faces of the box, where one or two moduli are at its ends.
fn faces() -> Vec<(f64, [f64; 4])> {
    let mut contacts = Contacts::new(303);
    let point = |i: usize| {
        let nu1 = [
            0.5,
            0.5 - contacts.log_uniform(1e-7, 1e-2),
            contacts.uniform(0.01, 0.49),
        ][i % 3];
        let (soft, any) = (
            contacts.log_uniform(1e-3, 1e3),
            contacts.log_uniform(1.0, 1e6),
        );
        let moduli = [
            [1e-3, 1.0],
            [1e-3, 1e6],
            [1e-3, any],
            [1e3, 1.0],
            [1e3, 1e6],
            [1e3, any],
            [soft, 1.0],
            [soft, 1e6],
        ];
        let [e1, e0] = moduli[i / 3 % moduli.len()];
        (contacts.log_uniform(1.1e-3, 900.0), [e1, nu1, e0, 0.25])
    };
    (0..120).map(point).collect()
}

#[test]
fn derivatives_of_the_quantities_are_those_of_direct_solves() {
    let worst = worst_misses(&points());
    println!("in tolerances, with respect to a/t, E1, nu1, E0, nu0: {worst:.1?}");
    // Measured: 0.9, 1.3, 4.3, 0.2, 0.4.
    assert!(
        worst
            .iter()
            .zip(SHARES)
            .all(|(&worst, share)| worst <= share)
    );
    let worst = worst_misses(&softest());
    println!("of the softest films: {worst:.1?}");
    // Measured: 2.0, 0.6, 8.0, 0.1, 0.1.
    assert!(
        worst
            .iter()
            .zip(SHARES)
            .all(|(&worst, share)| worst <= share)
    );
    let worst = worst_misses(&faces());
    println!("on the faces: {worst:.1?}");
    // Measured: 1.9, 1.2, 5.5, 0.4, 0.6.
    assert!(
        worst
            .iter()
            .zip(SHARES)
            .all(|(&worst, share)| worst <= share)
    );
}

/// Returns the largest errors at `points`, in tolerances, in the order of [`SHARES`].
fn worst_misses(points: &[(f64, [f64; 4])]) -> [f64; 5] {
    let table = Table::embedded();
    let tolerance = table.description().tolerance;
    let mut worst = [0.0; 5];
    for &(x, parameters) in points {
        let own = material(parameters);
        let curve = table.curve_with_gradient(&own).expect("inside");
        let gradient = curve.gradient(x).expect("inside");
        let [e1, nu1, e0, nu0] = parameters;
        // The quantities change on this range of the film's Poisson ratio.
        let scale = (1.0 - 2.0 * nu1) + 1.0 / (1.0 + x * x);
        let log = |x: f64, parameters: [f64; 4]| direct(x, parameters).to_array().map(f64::ln);
        let step = 0.005 * scale.min(0.5);
        // In the order of `SHARES`.
        let truths = [
            derivatives(0.01, false, |h| log(x * h.exp(), parameters)),
            derivatives(0.01, false, |h| log(x, [e1 * h.exp(), nu1, e0, nu0])),
            derivatives(step, nu1 + 2.0 * step > 0.5, |h| {
                log(x, [e1, nu1 + h, e0, nu0])
            }),
            derivatives(0.01, false, |h| log(x, [e1, nu1, e0 * h.exp(), nu0])),
            derivatives(0.005, nu0 > 0.48, |h| log(x, [e1, nu1, e0, nu0 + h])),
        ];
        let by = |parameter| gradient.by(parameter).expect("an axis").to_array();
        let found = [
            gradient.slopes().to_array(),
            by(Parameter::E1OverE2).map(|rate| rate * e1),
            by(Parameter::Nu1),
            by(Parameter::E0OverE2).map(|rate| rate * e0),
            gradient.by_nu0().expect("axes").to_array(),
        ];
        let units = [1.0, 1.0, scale, 1.0, 1.0 / (1.0 + e1 / e0)];
        let values = gradient.values().to_array();
        for (i, worst) in worst.iter_mut().enumerate() {
            for (k, value) in values.iter().enumerate() {
                let miss = (found[i][k] / value - truths[i][k]).abs() * units[i] / tolerance;
                *worst = larger(*worst, miss);
            }
        }
    }
    worst
}

/// Compares the derivatives with differences of lookups, which are splines in the logarithms of the
/// moduli and in `c(nu1)`.
#[test]
fn derivatives_of_the_quantities_are_those_of_the_interpolant() {
    let table = Table::embedded();
    let mut worst = 0.0;
    for (x, parameters) in points() {
        let gradient = table
            .curve_with_gradient(&material(parameters))
            .and_then(|curve| curve.gradient(x))
            .expect("inside");
        let [e1, nu1, e0, nu0] = parameters;
        // At nu1 = 0.5 the table ends, and near it the differences would have to be as small as
        // rounding.
        let near = nu1 > 0.48;
        let log = |x: f64, parameters: [f64; 4]| {
            let curve = table.curve(&material(parameters)).expect("inside");
            Quantity::ALL.map(|quantity| curve.quantity(quantity, x).expect("inside").ln())
        };
        let values = gradient.values().to_array();
        let mut compare = |found: Quantities, unit: f64, expected: [f64; 4]| {
            for ((found, value), expected) in found.to_array().iter().zip(values).zip(expected) {
                let difference = found * unit / value - expected;
                worst = larger(worst, difference.abs() / (1.0 + expected.abs()));
            }
        };
        let by = |parameter| gradient.by(parameter).expect("an axis");
        compare(
            gradient.slopes(),
            1.0,
            derivatives(1e-3, false, |h| log(x * h.exp(), parameters)),
        );
        compare(
            by(Parameter::E1OverE2),
            e1,
            derivatives(1e-3, false, |h| log(x, [e1 * h.exp(), nu1, e0, nu0])),
        );
        compare(
            by(Parameter::E0OverE2),
            e0,
            derivatives(1e-3, false, |h| log(x, [e1, nu1, e0 * h.exp(), nu0])),
        );
        if !near {
            compare(
                by(Parameter::Nu1),
                1.0,
                derivatives(1e-4, false, |h| log(x, [e1, nu1 + h, e0, nu0])),
            );
            compare(
                gradient.by_nu0().expect("axes"),
                1.0,
                derivatives(1e-4, false, |h| log(x, [e1, nu1, e0, nu0 + h])),
            );
        }
    }
    let worst = worst / table.description().tolerance;
    println!("largest difference {worst:.2} tolerances");
    // Measured: 0.19, most of it the rounding of the differences: a lookup holds those of its
    // numbers in single precision whose rounding is small compared with the tolerance.
    assert!(worst <= 1.0);
}

/// Returns a system with one of its inputs replaced by `value` (SI units).
fn with(system: System, input: Input, value: f64) -> System {
    let System {
        film, substrate, ..
    } = system;
    let elastic = |young, poisson| Elastic::new(young, poisson).expect("physical");
    match input {
        Input::SphereRadius => System {
            sphere_radius: value,
            ..system
        },
        Input::SphereModulus => System {
            sphere_modulus: value,
            ..system
        },
        Input::FilmThickness => System {
            film_thickness: value,
            ..system
        },
        Input::FilmModulus => System {
            film: elastic(value, film.poisson()),
            ..system
        },
        Input::FilmPoisson => System {
            film: elastic(film.young(), value),
            ..system
        },
        Input::SubstrateModulus => System {
            substrate: elastic(value, substrate.poisson()),
            ..system
        },
        Input::SubstratePoisson => System {
            substrate: elastic(substrate.young(), value),
            ..system
        },
        Input::ContactRadius | Input::WorkOfAdhesion => system,
    }
}

/// Returns load and penetration by a direct solve.
fn solved(system: System, a: f64, w: f64) -> [f64; 2] {
    let quantities = solve(
        a / system.film_thickness,
        &system.material().expect("physical"),
        1e-13,
    )
    .expect("solved")
    .quantities;
    let mechanics = Mechanics::new(&system).expect("physical");
    let edge = mechanics.edge_singularity(a, w).expect("physical");
    let (load, penetration) = mechanics.load_and_penetration(a, edge, &quantities);
    [load, penetration]
}

/// Compares the derivatives with respect to all inputs, for two systems in the embedded table and
/// one under a rigid sphere.
#[test]
fn derivatives_of_load_and_penetration_are_those_of_direct_solves() {
    let elastic = |young, poisson| Elastic::new(young, poisson).expect("physical");
    let soft = System {
        film: elastic(1e6, 0.4),
        substrate: elastic(2e7, 0.3),
        film_thickness: 2e-5,
        ..paper_system(1e-5)
    };
    let rigid_sphere = System {
        sphere_modulus: f64::INFINITY,
        ..soft
    };
    let rigid_sphere_table = acceptance::table(
        "title = 'Rigid sphere'\ntolerance = 1e-6\na_over_t = { from = 0.5, to = 10 }\ne1_over_e2 = 0
        nu1 = { from = 0.3, to = 0.5 }\ne0_over_e2 = { from = 5, to = 50 }\nnu0 = 0.3\nquantities = ['pi0', 'eeq', 'gamma', 'delta0']",
    );
    let cases: [(&Table, System); 3] = [
        (Table::embedded(), paper_system(1e-5)),
        (Table::embedded(), soft),
        (&rigid_sphere_table, rigid_sphere),
    ];
    for (table, system) in cases {
        let contact = table.contact_with_gradient(&system).expect("inside");
        let mut worst = 0.0;
        for (a, w) in [(4e-5, 0.04), (6.5e-5, 0.04), (9e-5, 0.1), (6.5e-5, 0.0)] {
            let gradient = contact.gradient(a, w).expect("inside");
            assert_eq!(
                (gradient.load(), gradient.penetration()),
                contact.load_and_penetration(a, w).expect("inside")
            );
            // In units of the adhesionless load and penetration, so that nothing depends on where
            // they cancel the adhesive ones.
            let [load, penetration] = solved(system, a, 0.0);
            let units = [load.abs(), penetration.abs()];
            for input in Input::ALL {
                let own = match input {
                    Input::ContactRadius => a,
                    Input::WorkOfAdhesion => w,
                    Input::SphereRadius => system.sphere_radius,
                    Input::SphereModulus => system.sphere_modulus,
                    Input::FilmThickness => system.film_thickness,
                    Input::FilmModulus => system.film.young(),
                    Input::FilmPoisson => system.film.poisson(),
                    Input::SubstrateModulus => system.substrate.young(),
                    Input::SubstratePoisson => system.substrate.poisson(),
                };
                if input == Input::WorkOfAdhesion && w == 0.0 {
                    let error = gradient.by(input).expect_err("infinite");
                    assert!(
                        matches!(error, Error::FixedParameter("work of adhesion")),
                        "{error}"
                    );
                    continue;
                }
                let found = gradient.by(input).expect("all are axes");
                if own == f64::INFINITY {
                    assert_eq!((found.load, found.penetration), (0.0, 0.0));
                    continue;
                }
                let is_poisson = matches!(input, Input::FilmPoisson | Input::SubstratePoisson);
                let (step, unit) = if is_poisson { (5e-4, 1.0) } else { (1e-2, own) };
                let value = |h: f64| match input {
                    Input::ContactRadius => solved(system, own * h.exp(), w),
                    Input::WorkOfAdhesion => solved(system, a, own * h.exp()),
                    _ if is_poisson => solved(with(system, input, own + h), a, w),
                    _ => solved(with(system, input, own * h.exp()), a, w),
                };
                let one_sided = is_poisson && own > 0.49;
                let expected = derivatives(step, one_sided, value);
                for (k, found) in [found.load, found.penetration].into_iter().enumerate() {
                    let expected = expected[k];
                    let miss =
                        (found * unit - expected).abs() / units[k] / table.description().tolerance;
                    assert!(
                        miss <= SHARES[2],
                        "{input:?} at a = {a}, w = {w}: {found}, not {expected} ({miss:.1} tolerances)"
                    );
                    worst = larger(worst, miss);
                }
            }
        }
        // Measured: 11.6, 2.4 and 7.9.
        println!(
            "{}: largest difference {worst:.1} tolerances",
            table.description().title
        );
    }
}

#[test]
fn what_is_not_known_is_an_error_that_names_it() {
    let paper = Table::read(shipped("paper.bin")).expect("a sound table");
    let contact = paper
        .contact_with_gradient(&paper_system(1e-6))
        .expect("inside");
    let gradient = contact.gradient(65e-6, 0.04).expect("inside");
    // The table fixes nu1 and E0/E2*. Therefore it has no derivative with respect to E2* either.
    for input in [
        Input::FilmPoisson,
        Input::SubstrateModulus,
        Input::SubstratePoisson,
        Input::SphereModulus,
    ] {
        let error = gradient.by(input).expect_err("fixed");
        assert!(
            matches!(error, Error::FixedParameter(name) if name == input.name()),
            "{error}"
        );
    }
    for input in [
        Input::ContactRadius,
        Input::WorkOfAdhesion,
        Input::SphereRadius,
        Input::FilmThickness,
        Input::FilmModulus,
    ] {
        assert!(gradient.by(input).is_ok(), "{input:?}");
    }
    let curve = paper
        .curve_with_gradient(&paper_system(1e-6).material().expect("physical"))
        .expect("inside");
    let gradient = curve.gradient(1.0).expect("inside");
    assert!(matches!(
        gradient.by(Parameter::AOverT),
        Err(Error::FixedParameter("a_over_t"))
    ));
    assert!(matches!(
        curve.gradient(1e4),
        Err(Error::OutsideTable {
            axis: "a_over_t",
            ..
        })
    ));
    assert!(matches!(
        curve.gradient(f64::NAN),
        Err(Error::OutsideTable {
            axis: "a_over_t",
            ..
        })
    ));

    let plain = paper.contact(&paper_system(1e-6)).expect("inside");
    assert!(matches!(
        plain.gradient(65e-6, 0.04),
        Err(Error::NoGradient)
    ));
    for (a, w) in [
        (0.0, 0.04),
        (f64::NAN, 0.04),
        (65e-6, -1.0),
        (65e-6, f64::NAN),
    ] {
        assert!(
            matches!(contact.gradient(a, w), Err(Error::Unphysical { .. })),
            "a = {a}, w = {w}"
        );
    }
    // Derivatives with respect to the parameters of an equivalent are not those of the system.
    let system = System {
        substrate: Elastic::new(2e11, 0.3).expect("physical"),
        ..paper_system(1e-6)
    };
    let equivalent = system
        .material()
        .and_then(|own| own.with_substrate_poisson_ratio(0.25))
        .expect("there is one");
    let other = Contact::new(
        &system,
        Table::embedded()
            .curve_with_gradient(&equivalent)
            .expect("inside"),
    )
    .expect("equivalent");
    assert!(matches!(
        other.gradient(65e-6, 0.04),
        Err(Error::OtherMaterial { .. })
    ));
}

/// Returns load and penetration of JKR in closed form.
#[test]
fn derivatives_on_a_half_space_are_those_of_jkr() {
    let jkr = |[a, w, r, sphere, young, nu]: [f64; 6]| {
        let modulus = 1.0 / (1.0 / sphere + (1.0 - nu * nu) / young);
        let load = 4.0 * modulus * a.powi(3) / (3.0 * r)
            - (8.0 * std::f64::consts::PI * w * modulus * a.powi(3)).sqrt();
        [
            load,
            a * a / r - (2.0 * std::f64::consts::PI * w * a / modulus).sqrt(),
        ]
    };
    let inputs = [
        Input::ContactRadius,
        Input::WorkOfAdhesion,
        Input::SphereRadius,
        Input::SphereModulus,
        Input::SubstrateModulus,
        Input::SubstratePoisson,
    ];
    let own = [6e-5, 0.04, 1e-3, 2e6, 5e6, 0.3];
    let [a, w, sphere_radius, sphere_modulus, young, nu] = own;
    let solid = Elastic::new(young, nu).expect("physical");
    let contact = Contact::half_space(&HalfSpace {
        sphere_radius,
        sphere_modulus,
        solid,
    })
    .expect("physical");
    let gradient = contact.gradient(a, w).expect("physical");
    for (i, input) in inputs.into_iter().enumerate() {
        let by = gradient.by(input).expect("known");
        for (k, found) in [by.load, by.penetration].into_iter().enumerate() {
            let at = |h: f64| {
                let mut inputs = own;
                inputs[i] *= 1.0 + h;
                jkr(inputs)[k]
            };
            let [expected] = derivatives(1e-3, false, |h| [at(h)]);
            assert!(
                (found * own[i] - expected).abs() <= 1e-10 * jkr(own)[k].abs(),
                "{input:?}: {found}, not {}",
                expected / own[i]
            );
        }
    }
    for input in [Input::FilmThickness, Input::FilmModulus, Input::FilmPoisson] {
        assert!(
            matches!(gradient.by(input), Err(Error::FixedParameter(name)) if name == input.name())
        );
    }
    let rigid = HalfSpace {
        sphere_radius,
        sphere_modulus: f64::INFINITY,
        solid,
    };
    let gradient = Contact::half_space(&rigid)
        .and_then(|contact| contact.gradient(a, w))
        .expect("physical");
    assert_eq!(gradient.by(Input::SphereModulus).expect("rigid").load, 0.0);
}
