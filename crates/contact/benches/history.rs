//! Measures the time of histories with 1001 points, of approach and retract and of two cycles, and
//! prints their stated errors: `cargo bench -p coated-contact-contact --bench history`.

use std::hint::black_box;
use std::time::Instant;

use contact::{Contact, Control, Relaxation};
use interp::{Elastic, Probe, System, Table};

/// The number of runs, of which the fastest counts.
const RUNS: usize = 20;
const POINTS: u32 = 1001;

fn main() {
    let system = System {
        probe: Probe::Paraboloid { radius: 1e-5 },
        sphere_modulus: f64::INFINITY,
        film: Elastic::new(1e3, 0.5).expect("a solid"),
        film_thickness: 5e-6,
        substrate: Elastic::new(f64::INFINITY, 0.25).expect("a solid"),
    };
    let contact = Contact::in_table(Table::embedded(), &system).expect("in the table");
    let power = |exponent| Relaxation::PowerLaw {
        exponent,
        time: 1.0,
    };
    let three = vec![[0.4, 0.02], [0.3, 0.2], [0.15, 3.0]];
    let laws = [
        (
            "standard linear solid",
            Relaxation::Prony {
                relaxed: 0.3,
                terms: vec![[0.7, 0.6]],
            },
        ),
        (
            "three Prony terms",
            Relaxation::Prony {
                relaxed: 0.15,
                terms: three,
            },
        ),
        ("power law 0.1", power(0.1)),
        ("power law 0.3", power(0.3)),
        ("power law 0.5", power(0.5)),
    ];
    let once = |t: f64| 1e-6 * (1.0 - (t - 1.0).abs());
    let twice = |t: f64| 1e-6 * (1.0 - (t % 1.0 - 0.5).abs() * 2.2);
    println!("| law | program | tolerance | time | stated error |");
    println!("|---|---|---|---|---|");
    for (name, law) in &laws {
        let history = contact.history(law).expect("a law");
        for tolerance in [1e-4, 1e-6, 1e-8] {
            measure(name, "approach and retract", once, tolerance, &history);
        }
        for tolerance in [1e-4, 1e-5] {
            measure(name, "two cycles", twice, tolerance, &history);
        }
    }
}

/// Prints a row.
fn measure(
    name: &str,
    kind: &str,
    penetration: impl Fn(f64) -> f64,
    tolerance: f64,
    history: &contact::History<'_>,
) {
    let times = (0..POINTS).map(|i| 2.0 * f64::from(i) / f64::from(POINTS - 1));
    let program: Vec<(f64, f64)> = times.map(|t| (t, penetration(t))).collect();
    let mut fastest = f64::INFINITY;
    let mut stated = 0.0;
    for _ in 0..RUNS {
        let start = Instant::now();
        let course = history.run(Control::Displacement, black_box(&program), Some(tolerance));
        let course = match course {
            Ok(course) => course,
            Err(error) => {
                println!("| {name} | {kind} | {tolerance:e} | {error} | |");
                return;
            }
        };
        fastest = fastest.min(start.elapsed().as_secs_f64());
        stated = course.error;
        if fastest > 0.1 {
            break;
        }
    }
    println!(
        "| {name} | {kind} | {tolerance:.0e} | {:.2} ms | {stated:.1e} |",
        1e3 * fastest
    );
}
