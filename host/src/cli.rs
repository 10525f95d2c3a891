//! The command line: one variant for each subcommand, each with an example.

use crate::fcm::{self, FcmArgs};
use crate::features::{self, FeaturesArgs};
use crate::process::{self, ProcessArgs};
use crate::scenes::{self, ScenesArgs};
use anyhow::Result;
use clap::{Parser, Subcommand};

/// See, record and understand the touch on a robot's tactile garment
#[derive(Debug, Parser)]
#[command(version, arg_required_else_help = true, after_help = "Example:\n  taxel scenes")]
pub struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Perceive recorded frames as the board would
    #[command(after_help = PROCESS)]
    Process(ProcessArgs),
    /// Moments, NMI and axis of one recorded image as it stands
    #[command(after_help = FEATURES)]
    Features(FeaturesArgs),
    /// Run a fuzzy cognitive map in f64 and in the board's arithmetic
    #[command(after_help = FCM)]
    Fcm(FcmArgs),
    /// List the simulated scenes
    #[command(after_help = SCENES)]
    Scenes(ScenesArgs),
}

const PROCESS: &str = "Examples:
  taxel process subject_01.npz --array posture_03 --rate 1 --json
  taxel process frames.npy --full-scale 1000 --tare 16";

const FEATURES: &str = "Examples:
  taxel features image.npy
  taxel features subject_01.npz --array posture_03 --frame 20 --json";

const FCM: &str = "Example:
  taxel fcm map.json --rule mkosko --transfer sigmoid --lambda 1 --steps 50 --json";

const SCENES: &str = "Examples:
  taxel scenes
  taxel scenes --json";

impl Cli {
    /// Runs what was asked for.
    pub fn run(self) -> Result<()> {
        match self.command {
            Command::Process(args) => process::run(args),
            Command::Features(args) => features::run(args),
            Command::Fcm(args) => fcm::run(args),
            Command::Scenes(args) => scenes::run(args),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn every_help_has_an_example() {
        let command = Cli::command();
        command.clone().debug_assert();
        for command in command.get_subcommands().chain([&command]) {
            let after = command.get_after_help().map(ToString::to_string).unwrap_or_default();
            assert!(after.starts_with("Example") && after.contains("taxel"), "{}", command.get_name());
        }
    }
}
