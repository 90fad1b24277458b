//! The time of a solve of one film and of three layers, of a curve of 200 layers, and of the table
//! of a stack: what each sphere adds to a sweep, and what a lookup takes. Compare times within one
//! run only.

use std::hint::black_box;

use contact::Contact;
use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use interp::{Elastic, Material, Table};
use solve::stack::{Interface, Layer, Stack};
use solve::{solve, solve_stack, stack_curve};
use tabulate::table::{Plan, Scene, stack_of, sweep};

/// The tolerance of the solves.
const TOLERANCE: f64 = 1e-8;

/// The scene of the table: two layers.
const SCENE: &str = include_str!("../../../tables/stacks/primer-scene.toml");

fn solid(young: f64, poisson: f64) -> Elastic {
    Elastic::new(young, poisson).expect("physical")
}

/// A primer and an adhesive below the paper's film, all of one thickness.
fn three_layers() -> Stack {
    let layer = |young, poisson| Layer::bonded(solid(young, poisson), 1e-6);
    let layers = [layer(5e5, 0.5), layer(3e7, 0.4), layer(1.75e6, 0.5)];
    Stack::new(solid(1e11, 0.25), layers).expect("physical")
}

/// Both at the same contact radius over the thickness of the top layer. Beyond `a/h` of some 20 one
/// film takes the Wiener-Hopf method, which layers do not have.
fn solves(criterion: &mut Criterion) {
    let material = Material::new(1.75, 0.5, 1e5, 0.25).expect("physical");
    let stack = three_layers();
    for a_over_top in [0.3, 1.0, 3.0, 10.0, 30.0] {
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
    let film = Layer {
        interface: Interface::Sliding,
        ..Layer::bonded(solid(1.75e6, 0.5), 1e-6)
    };
    let film = Stack::new(solid(1e11, 0.25), [film]).expect("physical");
    for to in [10.0, 100.0] {
        let name = format!("curve of a film that slides, three decades of a/t up to {to}");
        criterion.bench_function(&name, |b| {
            b.iter(|| stack_curve(black_box(&film), 1e6, [1e-3 * to, to], TOLERANCE))
        });
    }
}

/// The nodes of one `a/t` under one sphere and under 29.
fn sweeps(criterion: &mut Criterion) {
    let scene = Scene::parse(SCENE, None).expect("a sound scene");
    let planned = Plan::new(&scene).expect("within reach").axes(&scene);
    let (from, to) = (planned[1].1[0], planned[1].1[planned[1].1.len() - 1]);
    let mut group = criterion.benchmark_group("nodes of the table at a/t = 6.5");
    for spheres in [1, 29] {
        let ratio = |i| from * (to / from).powf((f64::from(i) + 0.5) / f64::from(spheres));
        let mut axes = planned.clone();
        axes[0].1 = vec![6.5];
        axes[1].1 = (0..spheres).map(ratio).collect();
        group.bench_function(BenchmarkId::new("spheres", spheres), |b| {
            b.iter(|| sweep(black_box(&scene), &axes, &|_| ()))
        });
    }
    group.finish();
}

/// The curve and a load of a sphere of 2 MPa, by the table and by direct solves.
fn lookups(criterion: &mut Criterion) {
    let scene = Scene::parse(SCENE, None).expect("a sound scene");
    let axes = Plan::new(&scene).expect("within reach").axes(&scene);
    let values = sweep(&scene, &axes, &|_| ()).expect("within reach");
    let table = Table::new(scene.description(), axes, values).expect("a whole table");
    let named = stack_of(&table).expect("a sound scene");
    let stack = named.expect("a table of a stack").stack;
    let mut group = criterion.benchmark_group("two layers, a sphere of 2 MPa");
    group.bench_function("curve by the table", |b| {
        b.iter(|| stack.curve_in(&table, black_box(2e6)))
    });
    group.bench_function("curve by solves to 1e-6", |b| {
        b.iter(|| stack_curve(black_box(&stack), 2e6, [1e-2, 1e2], 1e-6))
    });
    let curve = stack.curve_in(&table, 2e6).expect("within the table");
    let contact = Contact::new(&stack.system(1e-3, 2e6), curve).expect("its curve");
    group.bench_function("load", |b| b.iter(|| contact.load(black_box(65e-6), 0.04)));
    group.finish();
}

criterion_group!(benches, solves, curves, sweeps, lookups);
criterion_main!(benches);
