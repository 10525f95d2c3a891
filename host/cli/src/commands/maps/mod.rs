//! `taxel fcm`: fuzzy cognitive maps as files: run, check, explain, combine, learn and draw.

pub mod check;
pub mod combine;
pub mod draw;
pub mod learn;
pub mod reported;
pub mod run;
pub mod why;

use crate::fault::Fault;
use anyhow::{Result, bail};

/// Shown below the help.
const EXAMPLES: &str = "Examples:
  taxel fcm map.json --rule mkosko --transfer sigmoid --lambda 1 --steps 50 --json
  taxel fcm tactile --input press=0.8 --input time=0.1
  taxel fcm why tactile --input press=0.8 --input time=0.1 --set shape=1
  taxel fcm why --source sim:lash
  taxel fcm check my-map.toml
  taxel fcm combine anna.toml ben.toml carla.toml -o ours.toml
  taxel fcm draw tactile --input shape=1 -o tactile.dot";

/// Fuzzy cognitive maps: run, check, explain, combine, teach, draw
#[derive(Debug, Clone, clap::Args)]
#[command(args_conflicts_with_subcommands = true, subcommand_negates_reqs = true)]
#[command(after_help = EXAMPLES)]
pub struct FcmArgs {
    /// Command for maps [default: run one]
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
