//! `tabulate man`

use anyhow::Context;
use clap::Command;

use super::print;

/// Print the man page of the program, or of one of its commands
#[derive(clap::Args)]
#[command(after_help = super::examples!(
    "tabulate man > tabulate.1                          # then: man ./tabulate.1",
    "tabulate man plot error-map",
))]
pub struct Arguments {
    /// The command, word by word
    command: Vec<String>,
}

pub fn run(arguments: &Arguments, mut program: Command) -> anyhow::Result<()> {
    program.build();
    let mut command = &program;
    for word in &arguments.command {
        command = command.find_subcommand(word).with_context(|| {
            let known: Vec<&str> = command.get_subcommands().map(Command::get_name).collect();
            if known.is_empty() {
                format!(
                    "`{}` has no commands of its own: leave out {word:?}",
                    command.get_name()
                )
            } else {
                format!("there is no command {word:?}, only: {}", known.join(", "))
            }
        })?;
    }
    let mut page = Vec::new();
    clap_mangen::Man::new(command.clone())
        .source(concat!("tabulate ", env!("CARGO_PKG_VERSION")))
        .render(&mut page)?;
    // clap_mangen calls the text after the options EXTRA.
    let page = String::from_utf8(page)?.replace(".SH EXTRA\n", ".SH EXAMPLES\n");
    print(page.as_bytes())
}
