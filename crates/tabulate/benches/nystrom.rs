//! Our solver against Nystrom's method for its equation in numpy and scipy (`nystrom.py`), in one
//! run and on one thread.
//!
//! Prints a table of errors and times. An error is the largest of the four relative deviations from
//! our solution at the tightest tolerance that converges. The Python program is given the smallest
//! sizes with which it keeps the tolerance, found with the help of that solution. Our solver
//! chooses its sizes itself and estimates its error. With `--small`, which tests the comparison, it
//! has two values of a/t and one round.

mod python;

use std::iter::successors;

use cost::clock::{self, human, median};
use cost::deviation::{deviation, tightest};
use interp::{Material, Quantities};
use python::Python;
use serde::Deserialize;
use serde_json::json;
use solve::solve;

const A_OVER_T: [f64; 6] = [0.01, 1.0, 10.0, 30.0, 100.0, 300.0];
const TOLERANCES: [f64; 2] = [1e-6, 1e-10];
/// The number of times that both are measured in turn, so that a machine that slows down does so
/// for both.
const ROUNDS: usize = 7;
/// The seconds spent on measuring one time of our solver.
const BUDGET: f64 = 0.01;

fn main() {
    let Some(mut python) = Python::start("nystrom.py") else {
        println!(
            "nystrom: skipped, as it needs python3 with numpy and scipy; `cargo xtask compare` fetches them"
        );
        return;
    };
    let material = Material::new(1.75, 0.5, 1e5, 0.25).expect("physical");
    println!("{}\n", python.versions);
    println!(
        "| a/t | tolerance | solve | error | numpy | error | nodes in s, panels in q | ratio |"
    );
    println!("|---|---|---|---|---|---|---|---|");
    let (a_over_t, rounds) = if python::is_small() {
        (&A_OVER_T[..2], 1)
    } else {
        (&A_OVER_T[..], ROUNDS)
    };
    for &x in a_over_t {
        let truth = tightest(x, &material).expect("it converges").quantities;
        for tolerance in TOLERANCES {
            let error = |quantities: &Quantities| deviation(quantities, &truth);
            let own = solve(x, &material, tolerance)
                .expect("the truth converged")
                .quantities;
            let reached = error(&own).max(ROUNDING);
            let sizes = Sizes::smallest(x, |sizes| {
                error(&ask(&mut python, x, &material, sizes, 0).quantities) <= reached
            });
            let theirs = ask(&mut python, x, &material, sizes, 0).quantities;
            let repetitions = if x > 30.0 { 5 } else { 101 };
            let round = |_| {
                let theirs = ask(&mut python, x, &material, sizes, repetitions).seconds;
                (
                    clock::seconds(BUDGET, || solve(x, &material, tolerance)),
                    median(theirs),
                )
            };
            let (own_seconds, their_seconds): (Vec<f64>, Vec<f64>) = (0..rounds).map(round).unzip();
            let (own_seconds, their_seconds) = (median(own_seconds), median(their_seconds));
            println!(
                "| {x} | {tolerance:e} | {} | {:.0e} | {} | {:.0e} | {}, {} | {:.0} |",
                human(own_seconds),
                error(&own),
                human(their_seconds),
                error(&theirs),
                sizes.nodes,
                sizes.panels,
                their_seconds / own_seconds
            );
        }
    }
    python.stop();
}

/// The smallest error that either method is asked for.
const ROUNDING: f64 = 1e-13;

/// The sizes that set the accuracy of Nystrom's method.
#[derive(Clone, Copy)]
struct Sizes {
    /// Nodes in `s`.
    nodes: usize,
    /// Panels in `q`.
    panels: usize,
    /// Where the integral over `q` ends.
    cutoff: usize,
}

impl Sizes {
    /// Returns sizes that are each as small as `enough` accepts, reduced one after the other.
    ///
    /// The search begins with nodes in proportion to `x`, for a kernel of width `1/x`, and with
    /// panels in proportion to `x`, for its oscillation.
    fn smallest(x: f64, mut enough: impl FnMut(Self) -> bool) -> Self {
        let ample = Self {
            nodes: 40 + (6.0 * x) as usize,
            panels: 16 + (4.0 * x) as usize,
            cutoff: 20,
        };
        let mut sizes = ample;
        sizes.nodes = smallest(ample.nodes, |nodes| enough(Self { nodes, ..sizes }));
        sizes.cutoff = smallest(ample.cutoff, |cutoff| enough(Self { cutoff, ..sizes }));
        sizes.panels = smallest(ample.panels, |panels| enough(Self { panels, ..sizes }));
        sizes
    }
}

/// Returns the first that `enough` accepts of numbers that grow by a tenth; `ample` where it
/// accepts none.
fn smallest(ample: usize, mut enough: impl FnMut(usize) -> bool) -> usize {
    let numbers = successors(Some(1), |n: &usize| Some(n + n.div_ceil(10)));
    numbers
        .take_while(|&n| n < ample)
        .find(|&n| enough(n))
        .unwrap_or(ample)
}

/// The output of `nystrom.py` for one contact.
#[derive(Deserialize)]
struct Reply {
    quantities: Quantities,
    /// The times of the repetitions.
    seconds: Vec<f64>,
}

/// Solves a contact with `nystrom.py`.
fn ask(
    python: &mut Python,
    x: f64,
    material: &Material,
    sizes: Sizes,
    repetitions: usize,
) -> Reply {
    python.ask(&json!({
        "a_over_t": x,
        "e1_over_e2": material.e1_over_e2(),
        "nu1": material.nu1(),
        "e0_over_e2": material.e0_over_e2(),
        "nu0": material.nu0(),
        "nodes": sizes.nodes,
        "panels": sizes.panels,
        "cutoff": sizes.cutoff,
        "repetitions": repetitions,
    }))
}
