//! `taxel replay`: plays a recording as if its board were connected; `--source replay:FILE` does so for every
//! other command.

use crate::commands::views::live;
use crate::watch::LiveArgs;
use anyhow::Result;
use clap::Args;
use std::io::{IsTerminal, stdout};
use taxel::recording::BoardRecording;
use taxel::source::{SourceSpec, Speed};

/// Arguments of `taxel replay`.
#[derive(Debug, Clone, Args)]
pub struct ReplayArgs {
    /// Recording: .mcap, of a robot .mcap#BOARD
    pub file: BoardRecording,
    /// Speed as a multiple of the recorded one, or `max` [default: 1 in a terminal, else max]
    #[arg(long, value_name = "N|max")]
    pub speed: Option<Speed>,
    /// Stop after N images
    #[arg(long, value_name = "N")]
    pub frames: Option<u64>,
    /// Print messages as JSON, one per line
    #[arg(long)]
    pub json: bool,
    /// With --json: also print the pressure of every taxel
    #[arg(long, requires = "json")]
    pub pixels: bool,
}

/// Runs the command.
pub fn run(args: ReplayArgs) -> Result<()> {
    let speed = args.speed.unwrap_or_default();
    let source = SourceSpec::Replay { recording: args.file, speed };
    let watched = LiveArgs {
        frames: args.frames,
        json: args.json,
        pixels: args.pixels,
        realtime: stdout().is_terminal(),
        ..LiveArgs::of(source)
    };
    live::run(watched, false)
}
