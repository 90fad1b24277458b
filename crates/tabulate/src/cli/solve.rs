//! `tabulate solve`

use std::path::{Path, PathBuf};

use anyhow::ensure;
use interp::Material;

use super::json::Number;
use super::output::Output;
use super::points::{Answer, Points, number};
use super::print;
use crate::solve::{PowerLaw, solve_power_laws};
use crate::table::DEFAULT_NU0;

/// Solve the contact directly, at one point or at every point of a CSV file
///
/// Prints pi0, eeq, gamma, delta0, the estimated relative error, and with --exponent the load and
/// the penetration of other probes. Results with e1_over_e2 = 0 are
/// normalised by E1*, all others by E2*. Points of a file are solved in batches: at an error, those
/// before the batch are printed already, and a file is not written. `tabulate --help` explains the parameters.
#[derive(clap::Args)]
#[command(after_help = super::examples!(
    "tabulate solve --a-over-t 65 --e1-over-e2 1.75 --nu1 0.5 --e0-over-e2 1e5",
    "tabulate solve --a-over-t 1 --e1-over-e2 0 --nu1 0.3 --e0-over-e2 inf --json",
    "tabulate solve --points tables/points.csv -o solved.csv",
    "tabulate solve --points tables/points.csv --exponent 1 --exponent 4",
))]
pub struct Arguments {
    /// Contact radius over film thickness
    #[arg(
        long,
        required_unless_present = "points",
        allow_negative_numbers = true
    )]
    a_over_t: Option<f64>,
    /// Young's modulus of the film over the sphere's reduced modulus E2*, any positive number; 0:
    /// rigid sphere
    #[arg(
        long,
        required_unless_present = "points",
        allow_negative_numbers = true
    )]
    e1_over_e2: Option<f64>,
    /// Poisson ratio of the film
    #[arg(
        long,
        required_unless_present = "points",
        allow_negative_numbers = true
    )]
    nu1: Option<f64>,
    /// Young's modulus of the substrate over the sphere's reduced modulus E2*, any positive number;
    /// inf: rigid substrate; under a rigid sphere E0/E1
    #[arg(
        long,
        required_unless_present = "points",
        allow_negative_numbers = true
    )]
    e0_over_e2: Option<f64>,
    /// Poisson ratio of the substrate; with --points, where the CSV has no column nu0
    #[arg(long, default_value_t = DEFAULT_NU0, allow_negative_numbers = true)]
    nu0: f64,
    /// CSV with the columns a_over_t, e1_over_e2, nu1, e0_over_e2 and perhaps nu0, in any order
    #[arg(long, value_name = "IN.csv", conflicts_with_all = ["a_over_t", "e1_over_e2", "nu1", "e0_over_e2", "json"])]
    points: Option<PathBuf>,
    /// Write the CSV here instead of to standard output
    #[arg(short, long, value_name = "OUT.csv", requires = "points", conflicts_with_all = ["a_over_t", "e1_over_e2", "nu1", "e0_over_e2", "json"])]
    output: Option<PathBuf>,
    /// Relative tolerance on every quantity
    #[arg(long, default_value = "1e-10", allow_negative_numbers = true)]
    tolerance: f64,
    /// Solve a probe with the profile c r^N too, N from 0.1 to 20: 1 is a cone. May be repeated
    ///
    /// Adds pi_N and delta_N, the load and the penetration without adhesion. With kappa =
    /// sqrt(pi) Gammafunction(N/2 + 1)/Gammafunction((N + 1)/2) they are delta0 = c kappa a^N delta_N
    /// and F0 = c kappa a^(N+1) (E2*/2) pi_N. Where N = 2 and c = 1/(2 R), these are delta0 and pi0.
    #[arg(long = "exponent", value_name = "N", allow_negative_numbers = true)]
    exponents: Vec<f64>,
    /// Print one JSON object
    ///
    /// The fields are a_over_t, e1_over_e2, nu1, e0_over_e2, nu0, pi0, eeq, gamma, delta0, error,
    /// pi_N and delta_N of each exponent, normalised_by, modes and method (of the solve). An infinite
    /// number is the text "inf".
    #[arg(long)]
    json: bool,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
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
    let given = |value: Option<f64>| value.expect("clap requires the parameters without --points");
    let (a_over_t, e1, nu1, e0) = (
        given(arguments.a_over_t),
        given(arguments.e1_over_e2),
        given(arguments.nu1),
        given(arguments.e0_over_e2),
    );
    let material = Material::new(e1, nu1, e0, arguments.nu0)?;
    let (solution, power_laws) =
        solve_power_laws(a_over_t, &material, exponents, arguments.tolerance)?;
    let q = solution.quantities;
    let unit = material.normalisation().symbol();
    let further = further_columns(exponents)
        .into_iter()
        .zip(numbers(&power_laws));
    let text = if arguments.json {
        let mut object = serde_json::json!({
            "a_over_t": a_over_t, "e1_over_e2": e1, "nu1": nu1, "e0_over_e2": Number(e0), "nu0": arguments.nu0,
            "pi0": q.pi0, "eeq": q.eeq, "gamma": q.gamma, "delta0": q.delta0,
            "error": solution.error, "normalised_by": unit, "modes": solution.modes, "method": solution.method.name(),
        });
        for (name, value) in further {
            object[name] = value.into();
        }
        format!("{object}\n")
    } else {
        let rows = [
            ("pi0", q.pi0),
            ("eeq", q.eeq),
            ("gamma", q.gamma),
            ("delta0", q.delta0),
            ("error", solution.error),
        ];
        let rows: String = rows
            .map(|(name, value)| (name.to_owned(), value))
            .into_iter()
            .chain(further)
            .map(|(name, value)| format!("{name:13} = {}\n", number(value)))
            .collect();
        format!("{rows}normalised_by = {unit}\n")
    };
    print(text.as_bytes())
}

fn solve_file(arguments: &Arguments, path: &Path) -> anyhow::Result<()> {
    let output = Output::new(arguments.output.as_deref(), [Some(path)])?;
    let points = Points::open(path, arguments.nu0)?;
    let exponents = &arguments.exponents;
    points.answer("solving", &output, &further_columns(exponents), |point| {
        let (solution, power_laws) = solve_power_laws(
            point.a_over_t,
            &point.material,
            exponents,
            arguments.tolerance,
        )?;
        Ok(Answer {
            values: solution.quantities.to_array().map(Some),
            error: solution.error,
            further: numbers(&power_laws).map(Some).collect(),
        })
    })
}

/// Returns the names of the columns of the power laws.
fn further_columns(exponents: &[f64]) -> Vec<String> {
    let names = |exponent: &f64| [format!("pi_{exponent}"), format!("delta_{exponent}")];
    exponents.iter().flat_map(names).collect()
}

/// Returns the numbers in these columns.
fn numbers(power_laws: &[PowerLaw]) -> impl Iterator<Item = f64> {
    power_laws
        .iter()
        .flat_map(|power_law| [power_law.pi, power_law.delta])
}
