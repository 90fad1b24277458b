//! Errors of lookups: each names the value and the allowed range.

use contact::Contact;
use std::sync::LazyLock;

use acceptance::{
    assert_matches, assert_names, ends, material, paper_system, solid, table, workdir,
};
use interp::{
    Elastic, Error, Material, Mechanics, Parameter, Probe, Quantities, SubstratePoissonRatio,
    System, Table,
};

/// A scene whose ranges end inside those of physics.
const BOX: &str = "
    title      = 'Four axes'
    tolerance  = 1e-2
    a_over_t   = { from = 0.1, to = 10, nodes = 6 }
    e1_over_e2 = { from = 0.3, to = 3, nodes = 3 }
    nu1        = { from = 0.2, to = 0.45, nodes = 4 }
    e0_over_e2 = { from = 10, to = 100, nodes = 3 }
";
const RIGID_SPHERE: &str = "
    title      = 'Rigid sphere'
    tolerance  = 1e-2
    a_over_t   = { from = 0.1, to = 10, nodes = 6 }
    e1_over_e2 = 0
    nu1        = 0.5
    e0_over_e2 = inf
";
const INSIDE: [f64; 4] = [1.0, 1.0, 0.3, 30.0];

static TABLE: LazyLock<Table> = LazyLock::new(|| table(BOX));

fn look_up(table: &Table, [x, e1, nu1, e0]: [f64; 4]) -> Result<Quantities, Error> {
    table
        .curve(&Material::new(e1, nu1, e0, 0.25)?)?
        .quantities(x)
}

/// Returns a point inside the box with one parameter replaced.
fn with(parameter: Parameter, value: f64) -> [f64; 4] {
    let mut point = INSIDE;
    point[parameter as usize] = value;
    point
}

/// Asserts that an error is `Unphysical` and names the parameter `expected`, the value `given` and
/// the allowed range.
fn assert_unphysical<T: std::fmt::Debug>(
    result: Result<T, impl Into<contact::Error>>,
    expected: &str,
    given: f64,
) {
    match result.map_err(Into::into) {
        Err(contact::Error::Table(
            error @ Error::Unphysical {
                name,
                value,
                allowed,
            },
        )) => {
            assert_eq!(name, expected);
            assert_eq!(value.to_bits(), given.to_bits());
            assert_names(&error.to_string(), &[name, &format!("{given:?}"), allowed]);
        }
        other => panic!("{expected} = {given}: {other:?}"),
    }
}

#[test]
fn a_point_outside_the_box_is_an_error_with_axis_value_and_range() {
    for parameter in Parameter::ALL {
        let (first, last) = ends(&TABLE, parameter);
        for (end, outwards) in [(first, -1.0), (last, 1.0)] {
            // Rounding is allowed for: relative to the value, but for nu1, which may be 0.
            let size = if parameter == Parameter::Nu1 {
                1.0
            } else {
                end
            };
            for inside in [end, end + 0.5e-12 * size * outwards] {
                assert!(
                    look_up(&TABLE, with(parameter, inside)).is_ok(),
                    "{parameter:?} = {inside}"
                );
            }
            for outside in [
                end + 2e-12 * size * outwards,
                end * (1.0 + 0.01 * outwards),
                end * (1.0 + 0.1 * outwards),
            ] {
                match look_up(&TABLE, with(parameter, outside)) {
                    // Next to the table in a/t, the expansions about the limits are not accurate
                    // enough.
                    Err(
                        error @ Error::Extrapolation {
                            value,
                            edge,
                            tolerance,
                            ..
                        },
                    ) if parameter == Parameter::AOverT => {
                        assert_eq!(
                            (value, edge, tolerance),
                            (outside, end, TABLE.description().tolerance)
                        );
                        assert_names(
                            &error.to_string(),
                            &[
                                "a_over_t",
                                &format!("{value:?}"),
                                &format!("{end:?}"),
                                "accurate to",
                                &format!("the table to {tolerance:.1e}"),
                                "make a table",
                            ],
                        );
                    }
                    Err(
                        error @ Error::OutsideTable {
                            axis,
                            value,
                            from,
                            to,
                        },
                    ) => {
                        assert_eq!(
                            (axis, value, from, to),
                            (parameter.name(), outside, first, last)
                        );
                        assert_names(
                            &error.to_string(),
                            &[
                                axis,
                                &format!("{value:?}"),
                                &format!("{from:?}"),
                                &format!("{to:?}"),
                            ],
                        );
                    }
                    other => panic!("{parameter:?} = {outside}: {other:?}"),
                }
            }
        }
    }
}

#[test]
fn extreme_values_of_a_over_t_are_outside_or_the_limits() {
    let material = material([1.0, 0.3, 30.0, 0.25]);
    let curve = TABLE.curve(&material).expect("inside");
    for (x, limit) in [
        (f64::from_bits(1), material.thick_film_limit()),
        (f64::MAX, material.thin_film_limit()),
    ] {
        assert!(
            acceptance::relative_error(&curve.quantities(x).expect("the limit"), &limit) <= 1e-15,
            "a_over_t = {x}"
        );
    }
    for x in [0.0, -0.0, -1.0, f64::INFINITY, f64::NEG_INFINITY, f64::NAN] {
        match curve.quantities(x) {
            Err(Error::OutsideTable {
                axis: "a_over_t",
                value,
                from: 0.1,
                to: 10.0,
            }) => assert_eq!(value.to_bits(), x.to_bits()),
            other => panic!("a_over_t = {x}: {other:?}"),
        }
    }
}

#[test]
fn a_rigid_substrate_is_outside_a_table_of_compliant_ones() {
    let error = TABLE
        .curve(&material([1.0, 0.3, f64::INFINITY, 0.25]))
        .expect_err("outside");
    assert_matches!(
        error,
        Error::OutsideTable {
            axis: "e0_over_e2",
            value: f64::INFINITY,
            ..
        }
    );
}

#[test]
fn a_fixed_parameter_holds_no_other_value() {
    let table = table(&BOX.replace("{ from = 0.2, to = 0.45, nodes = 4 }", "0.3"));
    assert!(look_up(&table, INSIDE).is_ok());
    for nu1 in [0.3 - 2e-12, 0.3 + 2e-12, 0.31] {
        let error = look_up(&table, with(Parameter::Nu1, nu1)).expect_err("not the fixed value");
        assert_matches!(
            error,
            Error::OutsideTable {
                axis: "nu1",
                from: 0.3,
                to: 0.3,
                ..
            }
        );
    }
}

#[test]
fn a_rigid_sphere_needs_a_table_of_its_own() {
    let rigid = table(RIGID_SPHERE);
    let system = |sphere_modulus| System {
        sphere_modulus,
        ..paper_system(1e-6)
    };
    for (table, sphere, holds, asked) in [
        (&*TABLE, f64::INFINITY, "E2*", "E1*"),
        (&rigid, 2e6, "E1*", "E2*"),
    ] {
        let kind = if sphere == f64::INFINITY {
            "the sphere is rigid"
        } else {
            "the sphere is compliant"
        };
        match Contact::in_table(table, &system(sphere)) {
            Err(contact::Error::Table(error @ Error::Normalisation { table, query })) => {
                assert_eq!((table, query), (holds, asked));
                assert_names(&error.to_string(), &[holds, kind, "e1_over_e2", "embedded"]);
            }
            other => panic!("{sphere}: {other:?}"),
        }
    }
    let solid = System {
        substrate: solid(f64::INFINITY, 0.25),
        ..system(f64::INFINITY)
    };
    assert!(
        Contact::in_table(&rigid, &solid).is_ok(),
        "its own rigid sphere"
    );
}

#[test]
fn a_material_without_an_equivalent_on_the_tables_substrate_is_an_error() {
    // An auxetic film on an incompressible substrate: on one of 0.25 it would need a Poisson ratio
    // below -1.
    let result = TABLE.curve(&material([1.0, -0.9, 1.0, 0.5]));
    match result {
        Err(
            error @ Error::Equivalent {
                nu1: -0.9,
                nu0: 0.5,
                table_nu0: SubstratePoissonRatio::Fixed(0.25),
                ..
            },
        ) => {
            // The message names the cause once, also where a program prints the chain of sources.
            assert!(std::error::Error::source(&error).is_none());
            let message = error.to_string();
            let Error::Equivalent { cause, .. } = error else {
                unreachable!("matched above")
            };
            assert_matches!(*cause, Error::Unphysical { name: "nu1", .. });
            assert_names(
                &message,
                &[
                    "nu1 = -0.9",
                    "nu0 = 0.5",
                    "nu0 = 0.25",
                    &cause.to_string(),
                    "make a table with nu0 = 0.5",
                    "without a table",
                ],
            );
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_table_for_a_rigid_substrate_holds_no_compliant_one() {
    let table = table(&BOX.replace("{ from = 10, to = 100, nodes = 3 }", "inf"));
    assert!(
        table
            .curve(&material([1.0, 0.3, f64::INFINITY, 0.25]))
            .is_ok()
    );
    for e0 in [1.0, 1e12, f64::MAX] {
        let result = table.curve(&material([1.0, 0.3, e0, 0.25]));
        assert!(
            matches!(result, Err(Error::OutsideTable { axis: "e0_over_e2", value, .. }) if value == e0),
            "{result:?}"
        );
    }
}

#[test]
fn the_work_of_adhesion_is_finite_and_not_negative() {
    let system = System {
        film: solid(2e6, 0.3),
        substrate: solid(6e7, 0.25),
        ..paper_system(1e-6)
    };
    let contact = Contact::in_table(&TABLE, &system).expect("inside");
    assert!(contact.load(1e-6, 0.0).expect("no adhesion") > 0.0);
    for w in [-1e-300, -0.04, f64::NEG_INFINITY, f64::INFINITY, f64::NAN] {
        assert_unphysical(contact.load(1e-6, w), "work of adhesion", w);
        assert_unphysical(contact.load_and_penetration(1e-6, w), "work of adhesion", w);
    }
    for a in [0.0, -1e-6, f64::INFINITY, f64::NAN] {
        assert_unphysical(contact.load(a, 0.04), "contact radius", a);
        assert_unphysical(contact.load_and_penetration(a, 0.04), "contact radius", a);
        assert_unphysical(contact.stiffness(a), "contact radius", a);
    }
    let [first, last] = contact.contact_radius_range();
    for a in [0.99 * first, 1.01 * last] {
        for result in [
            contact.load(a, 0.04),
            contact.load_and_penetration(a, 0.04).map(|(load, _)| load),
            contact.stiffness(a),
        ] {
            assert!(
                matches!(
                    result,
                    Err(contact::Error::Table(Error::Extrapolation { .. }))
                ),
                "{a}: {result:?}"
            );
        }
    }
}

#[test]
fn an_unphysical_solid_or_system_is_an_error_that_names_it() {
    for young in [0.0, -1.0, f64::NEG_INFINITY, f64::NAN] {
        assert_unphysical(Elastic::new(young, 0.3), "Young's modulus", young);
    }
    for poisson in [-1.0, 0.5000000000000001, f64::INFINITY, f64::NAN] {
        assert_unphysical(Elastic::new(1e6, poisson), "Poisson ratio", poisson);
    }
    type Change = fn(&mut System, f64);
    let changes: [(&str, Change, &[f64]); 4] = [
        (
            "sphere_radius",
            |system, radius| system.probe = Probe::Paraboloid { radius },
            &[0.0, -1.0, f64::INFINITY, f64::NAN],
        ),
        (
            "film_thickness",
            |system, t| system.film_thickness = t,
            &[0.0, -1.0, f64::INFINITY, f64::NAN],
        ),
        (
            "sphere_modulus",
            |system, modulus| system.sphere_modulus = modulus,
            &[0.0, -1.0, f64::NAN],
        ),
        (
            "film modulus",
            |system, young| system.film = solid(young, 0.3),
            &[f64::INFINITY],
        ),
    ];
    for (name, change, values) in changes {
        for &value in values {
            let mut system = paper_system(1e-6);
            change(&mut system, value);
            assert_unphysical(system.material(), name, value);
            assert_unphysical(Mechanics::new(&system), name, value);
            assert_unphysical(Contact::in_table(&TABLE, &system), name, value);
        }
    }
}

#[test]
fn the_program_names_the_point_the_axis_and_the_range() {
    let workdir = workdir!();
    workdir.write("table.bin", TABLE.to_packed().expect("a small table"));
    workdir.write_points("1,1,0.3,30\n1,1,0.3,300\n");
    let message = workdir.fail(1, "query table.bin --points points.csv -o out.csv");
    assert_names(&message, "points.csv, line 3; e0_over_e2; 300; 10; 100");
    assert_eq!(workdir.files(), ["points.csv", "table.bin"]);

    // The cause of an error is printed, and once.
    workdir.write(
        "points.csv",
        "a_over_t,e1_over_e2,nu1,e0_over_e2,nu0\n1,1,-0.9,1,0.5\n",
    );
    let message = workdir.fail(1, "query table.bin --points points.csv");
    assert_names(&message, "points.csv, line 2; nu0 = 0.5; tabulate solve");
    assert_eq!(message.matches("the cause: nu1 = ").count(), 1, "{message}");
    assert_eq!(message.matches("is not physical").count(), 1, "{message}");
}

/// The only systems that the embedded table refuses. The value is that of the user's own moduli,
/// though the table's substrates have other Poisson ratios.
#[test]
fn a_film_too_stiff_for_the_embedded_table_is_refused_by_its_modulus() {
    let (e1, nu1, e0, nu0) = (1e12, 0.3, 1.0, 0.2);
    let own = material([e1, nu1, e0, nu0]);
    let film = e1 / (1.0 - nu1 * nu1);
    let ratio = film + film * (1.0 - nu0 * nu0) / e0;
    let error = Table::embedded().curve(&own).expect_err("too stiff");
    let Error::OutsideTable {
        axis, value, to, ..
    } = error
    else {
        panic!("{error}");
    };
    assert_eq!(axis, "e1s_over_einfs");
    assert!((value / ratio - 1.0).abs() < 1e-14 && to == 1e10, "{error}");
    assert_names(
        &error.to_string(),
        &[axis, "10000000000", "without a table"],
    );
}
