//! `taxel-learn gestures`: recognises gestures by a model that fits the board.

use super::touches::{Task, TouchesEvalArgs, TouchesTrainArgs};
use crate::touches::gestures::{SETTINGS, load, times};
use crate::touches::grid;
use anyhow::Result;
use clap::{Subcommand, ValueEnum};
use taxel_core::gesture::ShippedModel;

const TASK: Task = Task {
    shipped: ShippedModel::Gestures,
    settings: SETTINGS,
    candidates: || grid(SETTINGS, &[3.0, 10.0, 40.0, 160.0, 640.0], &[0.0, 0.5]),
};

/// The commands of `taxel-learn gestures`.
#[derive(Debug, Clone, Subcommand)]
pub enum GesturesCommand {
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
}

/// Groups that are left out in turn.
#[derive(Debug, Clone, Copy, ValueEnum)]
pub enum LeftOutPeople {
    /// Each participant
    Participant,
}

/// Runs the command.
pub fn run(command: GesturesCommand) -> Result<()> {
    match command {
        GesturesCommand::Train(args) => {
            let output = args.output()?;
            TASK.train(&load(&args.files)?, output)
        }
        GesturesCommand::Eval { eval, rate } => TASK.eval(&eval, load(&eval.files)?, &times(rate)?),
    }
}
