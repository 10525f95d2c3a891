//! `taxel shapes`: recognition of objects by the shape of their contact.

use anyhow::Result;
use clap::Subcommand;

mod card;
mod hold;
pub mod install;
mod learn;
mod list;
mod prune;

/// Shown below the help.
const EXAMPLES: &str = "Examples:
  taxel shapes list
  taxel shapes learn mug -o mine.json
  taxel live --shapes mine.json
  taxel shapes card objects";

/// Recognise objects by their shape: teach, install
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct ShapesArgs {
    #[command(subcommand)]
    command: ShapesCommand,
}

#[derive(Debug, Clone, Subcommand)]
enum ShapesCommand {
    /// Add a class, or more examples of one, by touching a board
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
        ShapesCommand::Learn(args) => learn::run(*args),
        ShapesCommand::Install(args) => install::run(args),
        ShapesCommand::Prune(args) => prune::run(args),
        ShapesCommand::List(args) => list::run(args),
        ShapesCommand::Card(args) => card::run(args),
    }
}
