//! Stand-in for `taxel foxglove` in a build without the feature: says how to build it in.

use anyhow::{Result, bail};
use std::ffi::OsString;
use taxel::tell::fault::Fault;

/// Accepts any arguments, and repeats them in the error.
#[derive(Debug, Clone, clap::Args)]
pub struct NotBuiltArgs {
    #[arg(trailing_var_arg = true, allow_hyphen_values = true, hide = true)]
    args: Vec<OsString>,
}

/// Returns the error that says how the command is built in.
pub fn run(args: NotBuiltArgs) -> Result<()> {
    let asked = args.args.iter().map(|arg| format!(" {}", arg.display())).collect::<String>();
    bail!(Fault::usage(format!(
        "this program was built without Foxglove: `cargo run --release --features foxglove -- foxglove{asked}` builds it in"
    )))
}
