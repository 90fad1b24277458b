//! The time of a state and of a pull-off with an attraction of finite range, for the paper's film.
//! Compare times within one run only.

use std::hint::black_box;

use contact::Control;
use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use interp::{Elastic, Probe, System};
use solve::cohesive::Cohesive;

/// The sphere of 100 times the thickness of the paper's film, with the range of the attraction that
/// gives it Dugdale's `lambda`.
fn paper(lambda: f64) -> Cohesive {
    let system = System {
        probe: Probe::Paraboloid { radius: 1e-4 },
        sphere_modulus: 1e6,
        film: Elastic::new(1.75e6, 0.5).expect("physical"),
        film_thickness: 1e-6,
        substrate: Elastic::new(1e11, 0.25).expect("physical"),
    };
    // 2 (w/h0) (R/(pi w K^2))^(1/3) = lambda with K = 4/3 Es*, Es* = 0.7 MPa.
    let (w, k) = (2e-3, 0.7e6 / 0.75);
    let range = 2.0 * w / lambda * (1e-4 / (std::f64::consts::PI * w * k * k)).cbrt();
    Cohesive::new(&system, None, w, range).expect("physical")
}

fn states(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("state at a/t = 4");
    for lambda in [0.5, 3.0, 10.0] {
        let cohesive = paper(lambda);
        group.bench_function(BenchmarkId::from_parameter(lambda), |b| {
            b.iter(|| cohesive.state(black_box(4e-6)))
        });
    }
    group.finish();
}

fn pull_offs(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("pull-off under a load");
    for lambda in [0.5, 3.0, 10.0] {
        let cohesive = paper(lambda);
        group.bench_function(BenchmarkId::from_parameter(lambda), |b| {
            b.iter(|| black_box(&cohesive).pull_off(Control::Load))
        });
    }
    group.finish();
}

criterion_group!(benches, states, pull_offs);
criterion_main!(benches);
