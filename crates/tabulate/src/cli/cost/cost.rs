//! `tabulate cost`

use clap::Subcommand;
use cost::history;

use super::rows::Rows;
use super::{effects, lookup, solve, table};

/// Measure the cost of accuracy in time and memory
///
/// Prints a summary as Markdown. Writes all rows as CSV if -o is given: `tabulate plot` draws them.
/// Errors and sizes do not change from run to run; times do.
#[derive(clap::Args)]
#[command(after_help = crate::cli::examples!(
    "tabulate cost table --data tables/figures/table.csv",
    "tabulate cost solve -o solve.csv",
))]
pub struct Arguments {
    #[command(subcommand)]
    of: Of,
}

#[derive(Subcommand)]
enum Of {
    /// Measure one solve: error against time, beside a plain dense Nystrom solve
    #[command(after_help = crate::cli::examples!(
        "tabulate cost solve --data tables/figures/solve.csv",
        "tabulate cost solve -o solve.csv",
    ))]
    Solve(Rows),
    Table(table::Arguments),
    Lookup(lookup::Arguments),
    Effects(effects::Arguments),
    /// Measure contacts in time: error of the load against time, of three laws of relaxation
    ///
    /// Penetrations that grow and fall once take integrals, whose errors are those against a run at a much
    /// smaller tolerance. All others take elements, whose errors are the stated ones.
    #[command(after_help = crate::cli::examples!(
        "tabulate cost history --data tables/figures/history.csv",
        "tabulate cost history -o history.csv",
    ))]
    History(Rows),
}

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    match &arguments.of {
        Of::Solve(rows) => rows.report(
            None,
            |timing| Ok(solve::measured(timing).into()),
            ::cost::solve::markdown,
        ),
        Of::Table(arguments) => table::run(arguments),
        Of::Lookup(arguments) => lookup::run(arguments),
        Of::Effects(arguments) => effects::run(arguments),
        Of::History(rows) => rows.report(
            None,
            |timing| Ok(history::measure(timing)?.into()),
            history::markdown,
        ),
    }
}
