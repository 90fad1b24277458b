//! The time of a solve of one film and of three layers, and of a curve of 200 layers. Compare times
//! within one run only.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use interp::{Elastic, Material};
use tabulate::stack::{Layer, Stack};
use tabulate::{solve, solve_stack, stack_curve};

/// The tolerance of the solves.
const TOLERANCE: f64 = 1e-8;

fn solid(young: f64, poisson: f64) -> Elastic {
    Elastic::new(young, poisson).expect("physical")
}

/// A primer and an adhesive below the paper's film, all of one thickness.
fn three_layers() -> Stack {
    let layer = |young, poisson| Layer {
        solid: solid(young, poisson),
        thickness: 1e-6,
    };
    let layers = [layer(5e5, 0.5), layer(3e7, 0.4), layer(1.75e6, 0.5)];
    Stack::new(solid(1e11, 0.25), layers).expect("physical")
}

/// Both at the same contact radius over the thickness of the top layer.
fn solves(criterion: &mut Criterion) {
    let material = Material::new(1.75, 0.5, 1e5, 0.25).expect("physical");
    let stack = three_layers();
    for a_over_top in [0.3, 1.0, 3.0, 10.0] {
        let mut group = criterion.benchmark_group(format!("solve at a/h = {a_over_top}"));
        group.bench_function(BenchmarkId::from_parameter("one film"), |b| {
            b.iter(|| solve(black_box(a_over_top), &material, TOLERANCE))
        });
        group.bench_function(BenchmarkId::from_parameter("three layers"), |b| {
            b.iter(|| solve_stack(black_box(a_over_top / 3.0), &stack, 1e6, TOLERANCE))
        });
        group.finish();
    }
}

fn curves(criterion: &mut Criterion) {
    let graded = |height: f64| solid(1e6 * 20_f64.powf(height / 1e-6), 0.4);
    let stack = Stack::graded(solid(1e6, 0.4), 1e-6, 200, graded).expect("physical");
    criterion.bench_function("curve of 200 layers, a/h up to 200", |b| {
        b.iter(|| stack_curve(black_box(&stack), 1e6, [1e-2, 1.0], TOLERANCE))
    });
}

criterion_group!(benches, solves, curves);
criterion_main!(benches);
