use acceptance::{layer, solid, stack};
use std::time::Instant;
use tabulate::solve::*;
use tabulate::stack::*;
use tabulate::{solve, solve_stack, stack_curve};
fn time(mut f: impl FnMut()) -> f64 {
    let mut best = f64::INFINITY;
    for _ in 0..30 {
        let s = Instant::now();
        for _ in 0..20 {
            f()
        }
        best = best.min(s.elapsed().as_secs_f64() / 20.0);
    }
    best * 1e6
}
#[test]
fn timing() {
    let base = solid(1e5, 0.25);
    let film = interp::Material::new(1.75, 0.5, 1e5, 0.25).unwrap();
    for (name, st) in [
        (
            "film-like 3",
            stack(
                base,
                &[
                    layer(1.7, 0.5, 0.3),
                    layer(1.6, 0.5, 0.3),
                    layer(1.75, 0.5, 0.4),
                ],
            ),
        ),
        (
            "soft top",
            stack(
                base,
                &[
                    layer(17.0, 0.3, 0.3),
                    layer(16.0, 0.4, 0.3),
                    layer(1.75, 0.5, 0.4),
                ],
            ),
        ),
        (
            "sandwich",
            stack(
                base,
                &[
                    layer(1.0, 0.4, 0.3),
                    layer(0.02, 0.5, 0.3),
                    layer(5.0, 0.25, 0.4),
                ],
            ),
        ),
        (
            "stiff",
            stack(
                solid(0.02, 0.4),
                &[
                    layer(1.0, 0.4, 0.3),
                    layer(3.0, 0.3, 0.3),
                    layer(5.0, 0.25, 0.4),
                ],
            ),
        ),
    ] {
        let c = LayeredCompliance::new(&st);
        println!(
            "{name}: scale {:.2e}, setup {:.2} us",
            c.smallest_scale(),
            time(|| {
                std::hint::black_box(LayeredCompliance::new(&st));
            })
        );
        println!(
            "  sample 0.5 {:.1} ns, 3 {:.1} ns",
            1e3 * time(|| {
                std::hint::black_box(c.sample(std::hint::black_box(0.5)));
            }),
            1e3 * time(|| {
                std::hint::black_box(c.sample(std::hint::black_box(3.0)));
            })
        );
        let fc = Compliance::new(&film);
        println!(
            "  film sample 0.5 {:.1} ns, 3 {:.1} ns",
            1e3 * time(|| {
                std::hint::black_box(fc.sample(std::hint::black_box(0.5)));
            }),
            1e3 * time(|| {
                std::hint::black_box(fc.sample(std::hint::black_box(3.0)));
            })
        );
        for x in [0.1, 1.0, 10.0, 30.0] {
            let y = 0.4 * x; // film of equal a/h
            let f = time(|| {
                std::hint::black_box(solve(x, &film, 1e-10).unwrap());
            });
            let s = time(|| {
                std::hint::black_box(solve_stack(y, &st, 1.0, 1e-10).unwrap());
            });
            let m = [
                solve(x, &film, 1e-10).unwrap().modes,
                solve_stack(y, &st, 1.0, 1e-10).unwrap().modes,
            ];
            println!(
                "  a/h {x}: film {f:.1} us, stack {s:.1} us, ratio {:.2} modes {m:?} {:?}",
                s / f,
                solve(x, &film, 1e-10).unwrap().method
            );
        }
    }
    let graded = Stack::graded(solid(0.05, 0.4), 1.0, 200, |h| {
        solid(0.05 * 20_f64.powf(h), 0.4)
    })
    .unwrap();
    println!(
        "200: setup {:.1} us",
        time(|| {
            std::hint::black_box(LayeredCompliance::new(&graded));
        })
    );
    for to in [0.1, 0.3, 1.0, 3.0] {
        let s = Instant::now();
        for _ in 0..5 {
            stack_curve(&graded, 1.0, [1e-3, to], 1e-8).unwrap();
        }
        println!(
            "curve of 200 layers to {to}: {:.1} ms wall",
            s.elapsed().as_secs_f64() * 200.0
        );
    }
}
