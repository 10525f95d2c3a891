//! The commands of `taxel-learn`.

mod gestures;
mod intent;
mod meaning;
mod recipe;
mod shapes_eval;
mod shapes_train;
mod touches;

use anyhow::Result;
use clap::{Parser, Subcommand};

/// Shown below the help.
const EXAMPLES: &str = "Examples:
  cargo learn shapes train --images images.npz --labels labels.csv -o objects.json
  cargo learn shapes eval --images images.npz --labels labels.csv --cross 5 --json
  cargo learn shapes eval --images shapes.npz --set 32x64_C_n3 --classes three
  cargo learn gestures train --frames train.npz --labels train.csv -o my.model
  cargo learn gestures eval --model my.model --frames test.npz --labels test.csv
  cargo learn gestures eval --frames train.npz --labels train.csv --cross participant --json
  cargo learn intent eval --frames frames.npz --labels labels.csv --cross day --json
  cargo learn meaning eval touches/care touches/work --all";

/// Train and judge models that fit the board, on recorded data sets
#[derive(Debug, Parser)]
#[command(name = "taxel-learn", version, after_help = EXAMPLES)]
pub struct Cli {
    #[command(subcommand)]
    model: ModelCommand,
}

#[derive(Debug, Subcommand)]
enum ModelCommand {
    /// Objects by the shape of their contact
    #[command(subcommand)]
    Shapes(ShapesCommand),
    /// Gestures
    #[command(subcommand)]
    Gestures(gestures::GesturesCommand),
    /// Kindness, threat and attack
    #[command(subcommand)]
    Intent(intent::IntentCommand),
    /// The cognitive map, on scripts of touches by several hands
    #[command(subcommand)]
    Meaning(meaning::MeaningCommand),
}

#[derive(Debug, Subcommand)]
enum ShapesCommand {
    /// Train a base on labelled images
    Train(shapes_train::ShapesTrainArgs),
    /// Evaluate a base on labelled images
    Eval(shapes_eval::ShapesEvalArgs),
}

impl Cli {
    /// Runs the command.
    pub fn run(self) -> Result<()> {
        match self.model {
            ModelCommand::Shapes(ShapesCommand::Train(args)) => shapes_train::run(&args),
            ModelCommand::Shapes(ShapesCommand::Eval(args)) => shapes_eval::run(&args),
            ModelCommand::Gestures(command) => gestures::run(command),
            ModelCommand::Intent(command) => intent::run(command),
            ModelCommand::Meaning(command) => meaning::run(command),
        }
    }
}
