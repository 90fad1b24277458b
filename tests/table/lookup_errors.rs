//! Errors of lookups: each names the value and the allowed range.

use std::fmt::Debug;
use std::sync::LazyLock;

use acceptance::{
    Refused, assert_matches, assert_names, ends, material, paper_system, relative_error, solid,
    table, workdir,
};
use contact::Contact;
use interp::{Error, Material, Parameter, Quantities, SubstratePoissonRatio, System, Table};

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

/// Asserts that a lookup is outside a table, by the axis, the value and the range.
#[track_caller]
fn assert_outside<T: Debug>(
    result: Result<T, Error>,
    parameter: Parameter,
    outside: f64,
    range: [f64; 2],
) {
    match result {
        Err(
            error @ Error::OutsideTable {
                axis,
                value,
                from,
                to,
            },
        ) => {
            assert_eq!((axis, [from, to]), (parameter.name(), range));
            assert_eq!(value.to_bits(), outside.to_bits());
            let numbers = [value, from, to].map(|number| format!("{number:?}"));
            assert_names(&error.to_string(), axis);
            assert_names(&error.to_string(), &numbers);
        }
        other => panic!("{parameter:?} = {outside}: {other:?}"),
    }
}

#[test]
fn a_point_outside_the_box_is_an_error_with_axis_value_and_range() {
    for parameter in Parameter::ALL {
        let (first, last) = ends(&TABLE, parameter);
        for (end, outwards) in [(first, -1.0), (last, 1.0)] {
            // Rounding is allowed for: relative to the value, but for nu1, which may be 0.
            let is_ratio = parameter == Parameter::Nu1;
            let size = if is_ratio { 1.0 } else { end };
            for inside in [end, end + 0.5e-12 * size * outwards] {
                let found = look_up(&TABLE, with(parameter, inside));
                assert!(found.is_ok(), "{parameter:?} = {inside}");
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
                        assert_eq!((value, edge), (outside, end));
                        assert_eq!(tolerance, TABLE.description().tolerance);
                        let words = format!("a_over_t; {value:?}; {end:?}; accurate to");
                        let more = format!("the table to {tolerance:.1e}; make a table");
                        assert_names(&error.to_string(), &format!("{words}; {more}"));
                    }
                    result => assert_outside(result, parameter, outside, [first, last]),
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
        let found = curve.quantities(x).expect("the limit");
        assert!(relative_error(&found, &limit) <= 1e-15, "a_over_t = {x}");
    }
    for x in [0.0, -0.0, -1.0, f64::INFINITY, f64::NEG_INFINITY, f64::NAN] {
        assert_outside(curve.quantities(x), Parameter::AOverT, x, [0.1, 10.0]);
        assert_outside(curve.error(x), Parameter::AOverT, x, [0.1, 10.0]);
    }
}

#[test]
fn a_limit_or_a_fixed_value_is_another_than_those_of_a_range() {
    use Parameter::{E0OverE2, Nu1};
    const RIGID: f64 = f64::INFINITY;
    let fixed = table(&BOX.replace("{ from = 0.2, to = 0.45, nodes = 4 }", "0.3"));
    let rigid = table(&BOX.replace("{ from = 10, to = 100, nodes = 3 }", "inf"));
    assert!(look_up(&fixed, INSIDE).is_ok());
    assert!(look_up(&rigid, with(E0OverE2, RIGID)).is_ok());
    for (table, parameter, values, range) in [
        (&*TABLE, E0OverE2, &[RIGID][..], [10.0, 100.0]),
        (&fixed, Nu1, &[0.3 - 2e-12, 0.3 + 2e-12, 0.31], [0.3, 0.3]),
        (&rigid, E0OverE2, &[1.0, 1e12, f64::MAX], [RIGID, RIGID]),
    ] {
        for &value in values {
            let result = look_up(table, with(parameter, value));
            assert_outside(result, parameter, value, range);
        }
    }
}

#[test]
fn a_rigid_sphere_needs_a_table_of_its_own() {
    let rigid = table(RIGID_SPHERE);
    let system = |sphere_modulus| System {
        sphere_modulus,
        ..paper_system(1e-6)
    };
    for (table, sphere, holds) in [(&*TABLE, f64::INFINITY, "E2*"), (&rigid, 2e6, "E1*")] {
        let is_rigid = sphere == f64::INFINITY;
        let kind = if is_rigid { "rigid" } else { "compliant" };
        let words = format!("{holds}; the sphere is {kind}; e1_over_e2; embedded");
        Contact::in_table(table, &system(sphere)).refused(&words);
    }
    let solid = System {
        substrate: solid(f64::INFINITY, 0.25),
        ..system(f64::INFINITY)
    };
    Contact::in_table(&rigid, &solid).expect("its own rigid sphere");
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
fn a_contact_beyond_the_table_is_refused() {
    let system = System {
        film: solid(2e6, 0.3),
        substrate: solid(6e7, 0.25),
        ..paper_system(1e-6)
    };
    let contact = Contact::in_table(&TABLE, &system).expect("inside");
    let [first, last] = contact.contact_radius_range();
    for a in [0.99 * first, 1.01 * last] {
        for result in [
            contact.load(a, 0.04),
            contact.load_and_penetration(a, 0.04).map(|(load, _)| load),
            contact.stiffness(a),
        ] {
            use contact::Error::Table;
            assert_matches!(result, Err(Table(Error::Extrapolation { .. })));
        }
    }
}

#[test]
fn the_program_prints_the_cause_once() {
    let workdir = workdir!();
    workdir.pack("table.bin", &TABLE);
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
    let words = "e1s_over_einfs; 10000000000; without a table";
    assert_names(&error.to_string(), words);
}
