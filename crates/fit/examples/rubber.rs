//! Makes `crates/fit/examples/rubber.csv`: what a camera and a load cell read of a lens whose adhesion depends on the speed of
//! the contact line, while a motor changes the load. `cargo run --release -p coated-contact-fit --example rubber`

use contact::{Contact, Control, RateDependent};
use interp::{Elastic, Probe, System, Table};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// The standard deviations of a radius (m) and of a load (N).
const NOISE: [f64; 2] = [2e-7, 2e-6];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let system = System {
        probe: Probe::Paraboloid { radius: 2e-3 },
        sphere_modulus: f64::INFINITY,
        film: Elastic::new(2e6, 0.5)?,
        film_thickness: 1.5e-4,
        substrate: Elastic::new(7e10, 0.22)?,
    };
    let contact = Contact::in_table(Table::embedded(), &system)?;
    // 50 mJ/m^2 of a line at rest, twice as much at 1 um/s, and a power of 0.5.
    let mut line = contact.line(RateDependent::new(0.05, 1e-6, 0.5)?, 6e-5)?;
    let mut random = Pcg64Mcg::seed_from_u64(1);
    // The sum of twelve has the variance 1.
    let mut normal = || (0..12).map(|_| random.random_range(-0.5..0.5)).sum::<f64>();
    println!("# Synthetic, not measured. SI units.");
    println!("# cargo run --release -p coated-contact-fit --example rubber");
    println!("time,contact_radius,load,segment");
    let mut begin = 0.0;
    for (load, duration, points, way) in
        [(8e-3, 200.0, 40, "approach"), (-8e-3, 400.0, 80, "retract")]
    {
        let states = line.ramp(Control::Load, load, duration, 1e-8)?;
        // The contact ends before the motor stops.
        let end = states.last().map_or(0.0, |last| last.time);
        for i in 1..=points {
            let time = end * (f64::from(i) - 0.5) / f64::from(points);
            let after = states.partition_point(|one| one.time < time);
            let [before, after] = [&states[after - 1], &states[after]];
            let part = (time - before.time) / (after.time - before.time);
            let between = |one: f64, other: f64| one + part * (other - one);
            let radius = between(before.state.contact_radius, after.state.contact_radius);
            let load = between(before.state.load, after.state.load);
            let [radius, load] = [radius + NOISE[0] * normal(), load + NOISE[1] * normal()];
            println!("{:.3},{radius:.3e},{load:.4e},{way}", begin + time);
        }
        begin += end;
    }
    Ok(())
}
