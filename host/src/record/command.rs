//! The command itself.

use super::limit::Rotate;
use super::recorder::{Plan, Recorder};
use crate::client::{Client, Event};
use crate::live::{self, LiveArgs};
use crate::source::{self, SourceOptions, SourceSpec};
use anyhow::{Context, Result, bail};
use clap::Args;
use std::fmt::Write;
use std::io::{IsTerminal, stderr};
use std::path::{Path, PathBuf};
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

/// What is told of a recording while it goes on.
#[derive(Debug, Default)]
pub struct Progress {
    frames: u64,
    lost: u64,
    thinned: u64,
    passed_us: u64,
    earlier_us: u64,
    written: u64,
    files: u32,
}

impl Progress {
    /// Takes an event, `passed_us` after the file's first.
    pub fn take(&mut self, client: &Client, event: &Event, passed_us: u64) {
        self.frames += u64::from(matches!(event, Event::Frame { .. }));
        (self.lost, self.thinned) = (client.counts().lost, client.counts().thinned);
        self.passed_us = self.passed_us.max(passed_us);
    }

    /// A file has ended.
    pub fn ended(&mut self, bytes: u64) {
        self.earlier_us += std::mem::take(&mut self.passed_us);
        self.written += bytes;
        self.files += 1;
    }

    /// Whether somebody sees it.
    pub fn is_shown(&self) -> bool {
        stderr().is_terminal()
    }

    /// One line; `bytes` are those of the file that is being written.
    pub fn line(&self, path: &Path, bytes: u64) -> String {
        let seconds = (self.earlier_us + self.passed_us) as f64 / 1e6;
        let megabytes = (self.written + bytes) as f64 / 1e6;
        let mut line = format!(
            "{}: {seconds:.1} s, {} frames, {megabytes:.2} MB, {} lost, {} thinned",
            path.display(),
            self.frames,
            self.lost,
            self.thinned
        );
        if self.files > 1 {
            // A string takes all.
            let _ = write!(line, ", {} files", self.files);
        }
        line
    }
}
