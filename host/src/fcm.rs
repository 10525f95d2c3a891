//! `taxel fcm`: fuzzy cognitive maps as files; run, validated, explained, combined, taught and drawn.

pub mod board;
pub mod check;
pub mod config;
pub mod decimal;
pub mod engine;
pub mod json;
pub mod load;
pub mod map;
pub mod member;
pub mod run;
pub mod scene;
pub mod sweep;
pub mod terms;
pub mod weight;

use anyhow::Result;

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
}

/// Runs the command.
pub fn run(args: FcmArgs) -> Result<()> {
    match (args.command, args.run) {
        (Some(Command::Check(args)), _) => check::run(args),
        (None, Some(args)) => run::run(args),
        (None, None) => unreachable!("clap asks for a map where there is no subcommand"),
    }
}
