//! `taxel shapes`: recognition of objects by the shape of their contact.
//!
//! Images become descriptors ([`view`], and `descriptor` of the core). A discriminant analysis finds the
//! directions that separate the classes ([`discriminant`]). In this space the examples of each class become
//! prototypes, at most 200 in all ([`cluster`], [`train`]). The confidence of votes is measured on left-out
//! folds ([`cross`], [`calibrate`]). The resulting gallery is in integers and runs on a board; every figure
//! is that of these integers.

pub mod base;
pub mod calibrate;
mod card;
pub mod classes;
pub mod cluster;
pub mod cross;
pub mod data;
pub mod discriminant;
mod eval;
mod extend;
mod hold;
pub mod install;
pub mod labels;
mod learn;
mod list;
mod prune;
pub mod select;
pub mod teach;
pub mod train;
mod train_command;
mod trained;
pub mod view;

use anyhow::Result;
use clap::Subcommand;

/// Arguments of `taxel shapes`.
#[derive(Debug, Clone, clap::Args)]
pub struct ShapesArgs {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Clone, Subcommand)]
enum Command {
    /// Train a base on labelled images
    Train(train_command::TrainArgs),
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
        Command::Train(args) => train_command::run(args),
        Command::Eval(args) => eval::run(args),
        Command::Learn(args) => learn::run(*args),
        Command::Install(args) => install::run(args),
        Command::Prune(args) => prune::run(args),
        Command::List(args) => list::run(args),
        Command::Card(args) => card::run(args),
    }
}
