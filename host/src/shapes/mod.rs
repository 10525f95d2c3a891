//! `taxel shapes`: what is known by its shape.
//!
//! Images become descriptors ([`view`], and `descriptor` of the core); a discriminant analysis finds the directions in which the classes lie apart
//! ([`discriminant`]); in these the examples of each class become at most 200 prototypes ([`cluster`], [`train`]), and what votes are worth
//! is counted on folds that were left out ([`cross`], [`calibrate`]). The gallery that comes of it is in integers and runs on a board;
//! every figure is that of these integers.

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
    /// Make a base from labelled images
    Train(train_command::TrainArgs),
    /// How often a base is right on labelled images
    Eval(eval::EvalArgs),
    /// Teach a base one more class, or more of a class, by touches of a board or by images
    Learn(Box<learn::LearnArgs>),
    /// Teach a board a base
    Install(install::InstallArgs),
    /// Leave out prototypes that decide nothing
    Prune(prune::PruneArgs),
    /// What a base knows
    List(list::ListArgs),
    /// Where a base comes from, and where it fails
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
