//! Measures a new material under every shape of the probe, from the embedded table: its first load,
//! the states on a branch, and all derivatives. Only ratios within one run are meaningful: `cargo
//! bench -p coated-contact-contact --bench shapes`.

use std::hint::black_box;

use contact::{Branch, Contact, Control, State};
use criterion::{Criterion, criterion_group, criterion_main};
use interp::{Elastic, Probe, Profile, System, Table};

/// Work of adhesion, J/m^2.
const W: f64 = 1e-4;

/// Probes of some 10 um.
fn probes() -> Vec<(&'static str, Probe)> {
    let points = (0..30).map(|i| 1e-6 * f64::from(i));
    let points: Vec<[f64; 2]> = points
        .map(|r| [r, r * r / 2e-5 + r.powi(4) * 1e12])
        .collect();
    let half_angle = 1.2;
    let power_law = |exponent: f64| Probe::PowerLaw {
        coefficient: 1e6,
        exponent,
    };
    vec![
        ("paraboloid", Probe::Paraboloid { radius: 1e-5 }),
        ("sphere", Probe::Sphere { radius: 1e-5 }),
        ("cone", Probe::Cone { half_angle }),
        (
            "rounded cone",
            Probe::RoundedCone {
                radius: 1e-6,
                half_angle,
            },
        ),
        (
            "flat-ended cone",
            Probe::FlatEndedCone {
                radius: 1e-6,
                half_angle,
            },
        ),
        ("r^2.5", power_law(2.5)),
        ("r^3", power_law(3.0)),
        (
            "profile of 30 points",
            Probe::Profile(Profile::new(&points).expect("convex")),
        ),
    ]
}

fn shapes(criterion: &mut Criterion) {
    let table = Table::embedded();
    let penetrations: Vec<f64> = (0..300).map(|i| 1e-8 * f64::from(i)).collect();
    for (name, probe) in probes() {
        for (film, young, substrate) in [("soft film", 3e4, 7e10), ("stiff film", 7e10, 1e6)] {
            let system = System {
                probe: probe.clone(),
                sphere_modulus: f64::INFINITY,
                film: Elastic::new(young, 0.45).expect("physical"),
                film_thickness: 1e-6,
                substrate: Elastic::new(substrate, 0.25).expect("physical"),
            };
            let new = || Contact::in_table(table, black_box(&system)).expect("in the table");
            let a = 3.5e-6;
            criterion.bench_function(&format!("{name}, {film}: first load"), |b| {
                b.iter(|| new().load(a, W))
            });
            let contact = new();
            criterion.bench_function(&format!("{name}, {film}: load"), |b| {
                b.iter(|| contact.load(black_box(a), W))
            });
            let mut states = [State::ORIGIN; 300];
            criterion.bench_function(&format!("{name}, {film}: 300 states of a new one"), |b| {
                b.iter(|| {
                    let contact = new();
                    let equilibria = contact.equilibria(W, Control::Displacement)?;
                    equilibria.branch(&penetrations, Branch::Unloading, &mut states)
                })
            });
            criterion.bench_function(&format!("{name}, {film}: first derivatives"), |b| {
                b.iter(|| {
                    let contact = Contact::in_table_with_gradient(table, black_box(&system));
                    contact.expect("in the table").gradient(a, W)
                })
            });
        }
    }
}

criterion_group!(benches, shapes);
criterion_main!(benches);
