//! Fits the modulus of a lens, the work of adhesion and the modulus of a film to loads at contact
//! radii: `cargo run --release -p coated-contact-fit --example lens`.

use std::error::Error;

use fit::data::{Format, read_from};
use fit::{Bodies, Experiment, Free, Options, Parameter};
use interp::{Elastic, Probe, System, Table};

/// Contact radii and loads in SI units, below two comments and a header.
const DATA: &str = include_str!("synthetic-10um.csv");

fn main() -> Result<(), Box<dyn Error>> {
    let reading = read_from(DATA.as_bytes(), "synthetic-10um.csv", &Format::default())?;
    let system = System {
        probe: Probe::Paraboloid { radius: 1e-3 },
        sphere_modulus: 1e6, // fitted; the start follows from the data
        film: Elastic::new(3.5e6, 0.5)?,
        film_thickness: 1e-5,
        substrate: Elastic::new(2e11, 0.25)?,
    };
    let mut experiment = Experiment::new(reading.measurement, Bodies::coated(&system));
    experiment.noise = Some(5e-6);
    let mut free = vec![
        Free::new(Parameter::SphereModulus),
        Free::new(Parameter::WorkOfAdhesion),
    ];
    let mut report = String::new();
    for title in ["film of known modulus", "film modulus fitted"] {
        let options = Options::default();
        let found = fit::fit(Table::embedded(), &[experiment.clone()], &free, &options)?;
        report += &format!("{title}\n");
        for estimate in &found.estimates {
            let (name, unit) = (estimate.parameter, estimate.parameter.unit());
            let (value, error) = (estimate.value, estimate.standard_error);
            report += &format!("  {name:<17} {value:.3e} +- {error:.1e} {unit}\n");
        }
        if let Some(reduced) = found.reduced_chi_squared {
            report += &format!("  reduced chi^2     {reduced:.2}\n");
        }
        if let Some(bias) = found.without_film.and_then(|without| without.modulus) {
            let (percent, errors) = (1e2 * bias.relative, bias.standard_errors.abs());
            let word = if bias.matters() {
                "matters"
            } else {
                "does not matter"
            };
            report += &format!(
                "  the film {word}: {} is off by {percent:+.1} % ({errors:.0} standard errors) without it\n",
                bias.parameter
            );
        }
        for warning in &found.warnings {
            report += &format!("  warning: {}\n", warning.text);
        }
        free.push(Free::new(Parameter::FilmModulus));
    }
    // Printed at once, because a reader such as `head` may close the pipe after some lines.
    print!("{report}");
    Ok(())
}
