//! The time of one direct solve by `a/t` and tolerance, and of a whole curve on all cores, for the
//! paper's material. Compare times within one run only.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use interp::Material;
use solve::curve;
use solve::solve;

fn solves(criterion: &mut Criterion) {
    let material = Material::new(1.75, 0.5, 1e5, 0.25).expect("physical");
    for tolerance in [1e-6, 1e-10] {
        let mut group = criterion.benchmark_group(format!("solve to {tolerance:e}"));
        for a_over_t in [0.01, 1.0, 10.0, 30.0, 100.0, 1000.0] {
            group.bench_with_input(
                BenchmarkId::from_parameter(a_over_t),
                &a_over_t,
                |b, &a_over_t| {
                    b.iter(|| solve(black_box(a_over_t), black_box(&material), tolerance))
                },
            );
        }
        group.finish();
    }
}

fn curves(criterion: &mut Criterion) {
    let material = Material::new(1.75, 0.5, 1e5, 0.25).expect("physical");
    let mut group = criterion.benchmark_group("curve, a/t from 1e-3 to 1e3");
    for tolerance in [1e-6, 1e-8, 1e-10] {
        let name = BenchmarkId::from_parameter(format!("{tolerance:e}"));
        group.bench_function(name, |b| {
            b.iter(|| curve(black_box(&material), [1e-3, 1e3], tolerance))
        });
    }
    group.finish();
}

criterion_group!(benches, solves, curves);
criterion_main!(benches);
