//! `taxel intent`: recognises the intention of a touch by a model that fits the board.

use super::task::{EvalArgs, Task, TrainArgs};
use anyhow::Result;
use clap::{Args, Subcommand, ValueEnum};
use taxel::learn::touches::intent::{Apart, SETTINGS, load, times};
use taxel::learn::touches::{self, grid};
use taxel_core::gesture::Shipped;

const TASK: Task = Task {
    shipped: Shipped::Intent,
    settings: SETTINGS,
    candidates: || grid(SETTINGS, &[3.0, 10.0, 30.0, 100.0], &[0.0, 0.5, 1.0]),
};

/// Arguments of `taxel intent`.
#[derive(Debug, Clone, Args)]
pub struct IntentArgs {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Clone, Subcommand)]
enum Command {
    /// Train a model
    Train(TrainArgs),
    /// Evaluate a model; with --cross, train on all groups but one and test on that one, in turn
    Eval(EvalArgs<Cross>),
    /// Print the card of the shipped models: data, split, figures, where they fail
    Card,
}

/// Groups that are left out in turn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Cross {
    /// Each recording
    Recording,
    /// The recordings of each day, which is in their names
    Day,
}

/// Runs the command.
pub fn run(args: IntentArgs) -> Result<()> {
    match args.command {
        Command::Train(args) => {
            let output = args.output()?;
            TASK.train(&load(&args.files.files(), Apart::Day)?, output)
        }
        Command::Eval(args) => {
            let data = load(&args.files.files(), args.cross.map_or(Apart::Day, Apart::from))?;
            TASK.eval(&args, data, &times())
        }
        Command::Card => {
            print!("{}", touches::CARDS);
            Ok(())
        }
    }
}

impl From<Cross> for Apart {
    fn from(cross: Cross) -> Apart {
        match cross {
            Cross::Recording => Apart::Recording,
            Cross::Day => Apart::Day,
        }
    }
}
