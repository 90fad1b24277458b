//! Experiments with random bodies, kinds, free parameters, courses and noise, made by the model
//! itself.

use std::f64::consts::PI;

use acceptance::{Contacts, system_of};
use contact::{Contact, Control};
use fit::Kind::{ForceHeight, LoadPenetration, LoadRadius, PenetrationRadius};
use fit::{Bodies, Direction, Experiment, Free, Parameter, Point, simulate};
use interp::{Elastic, Probe, Table};

use crate::imagined::measurement;

/// A random experiment.
pub struct Drawn {
    /// The experiment with its measured points and false values of its free parameters.
    pub experiment: Experiment,
    /// The same with the true values.
    pub truth: Experiment,
    pub free: Vec<Free>,
}

impl Drawn {
    /// Draws the experiment that belongs to a seed.
    pub fn new(seed: u64) -> Self {
        let mut random = Contacts::new(seed);
        loop {
            if let Some(drawn) = draw(&mut random, seed) {
                return drawn;
            }
        }
    }
}

/// Draws an experiment; `None` if it is outside the table or has nothing to be found.
fn draw(random: &mut Contacts, seed: u64) -> Option<Drawn> {
    // Those with contacts of a sphere; a contact stiffness has data sets of its own.
    let kinds = [LoadRadius, PenetrationRadius, LoadPenetration, ForceHeight];
    let kind = *pick(random, &kinds);
    let at_radii = matches!(kind, LoadRadius | PenetrationRadius);
    let rigid = random.uniform(0.0, 1.0) < 0.5;
    let film = random.log_uniform(1e3, 1e11);
    let radius = random.log_uniform(5e-6, 5e-3);
    let largest = radius * random.log_uniform(5e-3, 0.25);
    let system = system_of(
        Probe::Paraboloid { radius },
        if rigid {
            f64::INFINITY
        } else {
            film * random.log_uniform(1e-2, 1e3)
        },
        Elastic::new(film, random.uniform(0.2, 0.5)).ok()?,
        largest / random.log_uniform(0.05, 30.0),
        Elastic::new(film * random.log_uniform(1e-2, 1e5), 0.25).ok()?,
    );
    let bodies = Bodies::coated(&system);
    let contact = Contact::in_table(Table::embedded(), &system).ok()?;
    let hertz = contact.load(largest, 0.0).ok()?;
    let adhesive = kind == PenetrationRadius || random.uniform(0.0, 1.0) < 0.75;
    let w = if adhesive {
        hertz * random.log_uniform(3e-3, 0.3) / (1.5 * PI * radius)
    } else {
        0.0
    };
    let (load, penetration) = contact.load_and_penetration(largest, w).ok()?;
    let stiffness = load.abs() / penetration.abs() * random.log_uniform(0.1, 10.0);
    let mut truth = Experiment::new(measurement(kind, Vec::new()), bodies);
    truth.work_of_adhesion = w;
    if kind == ForceHeight {
        truth.stiffness = Some(stiffness);
    }
    // Where the largest contact and the last one are.
    let [most, least] = if at_radii {
        [largest, largest * random.uniform(0.1, 0.6)]
    } else {
        let spring = truth.stiffness.unwrap_or(f64::INFINITY);
        let control = match truth.stiffness {
            Some(stiffness) => Control::Spring { stiffness },
            None => Control::Displacement,
        };
        let most = penetration + load / spring;
        let least = if w > 0.0 {
            let end = contact.equilibria(w, control).ok()?.pull_off().ok()?;
            end.penetration + end.load / spring
        } else {
            0.0
        };
        if most <= 0.0 {
            return None;
        }
        [most, least - random.uniform(0.1, 0.6) * (most - least)]
    };
    let count = random.log_uniform(12.0, 200.0) as usize;
    let [approach, retract] = Direction::ALL.map(Some);
    let ways = [vec![approach], vec![retract], vec![approach, retract]];
    let directions = if at_radii {
        vec![None]
    } else {
        pick(random, &ways).clone()
    };
    let free = frees(random, &truth, count)?;
    let is_free = |parameter| free.contains(&parameter);
    // Zeros that are free are not zero.
    let [ordinates, of_touch] = match kind {
        PenetrationRadius => [penetration.abs(); 2],
        _ => [load.abs().max(1.5 * PI * w * radius), most - least],
    };
    for (parameter, unit) in [
        (Parameter::LoadOffset, ordinates),
        (Parameter::Baseline, ordinates),
        (Parameter::ContactPoint, of_touch),
    ] {
        if is_free(parameter) {
            let value = unit * random.uniform(-0.3, 0.3);
            truth.set(parameter, value).ok()?;
        }
    }
    for direction in directions {
        for i in 0..count {
            let imposed = most + (least - most) * i as f64 / (count - 1) as f64;
            let abscissa = match kind {
                ForceHeight => truth.contact_point - imposed,
                LoadPenetration => truth.contact_point + imposed,
                _ => imposed,
            };
            truth.measurement.points.push(Point {
                line: truth.measurement.points.len() as u64 + 2,
                abscissa,
                ordinate: 0.0,
                direction,
            });
        }
    }
    let noise = ordinates * random.log_uniform(1e-4, 5e-2);
    let mut truth = simulate(Table::embedded(), &truth, noise, seed).ok()?;
    truth.noise = (random.uniform(0.0, 1.0) < 0.5).then_some(noise);
    let mut experiment = truth.clone();
    for &parameter in &free {
        let value = truth.get(parameter)?;
        let start = if parameter.is_positive() {
            value * random.log_uniform(0.3, 3.0)
        } else {
            0.0
        };
        experiment.set(parameter, start).ok()?;
    }
    Some(Drawn {
        experiment,
        truth,
        free: free.into_iter().map(Free::new).collect(),
    })
}

/// Draws the free parameters.
fn frees(random: &mut Contacts, truth: &Experiment, count: usize) -> Option<Vec<Parameter>> {
    use Parameter::{
        Baseline, ContactPoint, FilmModulus, FilmThickness, LoadOffset, SphereModulus,
        WorkOfAdhesion,
    };
    let kind = truth.measurement.kind;
    let is_soft = truth.get(SphereModulus) != Some(f64::INFINITY);
    let of_radii = kind == LoadRadius;
    let has_baseline = matches!(kind, LoadPenetration | ForceHeight);
    let choices = [
        (SphereModulus, is_soft, 0.5),
        (FilmModulus, true, if is_soft { 0.5 } else { 0.8 }),
        (FilmThickness, true, 0.25),
        (WorkOfAdhesion, truth.work_of_adhesion > 0.0, 0.7),
        (LoadOffset, of_radii, 0.4),
        (ContactPoint, !of_radii, 0.6),
        (Baseline, has_baseline, 0.5),
    ];
    let chosen = choices
        .into_iter()
        .filter_map(|(parameter, is_possible, chance)| {
            (random.uniform(0.0, 1.0) < chance && is_possible).then_some(parameter)
        });
    let chosen: Vec<Parameter> = chosen.collect();
    (!chosen.is_empty() && 3 * chosen.len() <= count).then_some(chosen)
}

fn pick<'a, T>(random: &mut Contacts, all: &'a [T]) -> &'a T {
    &all[random.uniform(0.0, all.len() as f64) as usize]
}
