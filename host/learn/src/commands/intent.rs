//! `taxel-learn intent`: recognises the intention of a touch by a model that fits the board.

use super::touches::{Task, TouchesEvalArgs, TouchesTrainArgs};
use crate::touches::grid;
use crate::touches::intent::{Apart, SETTINGS, load, times};
use anyhow::Result;
use clap::{Subcommand, ValueEnum};
use taxel_core::gesture::ShippedModel;

const TASK: Task = Task {
    shipped: ShippedModel::Intent,
    settings: SETTINGS,
    candidates: || grid(SETTINGS, &[3.0, 10.0, 30.0, 100.0], &[0.0, 0.5, 1.0]),
};

/// The commands of `taxel-learn intent`.
#[derive(Debug, Clone, Subcommand)]
pub enum IntentCommand {
    /// Train a model
    Train(TouchesTrainArgs),
    /// Evaluate a model; with --cross, train on all groups but one and test on that one, in turn
    Eval(TouchesEvalArgs<LeftOutDays>),
}

/// Groups that are left out in turn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum LeftOutDays {
    /// Each recording
    Recording,
    /// The recordings of each day, which is in their names
    Day,
}

/// Runs the command.
pub fn run(command: IntentCommand) -> Result<()> {
    match command {
        IntentCommand::Train(args) => {
            let output = args.output()?;
            TASK.train(&load(&args.files, Apart::Day)?, output)
        }
        IntentCommand::Eval(args) => {
            let data = load(&args.files, args.cross.map_or(Apart::Day, Apart::from))?;
            TASK.eval(&args, data, &times())
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
