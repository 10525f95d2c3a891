//! `taxel doctor`: observes a board for some seconds, and reports one verdict with remedies.

mod command;
mod controllers;
mod facts;
mod finding;
mod judge;
mod robot;

pub use command::DoctorArgs;
pub use facts::Facts;
pub use finding::{Finding, Grade};
pub use judge::judge;

use anyhow::Result;

/// Runs the command. Error if a board does not work.
pub fn run(args: DoctorArgs) -> Result<()> {
    match args.robot()? {
        Some(robot) => robot::run(&args, &robot),
        None => command::run(&args),
    }
}
