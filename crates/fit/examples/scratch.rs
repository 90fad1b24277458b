use contact::Relaxation;
use fit::*;
use interp::{Elastic, Probe, System, Table};
use std::time::Instant;

fn system(t: f64) -> System {
    System {
        probe: Probe::Paraboloid { radius: 5e-6 },
        sphere_modulus: f64::INFINITY,
        film: Elastic::new(2e3, 0.5).unwrap(),
        film_thickness: t,
        substrate: Elastic::new(f64::INFINITY, 0.25).unwrap(),
    }
}

fn planned(kind: Kind, n: usize, law: Relaxation, hold: f64) -> Experiment {
    let sense = if kind == Kind::ForceHeight { -1.0 } else { 1.0 };
    let top = 1e-6;
    let total = 2.0 + hold;
    let times: Vec<f64> = (0..n).map(|i| total * i as f64 / (n - 1) as f64).collect();
    let value = |t: f64| {
        if t < 1.0 {
            top * (1.2 * t - 0.2)
        } else if t < 1.0 + hold {
            top
        } else {
            top * (1.0 - 1.2 * (t - 1.0 - hold))
        }
    };
    let points = times
        .iter()
        .enumerate()
        .map(|(i, &t)| Point {
            line: i as u64 + 1,
            abscissa: 3e-7 + sense * value(t),
            ordinate: 0.0,
            direction: Some(if t <= 1.0 + hold {
                Direction::Approach
            } else {
                Direction::Retract
            }),
        })
        .collect();
    let mut e = Experiment::new(
        Measurement {
            name: "gel".into(),
            kind,
            points,
        },
        Bodies::Coated(system(3e-6)),
    );
    e.times = times;
    e.contact_point = 3e-7;
    e.stiffness = Some(0.02);
    e.relaxing = Some(Relaxing::new(law));
    e
}

fn main() {
    let n: usize = std::env::args().nth(1).map_or(400, |x| x.parse().unwrap());
    let sets: u64 = std::env::args().nth(2).map_or(3, |x| x.parse().unwrap());
    use Parameter::*;
    let pl = Relaxation::PowerLaw {
        exponent: 0.2,
        time: 1.0,
    };
    let sls = Relaxation::Prony {
        relaxed: 0.3,
        terms: vec![[0.7, 0.3]],
    };
    let two = Relaxation::Prony {
        relaxed: 0.2,
        terms: vec![[0.5, 0.05], [0.3, 0.8]],
    };
    let modi = Relaxation::ModifiedPowerLaw {
        relaxed: 0.0,
        exponent: 0.4,
        time: 0.05,
    };
    let fz = Relaxation::FractionalZener {
        relaxed: 0.2,
        exponent: 0.6,
        time: 0.2,
    };
    let kinds = [
        (
            "power",
            planned(Kind::LoadPenetration, n, pl.clone(), 0.0),
            vec![FilmModulus, RelaxationExponent, ContactPoint],
        ),
        (
            "power height",
            planned(Kind::ForceHeight, n, pl, 0.0),
            vec![FilmModulus, RelaxationExponent, ContactPoint, Baseline],
        ),
        (
            "sls",
            planned(Kind::LoadPenetration, n, sls.clone(), 0.0),
            vec![
                FilmModulus,
                RelaxedFraction,
                RelaxationTime(1),
                ContactPoint,
            ],
        ),
        (
            "sls hold height",
            planned(Kind::ForceHeight, n, sls, 1.0),
            vec![
                FilmModulus,
                RelaxedFraction,
                RelaxationTime(1),
                ContactPoint,
                Baseline,
            ],
        ),
        (
            "prony 2",
            planned(Kind::LoadPenetration, n, two, 2.0),
            vec![
                FilmModulus,
                RelaxedFraction,
                RelaxationTime(1),
                RelaxationTime(2),
                RelaxationWeight(2),
                ContactPoint,
            ],
        ),
        (
            "modified",
            planned(Kind::LoadPenetration, n, modi, 1.0),
            vec![
                FilmModulus,
                RelaxationExponent,
                RelaxationTime(1),
                ContactPoint,
            ],
        ),
        (
            "zener",
            planned(Kind::LoadPenetration, n, fz, 2.0),
            vec![
                FilmModulus,
                RelaxedFraction,
                RelaxationExponent,
                RelaxationTime(1),
                ContactPoint,
            ],
        ),
    ];
    let only = std::env::args().nth(3);
    for (name, plan, free) in kinds
        .into_iter()
        .filter(|k| only.as_ref().is_none_or(|o| k.0 == o))
    {
        let free: Vec<Free> = free.into_iter().map(Free::new).collect();
        let exact = simulate(Table::embedded(), &plan, 0.0, 0).unwrap();
        let peak = exact.points.iter().map(|p| p.ordinate).fold(0.0, f64::max);
        println!(
            "== {name} peak {peak:.2e} last {:.2e}",
            exact.points.last().unwrap().ordinate
        );
        for seed in 0..sets {
            let mut e = plan.clone();
            e.measurement = simulate(Table::embedded(), &plan, 0.01 * peak, seed).unwrap();
            e.contact_point = 0.0;
            e.noise = Some(0.01 * peak);
            let start = Instant::now();
            match fit(Table::embedded(), &[e], &free, &Options::default()) {
                Err(error) => println!("ERROR {error}"),
                Ok(found) => {
                    let ms = start.elapsed().as_secs_f64() * 1e3;
                    print!(
                        "{ms:.1} ms conv {} evals {} chi2r {:.2}:",
                        found.converged,
                        found.evaluations,
                        found.reduced_chi_squared.unwrap()
                    );
                    for est in &found.estimates {
                        let truth = plan.get(est.parameter).unwrap();
                        print!(
                            " {} {:.3}({:.1}% {:+.1}s)",
                            est.parameter,
                            est.value,
                            100.0 * est.standard_error / truth.abs().max(1e-30),
                            (est.value - truth) / est.standard_error
                        );
                    }
                    println!();
                    if seed == 0 {
                        for w in &found.warnings {
                            println!("   W {} {}", w.kind.name(), w.text);
                        }
                        println!("   {:?}", found.experiments[0].relaxation);
                    }
                }
            }
        }
    }
}
