//! `taxel completions`: completions of the command line for a shell.

use anyhow::Result;
use clap_complete::{Shell, generate};

/// Arguments of `taxel completions`.
#[derive(Debug, Clone, clap::Args)]
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
