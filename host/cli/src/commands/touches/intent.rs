//! `taxel intent`: recognises the intention of a touch by a model that fits the board.

use super::task::{Task, TouchesEvalArgs, TouchesTrainArgs};
use anyhow::Result;
use clap::{Args, Subcommand, ValueEnum};
use taxel::learn::touches::intent::{Apart, SETTINGS, load, times};
use taxel::learn::touches::{self, grid};
use taxel_core::gesture::ShippedModel;

const TASK: Task = Task {
    shipped: ShippedModel::Intent,
    settings: SETTINGS,
    candidates: || grid(SETTINGS, &[3.0, 10.0, 30.0, 100.0], &[0.0, 0.5, 1.0]),
};

/// Shown below the help.
const EXAMPLES: &str = "Examples:
  taxel intent eval --frames frames.npz --labels labels.csv --cross day --json
  taxel intent train --frames frames.npz --labels labels.csv -o my.model";

/// Recognise kindness, threat and attack: train and evaluate models that fit the board
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLES)]
pub struct IntentArgs {
    #[command(subcommand)]
    command: IntentCommand,
}

#[derive(Debug, Clone, Subcommand)]
enum IntentCommand {
    /// Train a model
    Train(TouchesTrainArgs),
    /// Evaluate a model; with --cross, train on all groups but one and test on that one, in turn
    Eval(TouchesEvalArgs<LeftOutDays>),
    /// Print the card of the shipped models: data, split, figures, where they fail
    Card,
}

/// Groups that are left out in turn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum LeftOutDays {
    /// Each recording
    Recording,
    /// The recordings of each day, which is in their names
    Day,
}

/// Runs the command.
pub fn run(args: IntentArgs) -> Result<()> {
    match args.command {
        IntentCommand::Train(args) => {
            let output = args.output()?;
            TASK.train(&load(&args.files.files(), Apart::Day)?, output)
        }
        IntentCommand::Eval(args) => {
            let data = load(&args.files.files(), args.cross.map_or(Apart::Day, Apart::from))?;
            TASK.eval(&args, data, &times())
        }
        IntentCommand::Card => {
            print!("{}", touches::CARDS);
            Ok(())
        }
    }
}

impl From<LeftOutDays> for Apart {
    fn from(cross: LeftOutDays) -> Apart {
        match cross {
            LeftOutDays::Recording => Apart::Recording,
            LeftOutDays::Day => Apart::Day,
        }
    }
}
