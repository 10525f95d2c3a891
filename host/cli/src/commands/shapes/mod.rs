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

/// Shown below the help.
const EXAMPLES: &str = "Examples:
  taxel shapes list
  taxel shapes learn mug -o mine.json
  taxel live --shapes mine.json
  taxel shapes train --images images.npz --labels labels.csv -o objects.json
  taxel shapes eval --images images.npz --labels labels.csv --cross 5 --json
  taxel shapes eval --images shapes.npz --set 32x64_C_n3 --classes three
  taxel shapes card objects";

/// Recognise shapes: train, teach, evaluate, install
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct ShapesArgs {
    #[command(subcommand)]
    command: ShapesCommand,
}

#[derive(Debug, Clone, Subcommand)]
enum ShapesCommand {
    /// Train a base on labelled images
    Train(train::ShapesTrainArgs),
    /// Evaluate a base on labelled images
    Eval(eval::ShapesEvalArgs),
    /// Add a class, or more examples of one, by touching a board or from images
    Learn(Box<learn::ShapesLearnArgs>),
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
        ShapesCommand::Train(args) => train::run(args),
        ShapesCommand::Eval(args) => eval::run(args),
        ShapesCommand::Learn(args) => learn::run(*args),
        ShapesCommand::Install(args) => install::run(args),
        ShapesCommand::Prune(args) => prune::run(args),
        ShapesCommand::List(args) => list::run(args),
        ShapesCommand::Card(args) => card::run(args),
    }
}
