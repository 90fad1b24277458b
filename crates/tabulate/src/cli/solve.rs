//! `tabulate solve`

use std::path::{Path, PathBuf};

use anyhow::{anyhow, ensure};
use clap::ValueHint;
use interp::{Material, Normalisation, Probe, System};

use super::friction::{self, FrictionArguments};
use super::interface::{self, Word};
use super::json;
use super::output::Output;
use super::points::{Answer, Given, Points, number};
use super::quantity::{modulus, number as plain};
use super::{note, print, stack_file};
use crate::table::DEFAULT_NU0;
use solve::stack::{Interface, Stack};
use solve::stick::Sticking;
use solve::{PowerLaw, Solution, solve_power_laws, solve_stack_power_laws};

/// The relative tolerance where none is given.
const TOLERANCE: f64 = 1e-10;

/// Solve the contact directly, at one point, at every point of a CSV file, or of a stack of layers
///
/// Prints pi0, eeq, gamma, delta0, the estimated relative error, and with --exponent the load and
/// the penetration of other probes. Results with e1_over_e2 = 0 are
/// normalised by E1*, all others by E2*. --friction stick adds eeq_s, gamma_s, gamma_t, gamma_eff
/// (flat punch), delta_s, pi_s (sphere without attraction), gamma_g, eeq_g (the part that the work of
/// adhesion drives) and error_s; what is not defined for the Poisson ratios is empty. Points of a file are solved in batches: at an error, those
/// before the batch are printed already, and a file is not written. `tabulate --help` explains the
/// parameters.
#[derive(clap::Args)]
#[command(after_help = super::examples!(
    "tabulate solve --a-over-t 65 --e1-over-e2 1.75 --nu1 0.5 --e0-over-e2 1e5",
    "tabulate solve --a-over-t 1 --e1-over-e2 0 --nu1 0.3 --e0-over-e2 inf --json",
    "tabulate solve --points tables/points.csv -o solved.csv",
    "tabulate solve --points tables/points.csv --exponent 1 --exponent 4",
    "tabulate solve --a-over-t 1 --e1-over-e2 1.75 --nu1 0.5 --e0-over-e2 inf --interface sliding",
    "tabulate solve --stack tables/stacks/primer.toml --sphere-modulus 2e6 --a-over-t 6.5",
    "tabulate solve --a-over-t 2 --e1-over-e2 0 --nu1 0.5 --e0-over-e2 inf --friction stick",
))]
pub struct Arguments {
    /// Contact radius over film thickness; of a stack, over the thickness of all layers
    #[arg(long, required_unless_present = "points", value_parser = plain)]
    a_over_t: Option<f64>,
    /// Young's modulus of the film over the sphere's reduced modulus E2*, any positive number; 0:
    /// rigid sphere
    #[arg(long, required_unless_present_any = ["points", "stack"], value_parser = plain)]
    e1_over_e2: Option<f64>,
    /// Poisson ratio of the film
    #[arg(long, required_unless_present_any = ["points", "stack"], value_parser = plain)]
    nu1: Option<f64>,
    /// Young's modulus of the substrate over the sphere's reduced modulus E2*, any positive number;
    /// inf: rigid substrate; under a rigid sphere E0/E1
    #[arg(long, required_unless_present_any = ["points", "stack"], value_parser = plain)]
    e0_over_e2: Option<f64>,
    /// Poisson ratio of the substrate; with --points, where the CSV has no column nu0
    #[arg(long, default_value_t = DEFAULT_NU0, value_parser = plain)]
    nu0: f64,
    /// CSV with the columns a_over_t, e1_over_e2, nu1, e0_over_e2 and optionally nu0, in any order
    #[arg(long, value_name = "IN.csv", conflicts_with_all = ["a_over_t", "e1_over_e2", "nu1", "e0_over_e2", "json"])]
    points: Option<PathBuf>,
    /// What joins the film to the substrate [default: bonded]
    ///
    /// A film that slides has no friction on its substrate, as on a lubricant. It is held by
    /// tension where it would rise: a dry film that lifts off is not modelled.
    #[arg(long, value_enum, conflicts_with_all = ["stack", "interface_stiffness"])]
    interface: Option<Word>,
    /// Springs between film and substrate, in units of E2*/t, under a rigid sphere of E1/t: the
    /// tangential stiffness, and optionally the normal one [default: inf]. 0 slides, inf is bonded
    #[arg(long, value_name = "KT[,KN]", conflicts_with = "stack", value_parser = springs)]
    interface_stiffness: Option<[f64; 2]>,
    #[arg(
        long,
        value_name = "STACK.toml",
        help = stack_file::HELP,
        value_hint = ValueHint::FilePath,
        requires = "sphere_modulus",
        conflicts_with_all = ["e1_over_e2", "nu1", "e0_over_e2", "nu0", "points"],
    )]
    stack: Option<PathBuf>,
    /// With --stack: reduced modulus E2* = E2/(1 - nu2^2) of the sphere, Pa; inf: rigid. Results
    /// are in units of E2*, under a rigid sphere of E1* of the top layer
    #[arg(long, value_name = "PA", value_parser = modulus)]
    sphere_modulus: Option<f64>,
    /// Write the CSV here instead of to standard output
    #[arg(short, long, value_name = "OUT.csv", requires = "points", conflicts_with_all = ["a_over_t", "e1_over_e2", "nu1", "e0_over_e2", "json"])]
    output: Option<PathBuf>,
    /// Relative tolerance on every quantity [default: 1e-10; with --friction stick what rounding allows, up to 1e-6]
    #[arg(long, value_parser = plain)]
    tolerance: Option<f64>,
    #[command(flatten)]
    friction: FrictionArguments,
    /// Solve a probe with the profile c r^N too, N from 0.1 to 20: 1 is a cone. May be repeated
    ///
    /// Adds pi_N and delta_N, the load and the penetration without adhesion. With kappa =
    /// sqrt(pi) Gammafunction(N/2 + 1)/Gammafunction((N + 1)/2) the penetration is c kappa a^N delta_N
    /// and the load c kappa a^(N+1) (E2*/2) pi_N. delta_2 and pi_2 equal delta0 and pi0.
    #[arg(long = "exponent", value_name = "N", value_parser = plain)]
    exponents: Vec<f64>,
    /// Print one JSON object
    ///
    /// The fields are a_over_t, e1_over_e2, nu1, e0_over_e2, nu0, with an interface
    /// interface_stiffness (tangential and normal), pi0, eeq, gamma, delta0, error,
    /// pi_N and delta_N of each exponent, the numbers of --friction stick, normalised_by, modes and method
    /// (of the solve). With
    /// --stack, sphere_modulus, thickness and layers (their number) stand in place of e1_over_e2 to
    /// nu0. An infinite number is the text "inf".
    #[arg(long)]
    json: bool,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    arguments.friction.check()?;
    ensure!(
        arguments.stack.is_some() || arguments.sphere_modulus.is_none(),
        "--sphere-modulus is of the sphere on a --stack: without a stack the moduli are ratios, --e1-over-e2 and \
         --e0-over-e2; leave it out, or give --stack"
    );
    let exponents = &arguments.exponents;
    for (i, exponent) in exponents.iter().enumerate() {
        ensure!(
            !exponents[..i].contains(exponent),
            "--exponent {exponent} is given twice; give each exponent once"
        );
    }
    if let Some(path) = &arguments.points {
        return solve_file(arguments, path);
    }
    if let Some(path) = &arguments.stack {
        return solve_layers(arguments, path);
    }
    let (a_over_t, e1, nu1, e0) = (
        given(arguments.a_over_t),
        given(arguments.e1_over_e2),
        given(arguments.nu1),
        given(arguments.e0_over_e2),
    );
    let material = Material::new(e1, nu1, e0, arguments.nu0)?;
    let solution = solve_film(arguments, a_over_t, &material)?;
    let sticking = |nu2| sticking_film(arguments, &material, nu2);
    let stick = stick(arguments, a_over_t, sticking)?;
    let mut contact = serde_json::json!({
        "a_over_t": a_over_t, "e1_over_e2": e1, "nu1": nu1, "e0_over_e2": json::number(e0), "nu0": arguments.nu0,
    });
    if arguments.interface.is_some() || arguments.interface_stiffness.is_some() {
        contact["interface_stiffness"] =
            arguments.interface().stiffnesses().map(json::number).into();
    }
    print_solution(arguments, contact, &solution, stick, &material)
}

/// Solves the numbers of friction, if they are asked for, and tells in a note why some are missing.
fn stick(
    arguments: &Arguments,
    a_over_t: f64,
    sticking: impl FnOnce(f64) -> anyhow::Result<Sticking>,
) -> anyhow::Result<Option<[Option<f64>; 9]>> {
    let Some(nu2) = arguments.friction.sticks() else {
        return Ok(None);
    };
    let (numbers, missing) = friction::numbers(&sticking(nu2)?, a_over_t, arguments.tolerance)?;
    if let Some(reason) = missing {
        note(&format!("the numbers of a sphere are left out: {reason}"));
    }
    Ok(Some(numbers))
}

fn solve_layers(arguments: &Arguments, path: &Path) -> anyhow::Result<()> {
    let layers = stack_file::read(path)?;
    let stack = layers.stack();
    let (a_over_t, sphere_modulus) = (given(arguments.a_over_t), given(arguments.sphere_modulus));
    let solution = solve_stack_power_laws(
        a_over_t,
        stack,
        sphere_modulus,
        &arguments.exponents,
        arguments.tolerance.unwrap_or(TOLERANCE),
    )?;
    let sticking = |nu2| Ok(Sticking::on_stack(stack, sphere_modulus, nu2)?);
    let stick = stick(arguments, a_over_t, sticking)?;
    let contact = serde_json::json!({
        "a_over_t": a_over_t, "sphere_modulus": json::number(sphere_modulus), "thickness": stack.thickness(),
        "layers": stack.layers().len(),
    });
    print_solution(
        arguments,
        contact,
        &solution,
        stick,
        &stack.material(sphere_modulus)?,
    )
}

/// Solves one film on its substrate, with the interface that is asked for.
fn solve_film(
    arguments: &Arguments,
    a_over_t: f64,
    material: &Material,
) -> anyhow::Result<(Solution, Vec<PowerLaw>)> {
    let exponents = &arguments.exponents;
    let joined = joined_film(arguments, material)?;
    let solve = |tolerance| match &joined {
        None => solve_power_laws(a_over_t, material, exponents, tolerance),
        Some((stack, sphere)) => {
            solve_stack_power_laws(a_over_t, stack, *sphere, exponents, tolerance)
        }
    };
    let tolerance = arguments.tolerance.unwrap_or(TOLERANCE);
    Ok(match arguments.friction.sticks() {
        // The numbers of friction, which are printed beside, yield to rounding as well.
        Some(_) => friction::within(arguments.tolerance, tolerance, solve)?,
        None => solve(tolerance)?,
    })
}

/// Puts a sphere that sticks on one film, with the interface that is asked for.
fn sticking_film(arguments: &Arguments, material: &Material, nu2: f64) -> anyhow::Result<Sticking> {
    Ok(match joined_film(arguments, material)? {
        None => Sticking::on_film(material, nu2)?,
        Some((stack, sphere)) => Sticking::on_stack(&stack, sphere, nu2)?,
    })
}

/// Returns a film that is not bonded as a stack, with the modulus of the sphere, in the units of the
/// flags: E2* or E1, and the thickness of the film. Returns `None` for a bonded film.
fn joined_film(arguments: &Arguments, material: &Material) -> anyhow::Result<Option<(Stack, f64)>> {
    let interface = arguments.interface();
    if interface.is_bonded() {
        return Ok(None);
    }
    let system = System::of_material(material, Probe::Paraboloid { radius: 1.0 });
    let layers = interface::one_film(&system, interface);
    // The library has SI units, and the flags have those of the quantities.
    let unit = match material.normalisation() {
        Normalisation::Sphere => "E2*/t",
        Normalisation::Film => "E1/t",
    };
    let layers = layers.map_err(|error| anyhow!(error.to_string().replace("Pa/m", unit)))?;
    Ok(Some((layers.stack, system.sphere_modulus)))
}

/// Reads stiffnesses without a unit.
fn springs(text: &str) -> Result<[f64; 2], String> {
    interface::pair(text, None)
}

impl Arguments {
    /// Returns the interface between film and substrate.
    fn interface(&self) -> Interface {
        interface::interface(self.interface, self.interface_stiffness)
    }
}

/// Returns the value of an argument that clap requires.
fn given(value: Option<f64>) -> f64 {
    value.expect("clap requires the parameters without --points")
}

/// Prints a solution with its power laws: as JSON after the fields of `contact`, or as text.
fn print_solution(
    arguments: &Arguments,
    mut contact: serde_json::Value,
    (solution, power_laws): &(Solution, Vec<PowerLaw>),
    stick: Option<[Option<f64>; 9]>,
    material: &Material,
) -> anyhow::Result<()> {
    let q = solution.quantities;
    let unit = material.normalisation().symbol();
    let further = further_columns(arguments).into_iter().zip(
        numbers(power_laws)
            .map(Some)
            .chain(stick.into_iter().flatten()),
    );
    let rows = [
        ("pi0", q.pi0),
        ("eeq", q.eeq),
        ("gamma", q.gamma),
        ("delta0", q.delta0),
        ("error", solution.error),
    ];
    let rows = rows.map(|(name, value)| (name.to_owned(), Some(value)));
    let rows = rows.into_iter().chain(further);
    if arguments.json {
        for (name, value) in rows {
            contact[name] = value.into();
        }
        contact["normalised_by"] = unit.into();
        contact["modes"] = solution.modes.into();
        contact["method"] = solution.method.name().into();
        return json::print(&contact);
    }
    let row = |(name, value): (String, Option<f64>)| {
        let value = value.map(number).unwrap_or_default();
        format!("{}\n", format!("{name:13} = {value}").trim_end())
    };
    let rows: String = rows.map(row).collect();
    print(format!("{rows}normalised_by = {unit}\n").as_bytes())
}

fn solve_file(arguments: &Arguments, path: &Path) -> anyhow::Result<()> {
    let output = Output::of_text(arguments.output.as_deref(), &[Some(path)])?;
    let points = Points::open(path, Given::Films { nu0: arguments.nu0 })?;
    points.answer("solving", &output, &further_columns(arguments), |point| {
        let (solution, power_laws) = solve_film(arguments, point.a_over_t, &point.material)?;
        let mut further: Vec<Option<f64>> = numbers(&power_laws).map(Some).collect();
        if let Some(nu2) = arguments.friction.sticks() {
            let sticking = sticking_film(arguments, &point.material, nu2)?;
            further.extend(friction::numbers(&sticking, point.a_over_t, arguments.tolerance)?.0);
        }
        Ok(Answer {
            values: solution.quantities.to_array().map(Some),
            error: solution.error,
            further,
        })
    })
}

/// Returns the names of the columns of the power laws and of friction.
fn further_columns(arguments: &Arguments) -> Vec<String> {
    let names = |exponent: &f64| [format!("pi_{exponent}"), format!("delta_{exponent}")];
    let friction = arguments.friction.sticks().map(|_| friction::COLUMNS);
    let friction = friction.into_iter().flat_map(|columns| columns.split(' '));
    let of_powers = arguments.exponents.iter().flat_map(names);
    of_powers.chain(friction.map(str::to_owned)).collect()
}

/// Returns the numbers in these columns.
fn numbers(power_laws: &[PowerLaw]) -> impl Iterator<Item = f64> {
    power_laws
        .iter()
        .flat_map(|power_law| [power_law.pi, power_law.delta])
}
