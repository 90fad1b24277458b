//! Fits moduli, work of adhesion, thickness or an offset to a measured contact:
//! `cargo run --release -p interp --example fit_jkr -- DATA.csv [OPTIONS]`.

mod fit;

use std::process::ExitCode;
use std::{env, io};

use fit::{Data, Fit, Parameter, fit, print};
use interp::{Elastic, System, Table};

const USAGE: &str = "\
Fits Barthel's model of a coated contact to measured loads.

usage: fit_jkr DATA.csv [OPTIONS]

DATA.csv begins with a header, contact_radius,load or load,penetration. Each further line
is a point in SI units. The reduced modulus E2* of the sphere and the work of adhesion are
always fitted. The options are in SI units. Their defaults are the values of Barthel's
Tables 1 and 2:

  --sphere-radius 1e-3
  --film-modulus 3.5e6            Young's modulus E1
  --film-poisson-ratio 0.5
  --film-thickness 1e-6
  --substrate-modulus 2e11        Young's modulus E0
  --substrate-poisson-ratio 0.25
  --fit NAME[,NAME]               fits these parameters, too: film-modulus, film-thickness
                                  (both start from the values above) or offset (of the load
                                  for contact_radius,load, else of the penetration)
  --noise N                       the standard deviation of a load; without this option it
                                  is estimated from the residuals
  --table FILE                    a packed table in place of the embedded one

example: fit_jkr DATA.csv --film-thickness 1e-5 --noise 5e-6 --fit film-modulus
";

fn main() -> ExitCode {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let out = io::stdout().lock();
    let printed = if arguments.is_empty() || arguments.iter().any(|argument| argument == "--help") {
        print(out, &USAGE)
    } else {
        run(&arguments).and_then(|fit| print(out, &fit))
    };
    match printed {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("fit_jkr: {message}");
            ExitCode::FAILURE
        }
    }
}

/// Reads options and data, and fits.
fn run(arguments: &[String]) -> Result<Fit, String> {
    let mut file = None;
    let [
        mut radius,
        mut film,
        mut film_nu,
        mut thickness,
        mut substrate,
        mut substrate_nu,
    ] = [1e-3, 3.5e6, 0.5, 1e-6, 2e11, 0.25];
    let mut free = vec![Parameter::SphereModulus, Parameter::WorkOfAdhesion];
    let mut noise = None;
    let mut own_table = None;
    let mut arguments = arguments.iter();
    while let Some(argument) = arguments.next() {
        if !argument.starts_with("--") {
            if file.replace(argument).is_some() {
                return Err(format!("{argument:?} is a second file; give one only"));
            }
            continue;
        }
        let value = arguments
            .next()
            .ok_or(format!("{argument} needs a value"))?;
        let number = || {
            value
                .parse::<f64>()
                .map_err(|_| format!("{argument} is {value:?}, not a number"))
        };
        match argument.as_str() {
            "--sphere-radius" => radius = number()?,
            "--film-modulus" => film = number()?,
            "--film-poisson-ratio" => film_nu = number()?,
            "--film-thickness" => thickness = number()?,
            "--substrate-modulus" => substrate = number()?,
            "--substrate-poisson-ratio" => substrate_nu = number()?,
            "--noise" => noise = Some(number()?),
            "--table" => {
                own_table = Some(Table::read(value).map_err(|error| format!("{value}: {error}"))?)
            }
            "--fit" => {
                for name in value.split(',') {
                    let parameter = Parameter::named(name)?;
                    if !free.contains(&parameter) {
                        free.push(parameter);
                    }
                }
            }
            _ => {
                return Err(format!(
                    "{argument} is not an option; --help lists the options"
                ));
            }
        }
    }
    let file = file.ok_or("the file DATA.csv is missing; --help shows the usage")?;
    let solid = |young, poisson| Elastic::new(young, poisson).map_err(|error| error.to_string());
    let system = System {
        sphere_radius: radius,
        sphere_modulus: f64::NAN, // fitted; the fit starts from JKR
        film: solid(film, film_nu)?,
        film_thickness: thickness,
        substrate: solid(substrate, substrate_nu)?,
    };
    let text = std::fs::read_to_string(file).map_err(|error| format!("{file}: {error}"))?;
    let data = Data::parse(&text).map_err(|error| format!("{file}: {error}"))?;
    let table = own_table.as_ref().unwrap_or_else(|| Table::embedded());
    fit(table, &data, &system, &free, noise)
}
