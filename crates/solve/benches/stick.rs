//! Times of contacts with full friction, beside those without: a punch to 1e-10 and the curve of a
//! sphere to 1e-8, for an incompressible film on a base 1000 times as stiff.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use interp::Material;
use solve::solve;
use solve::stick::{StickCurves, Sticking};

fn stick(criterion: &mut Criterion) {
    let incompressible = Material::new(0.075, 0.5, 75.0, 0.25).expect("physical");
    let compressible = Material::new(0.075, 0.3, 75.0, 0.25).expect("physical");
    for a_over_t in [1.0, 10.0, 30.0] {
        for (name, material) in [("0.5", incompressible), ("0.3", compressible)] {
            let sticking = Sticking::on_film(&material, 0.5).expect("physical");
            criterion.bench_function(
                &format!("punch, stick, nu1 = {name}, a/t = {a_over_t}"),
                |b| {
                    b.iter(|| {
                        sticking
                            .punch(black_box(a_over_t), 1e-10)
                            .expect("converges")
                    });
                },
            );
            criterion.bench_function(
                &format!("contact, no friction, nu1 = {name}, a/t = {a_over_t}"),
                |b| b.iter(|| solve(black_box(a_over_t), &material, 1e-10).expect("converges")),
            );
        }
    }
    let sticking = Sticking::on_film(&incompressible, 0.5).expect("physical");
    for to in [1.0, 3.0, 10.0] {
        criterion.bench_function(&format!("curve, stick, a/t to {to}"), |b| {
            b.iter(|| {
                let curves = StickCurves::new(&sticking, [1e-3, black_box(to)], 1e-8);
                curves.expect("converges").receding(1.0).expect("a ratio")
            });
        });
    }
}

criterion_group!(benches, stick);
criterion_main!(benches);
