//! `taxel fcm`: fuzzy cognitive maps as files; run, validated, explained, combined, taught and drawn.

pub mod aggregate;
pub mod bench;
pub mod board;
pub mod check;
pub mod combine;
pub mod config;
pub mod decimal;
pub mod draw;
pub mod engine;
pub mod json;
pub mod layers;
pub mod learn;
pub mod load;
pub mod map;
pub mod member;
pub mod new;
pub mod paths;
pub mod run;
pub mod scene;
pub mod search;
pub mod steps;
pub mod sweep;
pub mod terms;
pub mod told;
pub mod touches;
pub mod unite;
pub mod weight;
pub mod why;
pub mod wrong;

use crate::fault::Fault;
use anyhow::{Result, bail};

/// Arguments of `taxel fcm`.
#[derive(Debug, Clone, clap::Args)]
#[command(args_conflicts_with_subcommands = true, subcommand_negates_reqs = true)]
pub struct FcmArgs {
    /// What to do with maps; without it, one is run
    #[command(subcommand)]
    command: Option<Command>,
    #[command(flatten)]
    run: Option<run::RunArgs>,
}

#[derive(Debug, Clone, clap::Subcommand)]
enum Command {
    /// Validate a map: its numbers, what nothing reaches, whether it settles, whether the board holds it
    Check(check::CheckArgs),
    /// One map of several experts' maps of one thing, with their disagreement
    Combine(combine::CombineArgs),
    /// One map of maps that share concepts
    Merge(combine::MergeArgs),
    /// What made an activation, and what would change it
    Why(why::WhyArgs),
    /// A map in four steps, asked for line by line
    New(new::NewArgs),
    /// Better weights from labelled touches, within the expert's signs
    Learn(learn::LearnArgs),
    /// The graph as SVG
    Draw(draw::DrawArgs),
    /// The time of one inference, beside other programs
    Bench(bench::BenchArgs),
}

/// Runs the command.
pub fn run(args: FcmArgs) -> Result<()> {
    match (args.command, args.run) {
        (Some(Command::Check(args)), _) => check::run(args),
        (Some(Command::Combine(args)), _) => combine::combine(args),
        (Some(Command::Merge(args)), _) => combine::merge(args),
        (Some(Command::Why(args)), _) => why::run(args),
        (Some(Command::New(args)), _) => new::run(args),
        (Some(Command::Learn(args)), _) => learn::run(args),
        (Some(Command::Draw(args)), _) => draw::run(args),
        (Some(Command::Bench(args)), _) => bench::run(args),
        (None, Some(args)) => run::run(args),
        (None, None) => bail!(Fault::usage("a map or a command is missing: see taxel fcm --help")),
    }
}
