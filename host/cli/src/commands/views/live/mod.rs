//! `taxel live`: shows a board's stream in the terminal, as lines of text or as JSON.

mod lines;
mod robot;

use crate::terminal::{Lines, Screen, TaxelLines, View};
use crate::watch::{BoardArgs, TaxelPlace, WatchOptions, time, watch};
use anyhow::Result;
use std::io::{IsTerminal, stdout};
use taxel::json::MessagePrinter;
use taxel::session::Observer;
use taxel::source::{SourceOptions, SourceSpec};

/// Shown below the help.
const EXAMPLES: &str = "Examples:
  taxel live
  taxel live sim:lash --frames 200 --json
  taxel live /dev/ttyACM0
  taxel live touch.mcap
  taxel live touch.mcap@0.25
  taxel live robot.toml --json
  taxel live robot.toml#hand";

/// Watch a board or a recording; `taxel` alone watches the board, or a simulated one
#[derive(Debug, Clone, Default, clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct LiveArgs {
    /// The board.
    #[command(flatten)]
    pub board: BoardArgs,
    /// Stop after N images
    #[arg(long, value_name = "N")]
    pub frames: Option<u64>,
    /// Stop after this time of the board, such as 2s or 10min [default: a simulated scene is played once; the terminal
    /// repeats it]
    #[arg(long = "for", value_name = "TIME", value_parser = time, allow_negative_numbers = true)]
    pub seconds: Option<f64>,
    /// Print messages as JSON, one per line
    #[arg(long)]
    pub json: bool,
    /// With --json: also print the pressure of every taxel
    #[arg(long, requires = "json")]
    pub pixels: bool,
    /// Print one taxel's time, code and pressure, frame by frame
    #[arg(long, value_name = "PANEL,ROW,COL")]
    pub taxel: Option<TaxelPlace>,
    /// Pace simulations and recordings to real time
    #[arg(long)]
    pub realtime: bool,
}

impl LiveArgs {
    /// Returns what is watched for these arguments.
    pub fn watched(&self) -> WatchOptions {
        let (frames, seconds, codes) = (self.frames, self.seconds, self.taxel.is_some());
        WatchOptions { frames, seconds, codes, ..WatchOptions::on(self.board.clone()) }
    }
}

/// Runs the command.
pub fn run(args: LiveArgs) -> Result<()> {
    match args.board.robot()? {
        Some(robot) => robot::run(&args, &robot),
        None => show(args, false),
    }
}

/// Runs the command of a program that is called without one: a simulated board is played if none is plugged in.
pub fn run_bare() -> Result<()> {
    show(LiveArgs::default(), true)
}

/// Shows a board; `or_simulated` also where no person looks.
fn show(args: LiveArgs, or_simulated: bool) -> Result<()> {
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
    let (source, _) = args.board.open_to_show(options, or_simulated || is_seen)?;
    let out = std::io::BufWriter::new(stdout());
    let mut observer: Box<dyn Observer> = if let Some(place) = &args.taxel {
        Box::new(TaxelLines::new(place.clone(), args.json, out))
    } else if args.json {
        Box::new(MessagePrinter::new(args.pixels, out))
    } else if terminal {
        Box::new(Screen::open(View::new(&source))?)
    } else {
        Box::new(Lines::new(out))
    };
    // Lines say remarks themselves.
    let prints_remarks = args.taxel.is_some();
    watch(&WatchOptions { prints_remarks, ..args.watched() }, source, observer.as_mut())
}
