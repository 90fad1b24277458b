//! Measures the time to make a curve and to evaluate it. Only ratios within one run are meaningful:
//! `cargo bench -p coated-contact-contact`.

use std::env;
use std::hint::black_box;
use std::process::Command;

use contact::{Branch, Contact, Control, Derivatives, Input, State};
use criterion::{Criterion, criterion_group};
use interp::{Curve, Elastic, Material, Parameter, Probe, Quantity, System, Table};
use splines::{Interpolation, Key, Spline};

fn lookup(criterion: &mut Criterion) {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tables/paper.bin");
    let table = Table::read(path).expect("the paper's table is in the repository");
    let material = Material::new(1.75, 0.5, 1e5, 0.25).expect("physical");
    let curve = table.curve(&material).expect("in the table");
    let substrate = Elastic::new(2e11, 0.25).expect("physical");
    let film = Elastic::new(3.5e6, 0.5).expect("physical");
    let system = System {
        probe: Probe::Paraboloid { radius: 1e-3 },
        sphere_modulus: 2e6,
        film,
        film_thickness: 1e-6,
        substrate,
    };
    let contact = Contact::in_table(&table, &system).expect("in the table");
    // The points are in no order, so that neither cache nor branch predictor can guess the next
    // one.
    let points: Vec<f64> = (0..1000)
        .map(|i| 10_f64.powf(-3.0 + 6.0 * (f64::from(i) * 0.618_034 % 1.0)))
        .collect();
    let mut next = points.iter().cycle();
    let mut point = || *next.next().expect("endless");

    criterion.bench_function("curve of a new material, paper table", |b| {
        b.iter(|| table.curve(black_box(&material)))
    });
    let low_rank = Table::embedded();
    let embedded_curve = low_rank.curve(&material).expect("in the table");
    for (what, held) in [
        ("all four", [true; 4]),
        ("gamma", [false, false, true, false]),
    ] {
        let table = of_one_material(low_rank, &embedded_curve, held);
        table.curve(&material).expect("in the table");
        criterion.bench_function(
            &format!("curve of the table of one material, {what}"),
            |b| b.iter(|| table.curve(black_box(&material))),
        );
        criterion.bench_function(
            &format!("curve with derivatives of the table of one material, {what}"),
            |b| b.iter(|| table.curve_with_gradient(black_box(&material))),
        );
    }
    let dense = low_rank.expand().expect("the nodes fit in memory");
    for (form, table) in [("low-rank", low_rank), ("dense", &dense)] {
        table.curve(&material).expect("in the table");
        criterion.bench_function(
            &format!("curve of a new material, four axes, {form}"),
            |b| b.iter(|| table.curve(black_box(&material))),
        );
    }
    // The materials are evenly spread over the box, as in no fit. Each one needs another part of
    // the coefficients that the table prepares.
    let materials: Vec<Material> = (1..=1000).map(material_of_the_box).collect();
    let mut next = materials.iter().cycle();
    let mut any = || next.next().expect("endless");
    criterion.bench_function("curve of any material, four axes, low-rank", |b| {
        b.iter(|| low_rank.curve(black_box(any())))
    });
    // The part that the shape adds to a new material.
    for (what, probe) in [
        ("paraboloid", Probe::Paraboloid { radius: 1e-5 }),
        ("sphere", Probe::Sphere { radius: 1e-5 }),
    ] {
        let system = System {
            probe,
            ..system.clone()
        };
        criterion.bench_function(&format!("contact of a new material, {what}"), |b| {
            b.iter(|| Contact::in_table(low_rank, black_box(&system)))
        });
    }
    criterion.bench_function("curve with derivatives, four axes, low-rank", |b| {
        b.iter(|| low_rank.curve_with_gradient(black_box(&material)))
    });
    // The cost of a search among the pieces of a curve, which the curve itself avoids: one value
    // among as many keys at these points.
    let key = |i: i32| {
        let u = 0.022 * f64::from(i) - 6.907_755;
        Key::new(
            u,
            u,
            Interpolation::StrokeBezier(u - 0.022 / 3.0, u + 0.022 / 3.0),
        )
    };
    let spline = Spline::from_vec((0..630).map(key).collect());
    criterion.bench_function("search and one value, splines", |b| {
        b.iter(|| spline.clamped_sample(black_box(point().ln())))
    });
    let mut values = vec![0.0; points.len()];
    criterion.bench_function("one quantity at a thousand points", |b| {
        b.iter(|| curve.quantity_at_all(Quantity::Eeq, black_box(&points), black_box(&mut values)))
    });
    criterion.bench_function("one quantity on a curve", |b| {
        b.iter(|| curve.quantity(Quantity::Eeq, black_box(point())))
    });
    criterion.bench_function("four quantities on a curve", |b| {
        b.iter(|| curve.quantities(black_box(point())))
    });
    criterion.bench_function("load, eq. 9", |b| {
        b.iter(|| contact.load(black_box(1e-7 * point() + 1e-6), black_box(0.04)))
    });
    let contact = Contact::in_table_with_gradient(low_rank, &system).expect("in the table");
    criterion.bench_function("load and penetration with nine derivatives each", |b| {
        b.iter(|| contact.gradient(black_box(1e-7 * point() + 1e-6), black_box(0.04)))
    });
    let equilibria = contact
        .equilibria(0.04, Control::Displacement)
        .expect("the table goes on to 0");
    let penetrations: Vec<f64> = (0..300).map(|i| 1e-8 * f64::from(i)).collect();
    let mut states = [State::ORIGIN; 300];
    criterion.bench_function("300 states on a branch", |b| {
        b.iter(|| equilibria.branch(black_box(&penetrations), Branch::Unloading, &mut states))
    });
    let inputs = [
        Input::SphereModulus,
        Input::FilmModulus,
        Input::WorkOfAdhesion,
    ];
    let mut derivatives = [Derivatives::ZERO; 1200];
    criterion.bench_function("300 states on a branch with four derivatives each", |b| {
        b.iter(|| {
            equilibria.branch_with_gradient(
                black_box(&penetrations),
                Branch::Unloading,
                &inputs,
                &mut states,
                &mut derivatives,
            )
        })
    });
}

/// Returns the table of one material that holds some quantities of `curve` at the nodes of `table`.
/// Its curve is made from the coefficients over `ln(a/t)` alone.
fn of_one_material(table: &Table, curve: &Curve, held: [bool; 4]) -> Table {
    let nodes = table.axis(Parameter::AOverT);
    let material = curve.material();
    let axes = [
        (Parameter::AOverT, nodes.to_vec()),
        (Parameter::E1OverE2, vec![material.e1_over_e2()]),
        (Parameter::Nu1, vec![material.nu1()]),
        (Parameter::E0OverE2, vec![material.e0_over_e2()]),
    ];
    let at_nodes = |quantity: Quantity| {
        let values = nodes.iter().map(|&x| curve.quantity(quantity, x));
        held[quantity as usize].then(|| values.map(|value| value.expect("a node")).collect())
    };
    Table::new(
        table.description().clone(),
        axes,
        Quantity::ALL.map(at_nodes),
    )
    .expect("sound")
}

/// Returns the `i`-th point of an additive recurrence over the axes of the embedded table.
fn material_of_the_box(i: i32) -> Material {
    // The inverse powers of the root of `x^4 = x + 1`.
    let [e1, nu1, e0] =
        [0.819_172_513, 0.671_043_607, 0.549_700_478].map(|step| f64::from(i) * step % 1.0);
    Material::new(
        10_f64.powf(6.0 * e1 - 3.0),
        0.5 * nu1,
        10_f64.powf(6.0 * e0),
        0.25,
    )
    .expect("physical")
}

/// The variable of the environment with which this program is a process that looks one contact up
/// (`lookup`), or that does nothing.
const CHILD: &str = "FIRST_LOOKUP";

/// Measures a process that looks one material up in the embedded table, beside one that does nothing.
fn first_lookup(criterion: &mut Criterion) {
    let program = env::current_exe().expect("this program");
    for (name, task) in [
        ("empty process", "nothing"),
        ("process with its first lookup", "lookup"),
    ] {
        criterion.bench_function(name, |b| {
            b.iter(|| {
                let status = Command::new(&program).env(CHILD, task).status();
                assert!(status.expect("this program runs").success());
            });
        });
    }
}

criterion_group!(benches, lookup, first_lookup);

fn main() {
    match env::var(CHILD).as_deref() {
        Ok("lookup") => {
            let material = Material::new(1.75, 0.5, 1e5, 0.25).expect("physical");
            black_box(Table::embedded().curve(&material)).expect("in the table");
        }
        Ok(_) => {}
        Err(_) => {
            benches();
            Criterion::default().configure_from_args().final_summary();
        }
    }
}
