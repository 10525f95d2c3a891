//! `taxel shapes`: recognition of objects by the shape of their contact.

use anyhow::Result;
use clap::Subcommand;

mod card;
mod eval;
mod hold;
pub mod images;
pub mod install;
mod learn;
mod list;
mod prune;
pub mod train;

/// Arguments of `taxel shapes`.
#[derive(Debug, Clone, clap::Args)]
pub struct ShapesArgs {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Clone, Subcommand)]
enum Command {
    /// Train a base on labelled images
    Train(train::TrainArgs),
    /// Evaluate a base on labelled images
    Eval(eval::EvalArgs),
    /// Add a class, or more examples of one, by touching a board or from images
    Learn(Box<learn::LearnArgs>),
    /// Send a base to a board
    Install(install::InstallArgs),
    /// Remove prototypes that do not affect decisions
    Prune(prune::PruneArgs),
    /// List the classes of a base
    List(list::ListArgs),
    /// Print where a base comes from and where it fails
    Card(card::CardArgs),
}

/// Runs the command.
pub fn run(args: ShapesArgs) -> Result<()> {
    match args.command {
        Command::Train(args) => train::run(args),
        Command::Eval(args) => eval::run(args),
        Command::Learn(args) => learn::run(*args),
        Command::Install(args) => install::run(args),
        Command::Prune(args) => prune::run(args),
        Command::List(args) => list::run(args),
        Command::Card(args) => card::run(args),
    }
}
