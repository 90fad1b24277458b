//! The commands of the program, and what it answers instead of one.

use std::any::TypeId;
use std::io::{self, IsTerminal};
use std::process::ExitCode;

use clap::error::{ContextKind, ContextValue};
use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};
use units::Quantity;

#[cfg(feature = "compress")]
use super::pack;
use super::streams::{NAME, examples, note, print};
use super::{
    advice, check, completions, curve, generate, history, info, man, pull_off, query, solve, unpack,
};
#[cfg(feature = "figures")]
use super::{cost, fit, plot, report, simulate};

/// The commands that a program with the feature `cli` alone does not have.
const LEFT_OUT: [&str; 6] = ["fit", "simulate", "report", "plot", "cost", "pack"];

/// Adhesive contact of a sphere (2) on a film (1) bonded to a substrate (0): solve it, tabulate it,
/// look it up.
///
/// a/t is contact radius over film thickness. E1/E2* and E0/E2* are the Young's moduli of film and
/// substrate over the sphere's REDUCED modulus E2* = E2/(1 - nu2^2). E0/E2* = inf is a rigid
/// substrate. E1/E2* = 0 is a rigid sphere: then results are normalised by the film's reduced
/// modulus E1* instead of E2*, and e0_over_e2 is read as E0/E1.
///
/// Lengths, moduli, forces, stiffnesses and works of adhesion are in SI units, or have a unit behind
/// them: 30um, 70GPa, 2uN, 0.1N/m, 40mJ/m^2. `u` stands for micro; mN and MN differ. A modulus below
/// 1000 Pa needs its unit: 500Pa.
///
/// Wherever a command takes a TABLE, the word `embedded` stands for the table that is compiled into
/// the program.
#[derive(Parser)]
#[command(
    name = NAME,
    bin_name = NAME,
    version,
    max_term_width = 120,
    after_help = examples!(
        "tabulate curve --specimen paper",
        "tabulate solve --a-over-t 65 --e1-over-e2 1.75 --nu1 0.5 --e0-over-e2 1e5",
        "tabulate query embedded --points tables/points.csv",
        "tabulate info embedded",
    )
)]
pub struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    Curve(curve::Arguments),
    PullOff(pull_off::Arguments),
    History(Box<history::Arguments>),
    #[cfg(feature = "figures")]
    Fit(Box<fit::Arguments>),
    #[cfg(feature = "figures")]
    Simulate(Box<simulate::Arguments>),
    Solve(solve::Arguments),
    Query(query::Arguments),
    Generate(generate::Arguments),
    Info(info::Arguments),
    Check(check::Arguments),
    #[cfg(feature = "figures")]
    Report(report::Arguments),
    #[cfg(feature = "compress")]
    Pack(pack::Arguments),
    Unpack(unpack::Arguments),
    #[cfg(feature = "figures")]
    Plot(plot::Arguments),
    #[cfg(feature = "figures")]
    Cost(cost::Arguments),
    Completions(completions::Arguments),
    Man(man::Arguments),
}

/// Runs the program on the process's arguments. Exit status 0, 1 (the work failed) or 2 (usage).
pub fn run() -> ExitCode {
    let arguments = with_signs(Arguments::command())
        .try_get_matches()
        .and_then(|matches| Arguments::from_arg_matches(&matches));
    let outcome = arguments.map_or_else(explain, |arguments| run_command(arguments.command));
    match outcome {
        Ok(status) => status,
        Err(error) => {
            match advice::advice(&error) {
                Some(advice) => note(&format!("{error:#}; {advice}")),
                None => note(&format!("{error:#}")),
            }
            ExitCode::FAILURE
        }
    }
}

/// Lets the value of a flag that takes a decimal number begin with a minus.
fn with_signs(command: clap::Command) -> clap::Command {
    let numbers = [
        TypeId::of::<f64>(),
        TypeId::of::<[f64; 2]>(),
        TypeId::of::<Quantity>(),
        TypeId::of::<[Quantity; 2]>(),
    ];
    let signed = |arg: clap::Arg| {
        let of_value = arg.get_value_parser().type_id();
        if numbers.iter().any(|number| of_value == *number) {
            arg.allow_hyphen_values(true)
        } else {
            arg
        }
    };
    command.mut_args(signed).mut_subcommands(with_signs)
}

/// Prints what clap answers instead of a command: a help text, the version, or an error of usage.
fn explain(answer: clap::Error) -> anyhow::Result<ExitCode> {
    if answer.use_stderr() {
        // There is nowhere else to say that standard error is closed.
        let _ = answer.print();
        // With all commands the name is that of another one's subcommand.
        if cfg!(not(feature = "figures"))
            && let Some(ContextValue::String(name)) = answer.get(ContextKind::InvalidSubcommand)
            && LEFT_OUT.contains(&name.as_str())
        {
            note(&format!(
                "this program was built without {name}; `cargo xtask cargo install --locked --path \
                 crates/tabulate` installs the program with all its commands"
            ));
        }
        return Ok(ExitCode::from(2));
    }
    let text = if io::stdout().is_terminal() {
        answer.render().ansi().to_string()
    } else {
        answer.render().to_string()
    };
    print(text.as_bytes())?;
    Ok(ExitCode::SUCCESS)
}

/// Runs a subcommand.
fn run_command(command: Command) -> anyhow::Result<ExitCode> {
    match command {
        Command::Curve(arguments) => curve::run(&arguments),
        Command::PullOff(arguments) => pull_off::run(&arguments),
        Command::History(arguments) => history::run(&arguments),
        #[cfg(feature = "figures")]
        Command::Fit(arguments) => fit::run(&arguments),
        #[cfg(feature = "figures")]
        Command::Simulate(arguments) => simulate::run(&arguments),
        Command::Solve(arguments) => solve::run(&arguments),
        Command::Query(arguments) => query::run(&arguments),
        Command::Generate(arguments) => generate::run(&arguments),
        Command::Info(arguments) => info::run(&arguments),
        Command::Check(arguments) => check::run(&arguments),
        #[cfg(feature = "figures")]
        Command::Report(arguments) => report::run(&arguments),
        #[cfg(feature = "compress")]
        Command::Pack(arguments) => pack::run(&arguments),
        Command::Unpack(arguments) => unpack::run(&arguments),
        #[cfg(feature = "figures")]
        Command::Plot(arguments) => plot::run(&arguments),
        #[cfg(feature = "figures")]
        Command::Cost(arguments) => cost::run(&arguments),
        Command::Completions(arguments) => completions::run(&arguments, Arguments::command()),
        Command::Man(arguments) => man::run(&arguments, Arguments::command()),
    }?;
    Ok(ExitCode::SUCCESS)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_named_commands_are_left_out_without_their_features() {
        let program = Arguments::command();
        let (of_figures, packing) = LEFT_OUT.split_at(5);
        for (names, has_feature) in [
            (of_figures, cfg!(feature = "figures")),
            (packing, cfg!(feature = "compress")),
        ] {
            for name in names {
                let is_there = program.find_subcommand(name).is_some();
                assert_eq!(is_there, has_feature, "{name}");
            }
        }
    }
}
