//! `tabulate completions`

use clap::Command;
use clap_complete::Shell;

use super::print;

/// Print a script that completes the commands and options of `tabulate` in a shell
///
/// Save the script where the shell looks for completions.
#[derive(clap::Args)]
#[command(after_help = super::examples!(
    "tabulate completions bash > tabulate.bash          # then: source tabulate.bash",
    "tabulate completions zsh > _tabulate               # in a folder of $fpath",
    "tabulate completions fish > tabulate.fish          # in ~/.config/fish/completions",
))]
pub struct Arguments {
    /// The shell
    shell: Shell,
}

pub fn run(arguments: &Arguments, mut program: Command) -> anyhow::Result<()> {
    let mut script = Vec::new();
    clap_complete::generate(arguments.shell, &mut program, super::NAME, &mut script);
    print(&script)
}
