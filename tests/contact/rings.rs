//! Contacts under shapes by rings of constant pressure and complementarity: no transform of the
//! shape, no field of a punch, only the compliance of film and substrate.

use std::f64::consts::PI;

use acceptance::{looked_up, rigid_probe, solid};
use contact::Control;
use interp::{Probe, System};
use solve::{Compliance, SurfaceCompliance};

/// The number of rings, and the radius where the last one ends.
const RINGS: usize = 160;
const LARGEST_RADIUS: f64 = 1.15;
/// The number of wave numbers, and the largest `k t`. `X - 1` is below 1e-9 beyond.
const WAVES: usize = 1200;
const LARGEST: f64 = 14.0;

/// Bessel's functions `J0` and `J1`, by the trapezoidal rule on their integrals over a period.
fn bessel(x: f64) -> [f64; 2] {
    let count = 24 + x as usize;
    let angles = (0..count).map(|i| PI * (i as f64 + 0.5) / count as f64);
    let (j0, j1) = angles.fold((0.0, 0.0), |(j0, j1), angle| {
        let phase = x * angle.sin();
        (j0 + phase.cos(), j1 + (angle - phase).cos())
    });
    [j0 / count as f64, j1 / count as f64]
}

/// The complete elliptic integrals `K` and `E` of the modulus `k`, by the arithmetic-geometric mean.
fn elliptic(k: f64) -> [f64; 2] {
    let (mut a, mut b, mut sum, mut power) = (1.0, (1.0 - k * k).sqrt(), 0.5 * k * k, 1.0);
    // The mean converges quadratically; ten steps leave rounding.
    for _ in 0..10 {
        let c = 0.5 * (a - b);
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
        sum += power * c * c;
        power *= 2.0;
    }
    let first = 0.5 * PI / a;
    [first, first * (1.0 - sum)]
}

/// The displacement at `r` of a half-space of modulus 1 under a pressure of 1 on a disc (Johnson,
/// *Contact Mechanics*, 3.4).
fn under_disc(radius: f64, r: f64) -> f64 {
    4.0 / PI
        * if r <= radius {
            radius * elliptic(r / radius)[1]
        } else {
            let ratio = radius / r;
            let [first, second] = elliptic(ratio);
            r * (second - (1.0 - ratio * ratio) * first)
        }
}

/// Returns the radii where the rings end, with that of the centre, and their middles.
fn radii() -> [Vec<f64>; 2] {
    let step = LARGEST_RADIUS / RINGS as f64;
    [
        (0..=RINGS).map(|i| step * i as f64).collect(),
        (0..RINGS).map(|i| step * (i as f64 + 0.5)).collect(),
    ]
}

/// Returns, at `[i][r]`, the displacement at the middle of the ring `r` under a pressure of the film's reduced modulus on
/// the disc of the first `i` rings.
fn displacements(system: &System) -> Vec<Vec<f64>> {
    let compliance = Compliance::new(&system.material().expect("physical"));
    let t = system.film_thickness;
    let [ends, middles] = radii();
    // The film adds `2 (X - 1)` times the transform of the pressure, by Simpson's rule.
    let waves: Vec<(f64, f64)> = (1..=WAVES)
        .map(|i| {
            let q = LARGEST * i as f64 / WAVES as f64;
            let simpson = if i == WAVES {
                1.0
            } else if i % 2 == 1 {
                4.0
            } else {
                2.0
            };
            let weight = simpson * LARGEST / WAVES as f64 / 3.0 / t;
            (q / t, 2.0 * weight * compliance.sample(q).excess)
        })
        .collect();
    let of_middles: Vec<Vec<f64>> = middles
        .iter()
        .map(|r| waves.iter().map(|(k, _)| bessel(k * r)[0]).collect())
        .collect();
    let of_ends: Vec<Vec<f64>> = ends
        .iter()
        .map(|c| {
            waves
                .iter()
                .map(|(k, _)| c * bessel(k * c)[1] / k)
                .collect()
        })
        .collect();
    let at_zero = 2.0 * compliance.sample(0.0).excess * LARGEST / WAVES as f64 / 3.0 / t;
    let disc = |i: usize, r: usize| {
        let film = waves.iter().enumerate();
        let film: f64 = film
            .map(|(n, (_, weight))| weight * of_ends[i][n] * of_middles[r][n])
            .sum();
        let first = at_zero * 0.5 * ends[i] * ends[i];
        if i == 0 {
            0.0
        } else {
            under_disc(ends[i], middles[r]) + film + first
        }
    };
    (0..=RINGS)
        .map(|i| (0..RINGS).map(|r| disc(i, r)).collect())
        .collect()
}

/// Returns the load of a rigid probe at a penetration as a share of the film's reduced modulus.
fn load(of_discs: &[Vec<f64>], shape: &dyn Fn(f64) -> f64, penetration: f64) -> f64 {
    let [ends, middles] = radii();
    // The contact is the rings with a positive pressure: take them off from outside.
    let mut count = RINGS;
    loop {
        let mut matrix: Vec<Vec<f64>> = (0..count)
            .map(|r| {
                let row = (0..count).map(|j| of_discs[j + 1][r] - of_discs[j][r]);
                row.chain([penetration - shape(middles[r])]).collect()
            })
            .collect();
        for pivot in 0..count {
            let (upper, lower) = matrix.split_at_mut(pivot + 1);
            let own = &upper[pivot];
            for row in lower {
                let factor = row[pivot] / own[pivot];
                for (value, other) in row.iter_mut().zip(own).skip(pivot) {
                    *value -= factor * other;
                }
            }
        }
        let mut pressure = vec![0.0; count];
        for r in (0..count).rev() {
            let known: f64 = (r + 1..count).map(|j| matrix[r][j] * pressure[j]).sum();
            pressure[r] = (matrix[r][count] - known) / matrix[r][r];
        }
        let negative = pressure.iter().rev().take_while(|p| **p < 0.0).count();
        if negative == 0 {
            let area = |j: usize| PI * (ends[j + 1] * ends[j + 1] - ends[j] * ends[j]);
            return (0..count).map(|j| pressure[j] * area(j)).sum();
        }
        count -= negative.div_ceil(4);
    }
}

#[test]
fn loads_are_those_of_rings_of_pressure() {
    let films = [
        (solid(1e6, 0.45), solid(1e8, 0.3)),
        (solid(1e7, 0.3), solid(1e6, 0.4)),
    ];
    let (t, cot) = (1.0, 0.3);
    let half_angle = f64::atan(1.0 / cot);
    type Shape = Box<dyn Fn(f64) -> f64>;
    let shapes: [(Probe, Shape); 4] = [
        (
            Probe::Sphere { radius: 2.0 },
            Box::new(|r: f64| 2.0 - (4.0 - r * r).sqrt()),
        ),
        (Probe::Cone { half_angle }, Box::new(move |r| cot * r)),
        (
            Probe::RoundedCone {
                radius: 1.0,
                half_angle,
            },
            Box::new(move |r: f64| {
                if r < cot {
                    0.5 * r * r
                } else {
                    cot * r - 0.5 * cot * cot
                }
            }),
        ),
        (
            Probe::FlatEndedCone {
                radius: 0.5,
                half_angle,
            },
            Box::new(move |r: f64| cot * (r - 0.5).max(0.0)),
        ),
    ];
    for (film, substrate) in films {
        let system_of = |probe: &Probe| rigid_probe(probe.clone(), film, t, substrate);
        let of_discs = displacements(&system_of(&shapes[0].0));
        for (probe, shape) in &shapes {
            let system = system_of(probe);
            let contact = looked_up(&system);
            let (_, penetration) = contact.load_and_penetration(1.0, 0.0).expect("in range");
            let equilibria = contact.equilibria(0.0, Control::Displacement);
            let expected = equilibria.and_then(|all| all.unloading(penetration));
            let expected = expected.expect("in range").load;
            let found = load(&of_discs, shape.as_ref(), penetration) * film.reduced();
            let miss = found / expected - 1.0;
            println!("{}: {miss:.1e}", probe.name());
            // The error of the rings falls like the square of their width.
            assert!(miss.abs() < 3e-5, "{probe:?}: {found}, not {expected}");
        }
    }
}
