//! Time of making a curve and of evaluating it. Ratios within one run are what counts.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use interp::{Elastic, Material, Quantity, System, Table};
use splines::{Interpolation, Key, Spline};

fn lookup(criterion: &mut Criterion) {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tables/paper.bin");
    let table = Table::read(path).expect("the paper's table is in the repository");
    let material = Material::new(1.75, 0.5, 1e5, 0.25).expect("physical");
    let curve = table.curve(&material).expect("in the table");
    let substrate = Elastic::new(2e11, 0.25).expect("physical");
    let film = Elastic::new(3.5e6, 0.5).expect("physical");
    let system = System { sphere_radius: 1e-3, sphere_modulus: 2e6, film, film_thickness: 1e-6, substrate };
    let contact = table.contact(&system).expect("in the table");
    // Points in no order, so that neither cache nor branch predictor can know the next.
    let points: Vec<f64> = (0..1000).map(|i| 10_f64.powf(-3.0 + 6.0 * (f64::from(i) * 0.618_034 % 1.0))).collect();
    let mut next = points.iter().cycle();
    let mut point = || *next.next().expect("endless");

    criterion.bench_function("curve of a new material, paper table", |b| b.iter(|| table.curve(black_box(&material))));
    let low_rank = Table::embedded();
    let dense = low_rank.expand().expect("the nodes fit in memory");
    for (form, table) in [("low-rank", low_rank), ("dense", &dense)] {
        table.curve(&material).expect("in the table");
        criterion.bench_function(&format!("curve of a new material, four axes, {form}"), |b| {
            b.iter(|| table.curve(black_box(&material)))
        });
    }
    // What a curve would pay for the search in its keys without its buckets: one value, as many keys, in the same order of points.
    let key = |i: i32| {
        let u = 0.022 * f64::from(i) - 6.907_755;
        Key::new(u, u, Interpolation::StrokeBezier(u - 0.022 / 3.0, u + 0.022 / 3.0))
    };
    let spline = Spline::from_vec((0..630).map(key).collect());
    criterion.bench_function("search and one value, splines", |b| b.iter(|| spline.clamped_sample(black_box(point().ln()))));
    let mut values = vec![0.0; points.len()];
    criterion.bench_function("one quantity at a thousand points", |b| {
        b.iter(|| curve.quantity_at_all(Quantity::Eeq, black_box(&points), black_box(&mut values)))
    });
    criterion.bench_function("one quantity on a curve", |b| b.iter(|| curve.quantity(Quantity::Eeq, black_box(point()))));
    criterion.bench_function("four quantities on a curve", |b| b.iter(|| curve.quantities(black_box(point()))));
    criterion.bench_function("load, eq. 9", |b| b.iter(|| contact.load(black_box(1e-7 * point() + 1e-6), black_box(0.04))));
}

criterion_group!(benches, lookup);
criterion_main!(benches);
