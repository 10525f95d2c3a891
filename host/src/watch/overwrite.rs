//! The option `--force`.

use crate::files::output::Force;
use clap::Args;

/// Whether an existing output is replaced.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Args)]
pub struct Overwrite {
    /// Replace the output if it exists
    #[arg(long)]
    pub force: bool,
}

impl From<Overwrite> for Force {
    fn from(asked: Overwrite) -> Force {
        Force { force: asked.force }
    }
}
