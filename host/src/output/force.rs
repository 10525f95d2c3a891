//! The option `--force`.

use clap::Args;

/// Whether an existing output is replaced.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Args)]
pub struct Force {
    /// Replace the output if it exists
    #[arg(long)]
    pub force: bool,
}
