//! Reads the lens of the page of experiments and fits it:
//! `cargo run --release -p coated-contact-fit --example file`, at the root of the repository.

use fit::data::{Format, read};
use fit::{Bodies, Experiment, Free, Options, Parameter, fit};
use interp::{Elastic, Probe, System, Table};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let system = System {
        probe: Probe::Paraboloid { radius: 1e-3 }, // all in SI units
        sphere_modulus: 2e6,                       // the reduced modulus E2*, which is fitted
        film: Elastic::new(3.5e6, 0.5)?,           // Young's modulus, Poisson ratio
        film_thickness: 3e-5,
        substrate: Elastic::new(2e11, 0.25)?,
    };
    let lens = read("crates/fit/data/lens.csv".as_ref(), &Format::default())?;
    let mut experiment = Experiment::new(lens.measurement, Bodies::coated(&system));
    experiment.noise = Some(2e-6);
    let free = [
        Free::new(Parameter::SphereModulus),
        Free::new(Parameter::WorkOfAdhesion),
        Free::new(Parameter::LoadOffset),
    ];
    let found = fit(Table::embedded(), &[experiment], &free, &Options::default())?;
    for estimate in &found.estimates {
        let (value, error) = (estimate.value, estimate.standard_error);
        println!("{}: {value:.3e} +- {error:.1e}", estimate.parameter);
    }
    for warning in &found.warnings {
        println!("warning: {}", warning.text);
    }
    Ok(())
}
