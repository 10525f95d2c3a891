//! Stand-ins for the commands of features that a build leaves out: they say how to build them in.

use crate::fault::Fault;
use anyhow::{Result, bail};
use std::ffi::OsString;

/// Accepts any arguments, and repeats them in the error.
#[derive(Debug, Clone, clap::Args)]
pub struct NotBuiltArgs {
    #[arg(trailing_var_arg = true, allow_hyphen_values = true, hide = true)]
    args: Vec<OsString>,
}

/// Stand-in for `taxel foxglove`: returns the error that says how the command is built in.
#[cfg(not(feature = "foxglove"))]
pub fn foxglove(args: &NotBuiltArgs) -> Result<()> {
    refuse("Foxglove", "foxglove", "foxglove", args)
}

/// Stand-in for `taxel ros2`: returns the error that says how the command is built in.
#[cfg(not(feature = "ros2"))]
pub fn ros2(args: &NotBuiltArgs) -> Result<()> {
    refuse("ROS 2", "ros2", "ros2", args)
}

/// Stand-in for `taxel serve`: returns the error that says how the command is built in.
#[cfg(not(feature = "zenoh"))]
pub fn serve(args: &NotBuiltArgs) -> Result<()> {
    refuse("Zenoh", "zenoh", "serve", args)
}

fn refuse(what: &str, feature: &str, command: &str, args: &NotBuiltArgs) -> Result<()> {
    let asked = args.args.iter().map(|arg| format!(" {}", arg.display())).collect::<String>();
    bail!(Fault::usage(format!(
        "this program was built without {what}: `cargo run --release --features {feature} -- {command}{asked}` builds it in"
    )))
}
