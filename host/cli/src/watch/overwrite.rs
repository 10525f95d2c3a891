//! The option `--force`.

use clap::Args;
use taxel::files::output::Force;

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
