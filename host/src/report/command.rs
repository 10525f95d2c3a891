//! The command itself.

use super::{Seen, page};
use crate::fault::Fault;
use crate::live::{self, LiveArgs};
use crate::source::{self, SourceOptions, SourceSpec, Speed};
use anyhow::{Context, Result, bail};
use clap::Args;
use std::path::PathBuf;

/// What `taxel report` takes.
#[derive(Debug, Clone, Args)]
pub struct ReportArgs {
    /// Recording: .mcap
    #[arg(conflicts_with = "source")]
    pub file: Option<PathBuf>,
    /// In place of a recording: `sim[:SCENE]`, `usb`, `serial:PATH[@BAUD]`, `tcp:HOST:PORT`, `emulator[:SCENE]` or `file:FILE`
    #[arg(long, value_name = "SOURCE")]
    pub source: Option<SourceSpec>,
    /// Page to write (.html)
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,
    /// Stop after S seconds of the board's time [default: 10 for a real board; a simulated scene is played once]
    #[arg(long, value_name = "S", value_parser = live::seconds)]
    pub seconds: Option<f64>,
}

/// How long a board is watched that does not end by itself, s.
const WATCHED: f64 = 10.0;

/// Runs the command.
pub fn run(args: ReportArgs) -> Result<()> {
    let spec = match (args.file, args.source) {
        (Some(path), _) => SourceSpec::Replay { path, speed: Speed::Max },
        (None, Some(spec)) => spec,
        (None, None) => bail!(Fault::usage("give a recording, or a --source")),
    };
    let options = SourceOptions { seconds: args.seconds, ..SourceOptions::default() };
    let source = source::open(&spec, &options)?;
    let seconds = args.seconds.or(source.real_time.then_some(WATCHED));
    let mut seen = Seen::new(source.label.clone(), source.counts_per_newton);
    live::watch(&LiveArgs { seconds, ..LiveArgs::of(spec) }, source, &mut seen)?;
    std::fs::write(&args.output, page(&seen)?)
        .with_context(|| format!("{} cannot be written", args.output.display()))?;
    println!("{}: figures of {}", args.output.display(), seen.label);
    Ok(())
}
