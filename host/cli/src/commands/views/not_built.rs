//! Stand-ins for the commands of features that a build leaves out: they say how to build them in.

use crate::fault::Fault;
use anyhow::{Result, bail};
use std::ffi::OsString;

/// A command's module without its feature: its arguments are any, and are repeated in the error.
macro_rules! not_built {
    ($module:ident, $args:ident, $what:literal, $feature:literal, $example:literal, $about:literal) => {
        #[cfg(not(feature = $feature))]
        pub mod $module {
            /// Arguments of the command.
            #[derive(Debug, Clone, clap::Args)]
            #[command(about = concat!($about, " (needs a build with `--features ", $feature, "`)"))]
            #[command(after_help = concat!(
                "Example, in the folder of taxel:\n  cargo run --release --features ", $feature, " -- ", $example
            ))]
            pub struct $args {
                #[arg(trailing_var_arg = true, allow_hyphen_values = true, hide = true)]
                args: Vec<std::ffi::OsString>,
            }

            /// Returns the error that says how the command is built in.
            pub fn run(args: $args) -> anyhow::Result<()> {
                super::refuse($what, $feature, stringify!($module), &args.args)
            }
        }
    };
}

not_built!(
    foxglove,
    FoxgloveArgs,
    "Foxglove",
    "foxglove",
    "foxglove --source sim:pat",
    "Serve a board's stream to Foxglove, live"
);

not_built!(
    ros2,
    Ros2Args,
    "ROS 2",
    "ros2",
    "ros2 --source sim:pat",
    "Run a ROS 2 node that publishes a board's stream, live"
);

not_built!(
    serve,
    ServeArgs,
    "Zenoh",
    "zenoh",
    "serve --source sim:pat --name arm/left",
    "Offer a board to other machines over Zenoh; there it is `--source zenoh:ROBOT/BOARD`"
);

fn refuse(what: &str, feature: &str, command: &str, args: &[OsString]) -> Result<()> {
    let asked = args.iter().map(|arg| format!(" {}", arg.display())).collect::<String>();
    bail!(Fault::usage(format!(
        "this program was built without {what}: `cargo run --release --features {feature} -- {command}{asked}` builds it in"
    )))
}
