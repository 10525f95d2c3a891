//! The command `taxel record`.

use crate::fault::Fault;
use crate::watch::{self, BoardArgs, LiveArgs, Overwrite, stop};
use anyhow::{Error, Result, bail};
use clap::Args;
use std::path::PathBuf;
use taxel::body;
use taxel::record::{Origin, Plan, Recorder, Rotate};
use taxel::source::SourceOptions;

/// Arguments of `taxel record`.
#[derive(Debug, Clone, Args)]
pub struct RecordArgs {
    /// File to write (.mcap)
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,
    /// The board.
    #[command(flatten)]
    pub board: BoardArgs,
    /// Stop after N images
    #[arg(long, value_name = "N")]
    pub frames: Option<u64>,
    /// Stop after S seconds of the board's time [default: a simulated scene is played once; a board is
    /// recorded until Ctrl-C]
    #[arg(long, value_name = "S", value_parser = watch::seconds, allow_negative_numbers = true)]
    pub seconds: Option<f64>,
    /// Also write FILE.ros2.mcap with ROS 2 messages: images, point clouds, forces, diagnostics
    #[arg(long)]
    pub ros2: bool,
    /// Start a new file (FILE-0002.mcap, ...) after a time or a size: 10min, 1GB
    #[arg(long, value_name = "LIMIT")]
    pub rotate: Option<Rotate>,
    /// Whether an existing output is replaced.
    #[command(flatten)]
    pub force: Overwrite,
    /// Also record the converter's raw code of every taxel
    #[arg(long)]
    pub raw: bool,
    /// Pace simulations to real time
    #[arg(long)]
    pub realtime: bool,
}

/// Runs the command.
pub fn run(args: RecordArgs) -> Result<()> {
    let options = SourceOptions {
        realtime: args.realtime,
        frames: args.frames,
        seconds: args.seconds,
        raw: args.raw,
        ..SourceOptions::default()
    };
    let (source, calibration) = args.board.open(options)?;
    if args.raw && !source.listens {
        bail!(Fault::usage(format!("--raw: {} is a recording, whose board does not listen", source.label)));
    }
    stop::catch()?;
    let mut recorder = Recorder::create(Plan {
        path: args.output,
        rotate: args.rotate,
        ros2: args.ros2,
        body: args.board.body.as_deref().map(body::read).transpose()?,
        force: args.force.force,
        inputs: args.board.files(),
        origin: Origin {
            label: source.label.clone(),
            counts_per_newton: source.counts_per_newton,
            calibration,
        },
        raw: args.raw,
    })?;
    let label = source.label.clone();
    let unlimited = args.frames.is_none() && args.seconds.is_none();
    recorder.expect(args.seconds.unwrap_or(0.0));
    let watched = LiveArgs { frames: args.frames, seconds: args.seconds, ..LiveArgs::on(args.board) };
    let done = watch::watch(&watched, source, &mut recorder);
    // The recording is completed even if the source fails.
    let ended = recorder.finish();
    eprintln!("{}", recorder.progress());
    if label.starts_with("sim:") && unlimited && done.is_ok() && !stop::asked() {
        eprintln!("{label} is over: a simulated scene is played once, --seconds S records for longer");
    }
    done.and(ended.map_err(Error::from))
}
