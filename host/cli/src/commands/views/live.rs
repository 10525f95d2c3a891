//! `taxel live`: shows a board's stream in the terminal, as lines of text or as JSON.

use crate::terminal::{Lines, Screen, TaxelLines, View};
use crate::watch::{LiveArgs, watch};
use anyhow::Result;
use std::io::{IsTerminal, stdout};
use taxel::json::MessagePrinter;
use taxel::session::Observer;
use taxel::source::{SourceOptions, SourceSpec};

/// Runs the command; `bare` if the program was called without one.
pub fn run(args: LiveArgs, bare: bool) -> Result<()> {
    let is_seen = stdout().is_terminal();
    let terminal = is_seen && !args.json && args.taxel.is_none();
    // Who looks at a recording sees it as it was, however it is written.
    let is_played = is_seen && matches!(args.board.named(), Some(SourceSpec::Replay { .. }));
    let bounded = args.frames.is_some() || args.seconds.is_some();
    let options = SourceOptions {
        realtime: args.realtime || terminal || is_played,
        repeat: terminal && !bounded,
        frames: args.frames,
        seconds: args.seconds,
        ..SourceOptions::default()
    };
    let (source, calibration) = args.board.open_to_show(options, bare || is_seen)?;
    let out = std::io::BufWriter::new(stdout());
    let mut observer: Box<dyn Observer> = if let Some(place) = &args.taxel {
        Box::new(TaxelLines::new(place.clone(), args.json, out))
    } else if args.json {
        Box::new(MessagePrinter::new(args.pixels, out).calibrated(calibration))
    } else if terminal {
        Box::new(Screen::open(View::new(&source))?)
    } else {
        Box::new(Lines::new(out))
    };
    let tells_remarks = args.taxel.is_none();
    watch(&LiveArgs { tells_remarks, ..args }, source, observer.as_mut())
}
