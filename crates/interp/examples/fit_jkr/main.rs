//! Fits a measured contact:
//! `cargo run --release -p interp --example fit_jkr -- DATA.csv [OPTIONS]`.

mod fit;

use std::env;
use std::process::ExitCode;

use fit::{Data, Parameter, fit};
use interp::{Elastic, System, Table};

const USAGE: &str = "\
usage: fit_jkr DATA.csv [OPTIONS]

DATA.csv has a header, contact_radius,load or load,penetration, and a point in SI units in each line. The sphere's reduced modulus
E2* and the work of adhesion are always fitted. Options, in SI units, with defaults that are those of Barthel's Tables 1 and 2:

  --sphere-radius 1e-3
  --film-modulus 3.5e6           Young's modulus
  --film-poisson-ratio 0.5
  --film-thickness 1e-6
  --substrate-modulus 2e11       Young's modulus
  --substrate-poisson-ratio 0.25
  --fit NAME[,NAME]              fit also film-modulus, film-thickness (from the values above on) or the offset of the load
                                 (contact_radius,load) or of the penetration (load,penetration)
  --noise N                      standard deviation of a load; without it, it is estimated from the residuals
  --table FILE                   a packed table instead of the embedded one
";

fn main() -> ExitCode {
    let arguments: Vec<String> = env::args().skip(1).collect();
    if arguments.is_empty() || arguments.iter().any(|argument| argument == "--help") {
        print!("{USAGE}");
        return ExitCode::SUCCESS;
    }
    match run(&arguments) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("fit_jkr: {message}");
            ExitCode::FAILURE
        }
    }
}

fn run(arguments: &[String]) -> Result<(), String> {
    let mut file = None;
    let [
        mut radius,
        mut film,
        mut film_nu,
        mut thickness,
        mut substrate,
        mut substrate_nu,
    ] = [1e-3, 3.5e6, 0.5, 1e-6, 2e11, 0.25];
    let (mut free, mut noise) = (
        vec![Parameter::SphereModulus, Parameter::WorkOfAdhesion],
        None,
    );
    let mut own_table = None;
    let mut arguments = arguments.iter();
    while let Some(argument) = arguments.next() {
        if !argument.starts_with("--") {
            if file.replace(argument).is_some() {
                return Err(format!("a second file, {argument:?}"));
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
            _ => return Err(format!("no option {argument}; --help lists them")),
        }
    }
    let file = file.ok_or("no DATA.csv; --help says more")?;
    let solid = |young, poisson| Elastic::new(young, poisson).map_err(|error| error.to_string());
    let system = System {
        sphere_radius: radius,
        sphere_modulus: f64::NAN, // fitted, from JKR on
        film: solid(film, film_nu)?,
        film_thickness: thickness,
        substrate: solid(substrate, substrate_nu)?,
    };
    let text = std::fs::read_to_string(file).map_err(|error| format!("{file}: {error}"))?;
    let data = Data::parse(&text).map_err(|error| format!("{file}: {error}"))?;
    let table = own_table.as_ref().unwrap_or_else(|| Table::embedded());
    print!("{}", fit(table, &data, &system, &free, noise)?);
    Ok(())
}
