//! `taxel gestures`: recognises gestures by a model that fits the board.

use super::task::{EvalArgs, Task, TrainArgs};
use anyhow::Result;
use clap::{Args, Subcommand, ValueEnum};
use taxel::learn::touches::gestures::{SETTINGS, load, times};
use taxel::learn::touches::{self, grid};
use taxel_core::gesture::Shipped;

const TASK: Task = Task {
    shipped: Shipped::Gestures,
    settings: SETTINGS,
    candidates: || grid(SETTINGS, &[3.0, 10.0, 40.0, 160.0, 640.0], &[0.0, 0.5]),
};

/// Arguments of `taxel gestures`.
#[derive(Debug, Clone, Args)]
pub struct GesturesArgs {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Clone, Subcommand)]
enum Command {
    /// Train a model
    Train(TrainArgs),
    /// Evaluate a model; with --cross, train on all groups but one and test on that one, in turn
    Eval {
        #[command(flatten)]
        eval: EvalArgs<Cross>,
        /// Frames per second of the recordings
        #[arg(long, value_name = "HZ", default_value_t = 54.0)]
        rate: f64,
    },
    /// Print the card of the shipped models: data, split, figures, where they fail
    Card,
}

/// Groups that are left out in turn.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum Cross {
    /// Each participant
    Participant,
}

/// Runs the command.
pub fn run(args: GesturesArgs) -> Result<()> {
    match args.command {
        Command::Train(args) => {
            let output = args.output()?;
            TASK.train(&load(&args.files.files())?, output)
        }
        Command::Eval { eval, rate } => TASK.eval(&eval, load(&eval.files.files())?, &times(rate)?),
        Command::Card => {
            print!("{}", touches::CARDS);
            Ok(())
        }
    }
}
