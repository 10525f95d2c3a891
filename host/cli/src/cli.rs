//! The command line: one variant for each subcommand, each with an example.

mod completions;
mod examples;
mod groups;

use crate::commands::board::doctor::{self, DoctorArgs};
use crate::commands::board::flash::{self, FlashArgs};
use crate::commands::board::health::{self, HealthArgs};
use crate::commands::board::ports::{self, PortsArgs};
use crate::commands::board::reset_settings::{self, ResetSettingsArgs};
use crate::commands::board::save::{self, SaveArgs};
use crate::commands::body::{self, BodyArgs};
use crate::commands::frames::features::{self, FeaturesArgs};
use crate::commands::frames::process::{self, ProcessArgs};
use crate::commands::garment::calibrate::{self, CalibrateArgs};
use crate::commands::garment::config::{self, ConfigArgs};
use crate::commands::garment::setup::{self, SetupArgs};
use crate::commands::maps::{self, FcmArgs};
#[cfg(not(all(feature = "foxglove", feature = "ros2", feature = "zenoh")))]
use crate::commands::not_built;
#[cfg(not(feature = "foxglove"))]
use crate::commands::not_built::NotBuiltArgs as FoxgloveArgs;
#[cfg(not(feature = "ros2"))]
use crate::commands::not_built::NotBuiltArgs as Ros2Args;
#[cfg(not(feature = "zenoh"))]
use crate::commands::not_built::NotBuiltArgs as ServeArgs;
use crate::commands::recordings::export::{self, ExportArgs};
use crate::commands::recordings::info::{self, InfoArgs};
use crate::commands::recordings::record::{self, RecordArgs};
use crate::commands::recordings::report::{self, ReportArgs};
use crate::commands::robot;
use crate::commands::shapes::{self, ShapesArgs};
use crate::commands::touches::gestures::{self, GesturesArgs};
use crate::commands::touches::intent::{self, IntentArgs};
#[cfg(feature = "foxglove")]
use crate::commands::views::foxglove::{self, FoxgloveArgs};
use crate::commands::views::live;
#[cfg(feature = "ros2")]
use crate::commands::views::ros2::{self, Ros2Args};
#[cfg(feature = "zenoh")]
use crate::commands::views::serve::{self, ServeArgs};
use crate::commands::views::view::{self, ViewArgs};
use crate::watch::LiveArgs;
use anyhow::Result;
use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};
use completions::CompletionsArgs;
use examples::*;
use std::ffi::OsString;
use taxel::tell::{verbose, words};

/// See, record and understand touch on a robot's tactile garment
#[derive(Debug, Parser)]
#[command(name = "taxel", version, after_help = TAXEL)]
pub struct Cli {
    /// What to do [default: live]
    #[command(subcommand)]
    command: Option<Command>,
    /// Report on standard error what the program does
    #[arg(short, long, global = true)]
    verbose: bool,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Watch a board or a recording; `taxel` alone watches the board, or a simulated one
    #[command(after_help = LIVE)]
    Live(LiveArgs),
    /// Watch a board or a recording in the browser: panels, surface, body, map, health
    #[command(after_help = VIEW)]
    View(ViewArgs),
    /// Serve a board's stream to Foxglove, live
    #[cfg_attr(not(feature = "foxglove"), doc = "(needs a build with `--features foxglove`)")]
    #[command(after_help = FOXGLOVE)]
    Foxglove(FoxgloveArgs),
    /// Run a ROS 2 node that publishes a board's stream, live
    #[cfg_attr(not(feature = "ros2"), doc = "(needs a build with `--features ros2`)")]
    #[command(after_help = ROS2)]
    Ros2(Ros2Args),
    /// Offer a board to other machines over Zenoh; there it is `--source zenoh:ROBOT/BOARD`
    #[cfg_attr(not(feature = "zenoh"), doc = "(needs a build with `--features zenoh`)")]
    #[command(after_help = SERVE)]
    Serve(ServeArgs),
    /// Record a board's stream for Foxglove, Rerun, Python and ROS 2
    #[command(after_help = RECORD)]
    Record(RecordArgs),
    /// Show a recording's contents; repair a damaged or truncated one
    #[command(after_help = INFO)]
    Info(InfoArgs),
    /// Convert a recording to CSV, NumPy arrays or images
    #[command(after_help = EXPORT)]
    Export(ExportArgs),
    /// Write one page about a recording or a board
    #[command(after_help = REPORT)]
    Report(ReportArgs),
    /// Run recorded frames through the board's perception
    #[command(after_help = PROCESS)]
    Process(ProcessArgs),
    /// Compute moments, NMI and axis of one recorded image
    #[command(after_help = FEATURES)]
    Features(FeaturesArgs),
    /// Fuzzy cognitive maps: run, check, explain, combine, teach, draw
    #[command(after_help = FCM)]
    Fcm(FcmArgs),
    /// Recognise gestures: train and evaluate models that fit the board
    #[command(after_help = GESTURES)]
    Gestures(GesturesArgs),
    /// Recognise kindness, threat and attack: train and evaluate models that fit the board
    #[command(after_help = INTENT)]
    Intent(IntentArgs),
    /// Identify a garment's wires by touch, and write its garment file
    #[command(after_help = SETUP)]
    Setup(SetupArgs),
    /// Calibrate force with known weights; find the settling time
    #[command(after_help = CALIBRATE)]
    Calibrate(CalibrateArgs),
    /// List faulty taxels, lines and inputs
    #[command(after_help = HEALTH)]
    Health(HealthArgs),
    /// Save settings to the board's flash
    #[command(after_help = SAVE)]
    Save(SaveArgs),
    /// Start the board with the shipped settings; keep the saved ones aside
    #[command(after_help = RESET_SETTINGS)]
    ResetSettings(ResetSettingsArgs),
    /// Recognise shapes: train, teach, evaluate, install
    #[command(after_help = SHAPES)]
    Shapes(ShapesArgs),
    /// Diagnose a board: what is wrong, and what to do about it
    #[command(after_help = DOCTOR)]
    Doctor(DoctorArgs),
    /// List serial ports, and which of them is a board
    #[command(after_help = PORTS)]
    Ports(PortsArgs),
    /// Write the firmware to a board
    #[command(after_help = FLASH)]
    Flash(FlashArgs),
    /// Create and check garment and scene files; list the scripts of touches
    #[command(after_help = CONFIG)]
    Config(ConfigArgs),
    /// Place a garment's taxels on the robot's links
    #[command(after_help = BODY)]
    Body(BodyArgs),
    /// Print the completions of this command line for a shell
    #[command(after_help = COMPLETIONS)]
    Completions(CompletionsArgs),
}

impl Cli {
    /// Reads a command line; the program ends here where it is wrong, or asks for help.
    pub fn read(words: impl IntoIterator<Item = OsString>) -> Cli {
        let mut command = groups::grouped(Cli::command());
        let read = command.try_get_matches_from_mut(words);
        let read =
            read.and_then(|read| Cli::from_arg_matches(&read).map_err(|error| error.format(&mut command)));
        read.unwrap_or_else(|error| in_words(error).exit())
    }

    /// Runs what was asked for.
    pub fn run(self) -> Result<()> {
        if self.verbose {
            verbose::on();
        }
        let bare = self.command.is_none();
        let live = || Cli::parse_from(["taxel", "live"]).command;
        match self.command.or_else(live).expect("live is a command") {
            Command::Live(args) => match args.board.robot()? {
                Some(robot) => robot::live::run(&args, &robot),
                None => live::run(args, bare),
            },
            Command::View(args) => match args.board.robot()? {
                Some(robot) => robot::view::run(&args, &robot),
                None => view::run(args),
            },
            #[cfg(feature = "foxglove")]
            Command::Foxglove(args) => foxglove::run(args),
            #[cfg(not(feature = "foxglove"))]
            Command::Foxglove(args) => not_built::foxglove(&args),
            #[cfg(feature = "ros2")]
            Command::Ros2(args) => match args.board.robot()? {
                Some(robot) => robot::ros2::run(&args, &robot),
                None => ros2::run(args),
            },
            #[cfg(not(feature = "ros2"))]
            Command::Ros2(args) => not_built::ros2(&args),
            #[cfg(feature = "zenoh")]
            Command::Serve(args) => match args.board.robot()? {
                Some(robot) => robot::serve::run(&args, &robot),
                None => serve::run(args),
            },
            #[cfg(not(feature = "zenoh"))]
            Command::Serve(args) => not_built::serve(&args),
            Command::Record(args) => match args.board.robot()? {
                Some(robot) => robot::record::run(&args, &robot),
                None => record::run(args),
            },
            Command::Info(args) => info::run(args),
            Command::Export(args) => export::run(args),
            Command::Report(args) => report::run(args),
            Command::Process(args) => process::run(args),
            Command::Features(args) => features::run(args),
            Command::Fcm(args) => match args.why_of_robot()? {
                Some((args, robot)) => robot::why::run(args, &robot),
                None => maps::run(args),
            },
            Command::Gestures(args) => gestures::run(args),
            Command::Intent(args) => intent::run(args),
            Command::Setup(args) => setup::run(&args),
            Command::Calibrate(args) => calibrate::run(&args),
            Command::Health(args) => health::run(args),
            Command::Save(args) => save::run(args),
            Command::ResetSettings(args) => reset_settings::run(&args),
            Command::Shapes(args) => shapes::run(args),
            Command::Doctor(args) => match args.robot()? {
                Some(robot) => robot::doctor::run(&args, &robot),
                None => doctor::run(&args),
            },
            Command::Ports(args) => ports::run(&args),
            Command::Flash(args) => flash::run(&args),
            Command::Config(args) => config::run(&args),
            Command::Body(args) => body::run(&args),
            Command::Completions(args) => completions::run(&args, Cli::command()),
        }
    }
}

/// Rewrites number-parsing errors in plain words.
fn in_words(error: clap::Error) -> clap::Error {
    let Some(theirs) = std::error::Error::source(&error).map(ToString::to_string) else { return error };
    let ours = words::plain(&theirs);
    if ours == theirs {
        return error;
    }
    let told = error.to_string();
    let message = told.trim_start_matches("error: ").replacen(&theirs, &ours, 1);
    clap::Error::raw(error.kind(), message)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_help_has_an_example() {
        let command = Cli::command();
        command.clone().debug_assert();
        for command in command.get_subcommands().chain([&command]) {
            let after = command.get_after_help().map(ToString::to_string).unwrap_or_default();
            assert!(
                after.starts_with("Example") && after.contains("taxel"),
                "{}: {after}",
                command.get_name()
            );
        }
    }
}
