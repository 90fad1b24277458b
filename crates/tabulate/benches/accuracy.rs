//! The time of many solves: along a curve, and over the grid of a table. `tabulate cost solve`
//! measures single ones.

use std::hint::black_box;
use std::time::Instant;

use cost::clock::{human, median};
use interp::Material;
use solve::solve;
use tabulate::table::{Plan, Scene, sweep};

fn main() {
    along_curves();
    over_a_grid();
}

/// Prints the time of 60 solves along `a/t`, for four materials and two tolerances.
fn along_curves() {
    println!("\n60 a/t from 1e-3 to 1e3, one core\n\n| contact | 1e-8 | 1e-10 |\n|---|---|---|");
    let materials = [
        ("the paper's", [1.75, 0.5, 1e5]),
        ("a film softer than sphere and base", [0.1, 0.3, 10.0]),
        ("a film stiffer than sphere and base", [10.0, 0.3, 1.0]),
        ("a stiff film on a soft base", [1e2, 0.3, 1e-4]),
    ];
    for (name, [e1, nu1, e0]) in materials {
        let material = Material::new(e1, nu1, e0, 0.25).expect("physical");
        let cell = |tolerance| {
            let times = (0..21).map(|_| {
                let start = Instant::now();
                for i in 0..60 {
                    let _ = black_box(solve(
                        10_f64.powf(-3.0 + f64::from(i) / 59.0 * 6.0),
                        &material,
                        tolerance,
                    ));
                }
                start.elapsed().as_secs_f64()
            });
            format!(" {} |", human(median(times.collect())))
        };
        println!("| {name} |{}", [1e-8, 1e-10].map(cell).concat());
    }
}

/// Prints the time of the sweep of a table, which solves to a hundredth of its tolerance.
fn over_a_grid() {
    let text = "title = 'Benchmark'\ntolerance = 1e-6\nnu0 = 0.25\na_over_t = { from = 1e-3, to = 1e3, nodes = 60 }\n\
                e1_over_e2 = { from = 1e-3, to = 1e3, nodes = 20 }\nnu1 = { from = 0, to = 0.5, nodes = 12 }\n\
                e0_over_e2 = { from = 1, to = 1e6, nodes = 20 }\n";
    let scene = Scene::parse(text, None).expect("a sound scene");
    let axes = Plan::new(&scene).expect("the nodes are stated").axes();
    let start = Instant::now();
    let _ = black_box(sweep(&scene, &axes, &|_| ()).expect("within reach"));
    println!(
        "\n60 x 20 x 12 x 20 points solved to 1e-8 on all cores: {:.1} s",
        start.elapsed().as_secs_f64()
    );
}
