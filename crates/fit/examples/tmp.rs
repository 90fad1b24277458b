use fit::*;
use interp::*;
use std::time::Instant;

fn solid(y: f64, n: f64) -> Elastic {
    Elastic::new(y, n).unwrap()
}
struct Case {
    name: &'static str,
    truth: Experiment,
    noise: f64,
    free: Vec<Free>,
    outliers: f64,
    loss: Loss,
    give: bool,
}

fn pts(kind: Kind, list: Vec<(f64, Option<Direction>)>) -> Measurement {
    Measurement {
        name: "test".into(),
        kind,
        points: list
            .into_iter()
            .enumerate()
            .map(|(i, (x, d))| Point {
                line: i as u64 + 1,
                abscissa: x,
                ordinate: 0.0,
                direction: d,
            })
            .collect(),
    }
}
fn lin(from: f64, to: f64, n: usize, d: Option<Direction>) -> Vec<(f64, Option<Direction>)> {
    (0..n)
        .map(|i| (from + (to - from) * i as f64 / (n - 1) as f64, d))
        .collect()
}
fn main() {
    let only: Option<String> = std::env::args().nth(1);
    let table = Table::embedded();
    let paper = |t: f64| System {
        sphere_radius: 1e-3,
        sphere_modulus: 2e6,
        film: solid(3.5e6, 0.5),
        film_thickness: t,
        substrate: solid(2e11, 0.25),
    };
    // colloidal probe: rigid sphere 10 um on a gel of 20 kPa, 5 um thick, on glass
    let gel = System {
        sphere_radius: 10e-6,
        sphere_modulus: f64::INFINITY,
        film: solid(2e4, 0.45),
        film_thickness: 5e-6,
        substrate: solid(7e10, 0.2),
    };
    let f = Free::new;
    let both = |from: f64, to: f64, n| {
        let mut v = lin(from, to, n, Some(Direction::Approach));
        v.extend(lin(to, from, n, Some(Direction::Retract)));
        v
    };
    let mut cases = Vec::new();
    let mut add =
        |name, bodies, m, w, noise: f64, free: Vec<Free>, edit: &dyn Fn(&mut Experiment)| {
            let mut e = Experiment::new(m, bodies);
            e.work_of_adhesion = w;
            edit(&mut e);
            cases.push(Case {
                name,
                truth: e,
                noise,
                free,
                outliers: 0.0,
                loss: Loss::Squares,
                give: true,
            });
        };
    use Parameter::*;
    let lr = |n| pts(Kind::LoadRadius, lin(42e-6, 131e-6, n, None));
    add(
        "LR 10um",
        Bodies::Coated(paper(1e-5)),
        lr(40),
        0.04,
        5e-6,
        vec![f(SphereModulus), f(WorkOfAdhesion)],
        &|_| (),
    );
    add(
        "LR 10um offset",
        Bodies::Coated(paper(1e-5)),
        lr(300),
        0.04,
        5e-6,
        vec![f(SphereModulus), f(WorkOfAdhesion), f(LoadOffset)],
        &|e| e.load_offset = 2e-5,
    );
    add(
        "LR 100um film",
        Bodies::Coated(paper(1e-4)),
        lr(40),
        0.04,
        5e-7,
        vec![f(SphereModulus), f(WorkOfAdhesion), f(FilmModulus)],
        &|_| (),
    );
    add(
        "LR hysteresis",
        Bodies::Coated(paper(1e-5)),
        pts(Kind::LoadRadius, both(50e-6, 131e-6, 30)),
        0.03,
        5e-6,
        vec![
            f(SphereModulus),
            f(WorkOfAdhesion),
            f(WorkOfAdhesionReceding),
        ],
        &|e| e.work_of_adhesion_receding = Some(0.06),
    );
    add(
        "PR ",
        Bodies::Coated(paper(1e-4)),
        pts(Kind::PenetrationRadius, lin(42e-6, 131e-6, 60, None)),
        0.04,
        2e-8,
        vec![f(WorkOfAdhesion), f(FilmModulus), f(ContactPoint)],
        &|e| e.contact_point = 3e-7,
    );
    add(
        "LP 10um",
        Bodies::Coated(paper(1e-5)),
        pts(Kind::LoadPenetration, lin(-1e-6, 5e-6, 60, None)),
        0.04,
        3e-6,
        vec![f(SphereModulus), f(WorkOfAdhesion), f(ContactPoint)],
        &|e| e.contact_point = 0.0,
    );
    add(
        "LP retract jump",
        Bodies::Coated(paper(1e-5)),
        pts(
            Kind::LoadPenetration,
            lin(5e-6, -3e-6, 100, Some(Direction::Retract)),
        ),
        0.04,
        3e-6,
        vec![
            f(SphereModulus),
            f(WorkOfAdhesion),
            f(ContactPoint),
            f(LoadOffset),
        ],
        &|e| {
            e.contact_point = 2e-7;
            e.load_offset = 1e-5;
        },
    );
    let fh = |k: f64| {
        move |e: &mut Experiment| {
            e.stiffness = Some(k);
            e.contact_point = 1e-6;
            e.baseline = 1e-9;
        }
    };
    add(
        "LP lownoise",
        Bodies::Coated(paper(1e-5)),
        pts(
            Kind::LoadPenetration,
            lin(5e-6, -3e-6, 100, Some(Direction::Retract)),
        ),
        0.04,
        1e-6,
        vec![
            f(SphereModulus),
            f(WorkOfAdhesion),
            f(ContactPoint),
            f(LoadOffset),
        ],
        &|e| {
            e.contact_point = 2e-7;
            e.load_offset = 1e-5;
        },
    );
    add(
        "FH gel",
        Bodies::Coated(gel),
        pts(
            Kind::ForceHeight,
            lin(-1.5e-6, 2e-6, 300, Some(Direction::Retract)),
        ),
        1e-3,
        2e-10,
        vec![
            f(FilmModulus),
            f(WorkOfAdhesion),
            f(ContactPoint),
            f(Baseline),
        ],
        &fh(0.2),
    );
    add(
        "FH gel 3p",
        Bodies::Coated(gel),
        pts(
            Kind::ForceHeight,
            lin(-1.5e-6, 2e-6, 300, Some(Direction::Retract)),
        ),
        1e-3,
        2e-10,
        vec![f(FilmModulus), f(WorkOfAdhesion), f(ContactPoint)],
        &|e| {
            e.stiffness = Some(0.2);
            e.contact_point = 1e-6;
        },
    );
    add(
        "FH gel cycle",
        Bodies::Coated(gel),
        pts(Kind::ForceHeight, both(2e-6, -1.5e-6, 150)),
        0.5e-3,
        2e-10,
        vec![
            f(FilmModulus),
            f(WorkOfAdhesion),
            f(WorkOfAdhesionReceding),
            f(ContactPoint),
            f(Baseline),
            f(BaselineSlope),
        ],
        &|e| {
            fh(0.2)(e);
            e.work_of_adhesion_receding = Some(2e-3);
            e.baseline_slope = 1e-4;
        },
    );
    add(
        "FH Hertz approach",
        Bodies::Coated(gel),
        pts(
            Kind::ForceHeight,
            lin(2e-6, -1.5e-6, 200, Some(Direction::Approach)),
        ),
        0.0,
        2e-10,
        vec![f(FilmModulus), f(ContactPoint), f(Baseline)],
        &fh(0.2),
    );
    let half = Bodies::HalfSpace(HalfSpace {
        sphere_radius: 10e-6,
        sphere_modulus: f64::INFINITY,
        solid: solid(1e4, 0.5),
    });
    add(
        "FH half space",
        half,
        pts(
            Kind::ForceHeight,
            lin(2e-6, -1.5e-6, 200, Some(Direction::Approach)),
        ),
        0.0,
        2e-10,
        vec![f(FilmModulus), f(ContactPoint), f(Baseline)],
        &fh(0.2),
    );
    add(
        "FH thickness",
        Bodies::Coated(gel),
        pts(
            Kind::ForceHeight,
            lin(-2.5e-6, 2e-6, 300, Some(Direction::Retract)),
        ),
        1e-3,
        1e-10,
        vec![
            f(FilmModulus),
            f(FilmThickness),
            f(WorkOfAdhesion),
            f(ContactPoint),
        ],
        &fh(0.2),
    );
    let n = cases.len();
    for (name, i) in [("LR 10um", 0), ("FH gel", 7)] {
        let _ = name;
        let c = &cases[if i == 7 { 8 } else { i }];
        let mut d = Case {
            name: "robust",
            truth: c.truth.clone(),
            noise: c.noise,
            free: c.free.clone(),
            outliers: 0.05,
            loss: Loss::HUBER,
            give: true,
        };
        if i == 0 {
            d.truth.measurement = lr(100);
        }
        cases.push(d);
    }
    let _ = n;
    {
        let c = &cases[1];
        let d = Case {
            name: "noise estimated",
            truth: c.truth.clone(),
            noise: c.noise,
            free: c.free.clone(),
            outliers: 0.0,
            loss: Loss::Squares,
            give: false,
        };
        cases.push(d);
    }
    for case in &cases {
        if let Some(only) = &only {
            if !case.name.contains(only.as_str()) {
                continue;
            }
        }
        let mut covered = vec![[0; 2]; case.free.len()];
        let mut warned = std::collections::BTreeMap::new();
        let mut failed = 0;
        let mut time = 0.0;
        let mut evals = 0;
        let mut rel = vec![0.0; case.free.len()];
        let mut bias = vec![0.0; case.free.len()];
        let count = std::env::args().nth(2).map_or(200, |s| s.parse().unwrap());
        for seed in 0..count {
            let mut e = case.truth.clone();
            e.measurement = simulate(table, &case.truth, case.noise, seed).expect("simulate");
            if case.outliers > 0.0 {
                for (i, p) in e.measurement.points.iter_mut().enumerate() {
                    if (i as u64 * 7919 + seed * 104729) % 20 == 0 {
                        p.ordinate += case.noise
                            * 15.0
                            * if (i + seed as usize) % 2 == 0 {
                                1.0
                            } else {
                                -1.0
                            };
                    }
                }
            }
            e.noise = case.give.then_some(case.noise);
            let start = Instant::now();
            let found = fit::fit(
                table,
                &[e],
                &case.free,
                &Options {
                    loss: case.loss,
                    ..Options::default()
                },
            );
            time += start.elapsed().as_secs_f64();
            let found = match found {
                Ok(f) => f,
                Err(e) => {
                    println!("{e}");
                    failed += 1;
                    continue;
                }
            };
            if !found.converged {
                failed += 1;
            }
            evals += found.evaluations;
            for w in &found.warnings {
                if !(case.outliers > 0.0 && w.kind == WarningKind::Outliers) {
                    warned.entry(w.kind.name()).or_insert((0, w.text.clone())).0 += 1;
                }
            }
            for (i, est) in found.estimates.iter().enumerate() {
                let truth = case.truth.get(est.parameter).unwrap();
                for (z, c) in [1.0, 1.96].into_iter().zip(&mut covered[i]) {
                    let [l, h] = est.interval(z);
                    if (l..=h).contains(&truth) {
                        *c += 1;
                    }
                }
                rel[i] += est.standard_error / truth.abs() / count as f64;
                bias[i] += (est.value - truth) / est.standard_error / count as f64;
            }
        }
        println!(
            "{}: {:.2} ms, {:.1} evaluations, failed {failed}",
            case.name,
            time / count as f64 * 1e3,
            evals as f64 / count as f64
        );
        for (i, f) in case.free.iter().enumerate() {
            println!(
                "    {:<28} {:.1e} {:?} bias {:+.2}",
                f.parameter.name(),
                rel[i],
                covered[i],
                bias[i]
            );
        }
        for (k, (n, t)) in warned {
            println!("    WARN {k} {n}: {t}");
        }
    }
}
