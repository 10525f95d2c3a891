//! `taxel gestures`: recognises gestures by a model that fits the board.

use super::task::{Task, TouchesEvalArgs, TouchesTrainArgs};
use anyhow::Result;
use clap::{Args, Subcommand, ValueEnum};
use taxel::learn::touches::gestures::{SETTINGS, load, times};
use taxel::learn::touches::{self, grid};
use taxel_core::gesture::ShippedModel;

const TASK: Task = Task {
    shipped: ShippedModel::Gestures,
    settings: SETTINGS,
    candidates: || grid(SETTINGS, &[3.0, 10.0, 40.0, 160.0, 640.0], &[0.0, 0.5]),
};

/// Shown below the help.
const EXAMPLES: &str = "Examples:
  taxel gestures eval --frames train.npz --labels train.csv --cross participant --json
  taxel gestures train --frames train.npz --labels train.csv -o my.model
  taxel gestures eval --model my.model --frames test.npz --labels test.csv";

/// Recognise gestures: train and evaluate models that fit the board
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLES)]
pub struct GesturesArgs {
    #[command(subcommand)]
    command: GesturesCommand,
}

#[derive(Debug, Clone, Subcommand)]
enum GesturesCommand {
    /// Train a model
    Train(TouchesTrainArgs),
    /// Evaluate a model; with --cross, train on all groups but one and test on that one, in turn
    Eval {
        #[command(flatten)]
        eval: TouchesEvalArgs<LeftOutPeople>,
        /// Frames per second of the recordings
        #[arg(long, value_name = "HZ", default_value_t = 54.0)]
        rate: f64,
    },
    /// Print the card of the shipped models: data, split, figures, where they fail
    Card,
}

/// Groups that are left out in turn.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum LeftOutPeople {
    /// Each participant
    Participant,
}

/// Runs the command.
pub fn run(args: GesturesArgs) -> Result<()> {
    match args.command {
        GesturesCommand::Train(args) => {
            let output = args.output()?;
            TASK.train(&load(&args.files.files())?, output)
        }
        GesturesCommand::Eval { eval, rate } => TASK.eval(&eval, load(&eval.files.files())?, &times(rate)?),
        GesturesCommand::Card => {
            print!("{}", touches::CARDS);
            Ok(())
        }
    }
}
