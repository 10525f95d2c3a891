//! The command itself.

use super::limit::Rotate;
use super::recorder::{Plan, Recorder};
use crate::live::{self, LiveArgs};
use crate::source::{self, SourceOptions, SourceSpec};
use anyhow::{Context, Result, bail};
use clap::Args;
use std::io::{IsTerminal, stderr};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// What `taxel record` takes.
#[derive(Debug, Clone, Args)]
pub struct RecordArgs {
    /// File to write (.mcap)
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,
    /// `auto`, `usb`, `sim[:SCENE]`, `serial:PATH[@BAUD]`, `tcp:HOST:PORT`, `emulator[:SCENE]`, `file:FILE` or `replay:FILE`
    #[arg(long, value_name = "SOURCE", default_value = "auto")]
    pub source: SourceSpec,
    /// End after N images
    #[arg(long, value_name = "N")]
    pub frames: Option<u64>,
    /// End after S seconds of the board [default: a simulation's own end; else Ctrl-C]
    #[arg(long, value_name = "S")]
    pub seconds: Option<f64>,
    /// Also write FILE.ros2.mcap with ROS 2's own messages: images, point clouds, forces, diagnostics
    #[arg(long)]
    pub ros2: bool,
    /// Go on in FILE-0002.mcap and so on after a time or a size: 10min, 1GB
    #[arg(long, value_name = "LIMIT")]
    pub rotate: Option<Rotate>,
    /// Write over files that are there
    #[arg(long)]
    pub force: bool,
    /// Garment that a real or emulated board is to wear: a preset or a TOML file
    #[arg(long, value_name = "G")]
    pub garment: Option<String>,
    /// Scene that the board is used for: a TOML file
    #[arg(long, value_name = "FILE")]
    pub scene: Option<PathBuf>,
    /// Take the mean of the first N frames as the baseline [default: as a simulated scene asks, else 0]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(0..=4096))]
    pub tare: Option<u16>,
    /// A simulation is not faster than time
    #[arg(long)]
    pub realtime: bool,
    /// Seed of a simulation
    #[arg(long, value_name = "N")]
    pub seed: Option<u64>,
}

/// Runs the command.
pub fn run(args: RecordArgs) -> Result<()> {
    if args.seconds.is_some_and(|s| !s.is_finite() || s < 0.0) {
        bail!("--seconds must be a time of 0 or more");
    }
    let options = SourceOptions {
        seed: args.seed,
        realtime: args.realtime,
        frames: args.frames,
        seconds: args.seconds,
        ..SourceOptions::default()
    };
    let source = source::open(&args.source, &options)?;
    let stop = Arc::new(AtomicBool::new(false));
    let asked = stop.clone();
    ctrlc::set_handler(move || asked.store(true, Ordering::Relaxed)).context("Ctrl-C cannot be caught")?;
    let mut recorder = Recorder::create(Plan {
        path: args.output,
        rotate: args.rotate,
        ros2: args.ros2,
        force: args.force,
        label: source.label.clone(),
        counts_per_newton: source.counts_per_newton,
        stop,
    })?;
    let watched = LiveArgs {
        frames: args.frames,
        seconds: args.seconds,
        garment: args.garment,
        scene: args.scene,
        tare: args.tare,
        ..LiveArgs::of(args.source)
    };
    let done = live::watch(&watched, source, &mut recorder);
    // A source that is gone ends the recording, and not its file.
    let ended = recorder.finish();
    let again = if stderr().is_terminal() { "\r" } else { "" };
    eprintln!("{again}{} ", recorder.progress());
    done.and(ended)
}
