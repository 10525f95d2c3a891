//! `taxel robot`: all boards of a robot at once.

mod args;
mod check;
mod controllers;
mod doctor;
mod live;
mod record;
mod requests;
#[cfg(feature = "ros2")]
mod ros2;
#[cfg(feature = "zenoh")]
mod serve;
mod shown;
mod tellers;
mod view;
mod viewed;
mod why;

#[cfg(not(all(feature = "ros2", feature = "zenoh")))]
use crate::commands::not_built;
#[cfg(not(feature = "ros2"))]
use crate::commands::not_built::NotBuiltArgs as RobotRos2Args;
#[cfg(not(feature = "zenoh"))]
use crate::commands::not_built::NotBuiltArgs as RobotServeArgs;
use anyhow::Result;
use clap::{Args, Subcommand};
use doctor::RobotDoctorArgs;
use live::RobotLiveArgs;
use record::RobotRecordArgs;
#[cfg(feature = "ros2")]
use ros2::RobotRos2Args;
#[cfg(feature = "zenoh")]
use serve::RobotServeArgs;
use std::path::PathBuf;
use view::RobotViewArgs;
use why::RobotWhyArgs;

/// Arguments of `taxel robot`.
#[derive(Debug, Clone, Args)]
pub struct RobotArgs {
    #[command(subcommand)]
    what: RobotTask,
}

#[derive(Debug, Clone, Subcommand)]
enum RobotTask {
    /// Check a robot's file, and list its boards; errors name line, board and key
    #[command(after_help = "Example:\n  taxel robot check robot.toml")]
    Check {
        /// The robot's file: robot.toml
        file: PathBuf,
        /// Print JSON instead of tables
        #[arg(long)]
        json: bool,
    },
    /// Watch all boards: the lines of `taxel live`, each with its board
    #[command(
        after_help = "Examples:\n  taxel robot live robot.toml\n  taxel robot live robot.toml --json --tare arm=32"
    )]
    Live(RobotLiveArgs),
    /// Explain what touches mean to the robot, down to the contacts of its boards
    #[command(after_help = "Example:\n  taxel robot why robot.toml --at 1 --of hug")]
    Why(RobotWhyArgs),
    /// Watch all boards in the browser: a page for each, and what touches the robot
    #[command(after_help = "Example:\n  taxel robot view robot.toml --open")]
    View(RobotViewArgs),
    /// Record all boards in one file
    #[command(
        after_help = "Examples:\n  taxel robot record robot.toml -o touch.mcap --seconds 60\n  taxel robot record robot.toml -o touch.mcap --view --open"
    )]
    Record(RobotRecordArgs),
    /// Run ROS 2 nodes that publish all boards, live: one for each, and one for the robot
    #[cfg_attr(not(feature = "ros2"), doc = "(needs a build with `--features ros2`)")]
    #[command(after_help = "Example:\n  taxel robot ros2 robot.toml --domain 7")]
    Ros2(RobotRos2Args),
    /// Offer all boards to other machines over Zenoh, by the name of the robot and their own
    #[cfg_attr(not(feature = "zenoh"), doc = "(needs a build with `--features zenoh`)")]
    #[command(after_help = "Example:\n  taxel robot serve robot.toml --zenoh router.json5")]
    Serve(RobotServeArgs),
    /// Diagnose all boards: what is wrong, and what to do about it
    #[command(after_help = "Example:\n  taxel robot doctor robot.toml --json")]
    Doctor(RobotDoctorArgs),
}

/// Runs the command.
pub fn run(args: &RobotArgs) -> Result<()> {
    match &args.what {
        RobotTask::Check { file, json } => check::run(file, *json),
        RobotTask::Live(args) => live::run(args),
        RobotTask::Why(args) => why::run(args),
        RobotTask::View(args) => view::run(args),
        RobotTask::Record(args) => record::run(args),
        #[cfg(feature = "ros2")]
        RobotTask::Ros2(args) => ros2::run(args),
        #[cfg(not(feature = "ros2"))]
        RobotTask::Ros2(args) => not_built::robot_ros2(args),
        #[cfg(feature = "zenoh")]
        RobotTask::Serve(args) => serve::run(args),
        #[cfg(not(feature = "zenoh"))]
        RobotTask::Serve(args) => not_built::robot_serve(args),
        RobotTask::Doctor(args) => doctor::run(args),
    }
}
