//! Measures the time to make a curve and to evaluate it. Only ratios within one run are meaningful:
//! `cargo bench -p coated-contact-contact`.

use std::hint::black_box;

use contact::{Branch, Contact, Control, Derivatives, Input, State};
use criterion::{Criterion, criterion_group, criterion_main};
use interp::{Elastic, Material, Probe, Quantity, System, Table};

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
    criterion.bench_function("curve with derivatives, four axes, low-rank", |b| {
        b.iter(|| low_rank.curve_with_gradient(black_box(&material)))
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

criterion_group!(benches, lookup);
criterion_main!(benches);
