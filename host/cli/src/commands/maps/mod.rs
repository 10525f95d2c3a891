//! `taxel fcm`: fuzzy cognitive maps as files: run, check, explain, combine, learn and draw.

pub mod check;
pub mod combine;
pub mod draw;
pub mod learn;
pub mod run;
pub mod told;
pub mod why;

use crate::fault::Fault;
use anyhow::{Result, bail};
use taxel::robot::ReadRobot;

/// Arguments of `taxel fcm`.
#[derive(Debug, Clone, clap::Args)]
#[command(args_conflicts_with_subcommands = true, subcommand_negates_reqs = true)]
pub struct FcmArgs {
    /// What to do with maps [default: run one]
    #[command(subcommand)]
    command: Option<MapCommand>,
    #[command(flatten)]
    run: Option<run::RunArgs>,
}

#[derive(Debug, Clone, clap::Subcommand)]
enum MapCommand {
    /// Check a map: its numbers, unreachable concepts, whether it settles and fits the board
    Check(check::MapCheckArgs),
    /// Combine the maps of several experts into one; report where they disagree
    Combine(combine::CombineArgs),
    /// Merge maps that share concepts into one
    Merge(combine::MergeArgs),
    /// Explain an activation: what caused it, and what would change it
    Why(why::WhyArgs),
    /// Learn weights from labelled touches; the expert's signs stay
    Learn(learn::MapLearnArgs),
    /// Write a map as a graph in DOT, which Graphviz draws
    Draw(draw::DrawArgs),
}

impl FcmArgs {
    /// What is asked to be explained of a robot, by all its boards; none for anything else.
    pub fn why_of_robot(&self) -> Result<Option<(&why::WhyArgs, ReadRobot)>> {
        let Some(MapCommand::Why(args)) = &self.command else { return Ok(None) };
        Ok(args.told.robot()?.map(|robot| (args, robot)))
    }
}

/// Runs the command.
pub fn run(args: FcmArgs) -> Result<()> {
    match (args.command, args.run) {
        (Some(MapCommand::Check(args)), _) => check::run(args),
        (Some(MapCommand::Combine(args)), _) => combine::combine(args),
        (Some(MapCommand::Merge(args)), _) => combine::merge(args),
        (Some(MapCommand::Why(args)), _) => why::run(args),
        (Some(MapCommand::Learn(args)), _) => learn::run(args),
        (Some(MapCommand::Draw(args)), _) => draw::run(args),
        (None, Some(args)) => run::run(args),
        (None, None) => bail!(Fault::usage("a map or a command is missing: see taxel fcm --help")),
    }
}
