//! `taxel completions`: completions of the command line for a shell.

use anyhow::Result;
use clap_complete::{Shell, generate};

/// Shown below the help.
const EXAMPLES: &str = "Examples:
  taxel completions bash > ~/.local/share/bash-completion/completions/taxel
  taxel completions zsh > ~/.zfunc/_taxel
  taxel completions fish > ~/.config/fish/completions/taxel.fish";

/// Print the completions of this command line for a shell
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct CompletionsArgs {
    /// The shell
    pub shell: Shell,
}

/// Prints the completions. The text is written in one call, so that a closed pipe is reported as an error.
pub fn run(args: &CompletionsArgs, mut command: clap::Command) -> Result<()> {
    let mut text = Vec::new();
    generate(args.shell, &mut command, "taxel", &mut text);
    Ok(std::io::Write::write_all(&mut std::io::stdout(), &text)?)
}
