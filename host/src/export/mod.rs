//! `taxel export`: recordings in the forms of other programs.
//!
//! | `--to` | what |
//! |---|---|
//! | `csv` | one row a taxel and frame: where it is, volts, pressure in its unit, see `csv.rs` |
//! | `npz` | NumPy arrays: an array of frames for each panel, times, contacts, see `npz.rs` |
//! | `png` | a folder with an image of 16 bits for each frame and panel, counts |
//! | `lerobot` | a folder with a data set for LeRobot, one episode a recording, see `lerobot/mod.rs`; needs the feature `lerobot` |

mod csv;
mod frames;
#[cfg(feature = "lerobot")]
mod lerobot;
mod npz;
mod png;
mod units;

use crate::fault::Fault;
use anyhow::{Context, Result, bail, ensure};
use clap::{Args, ValueEnum};
use frames::Frames;
use std::num::{NonZeroU16, NonZeroU64};
use std::path::PathBuf;

/// What a recording becomes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Form {
    /// A table
    Csv,
    /// NumPy arrays
    Npz,
    /// Images
    Png,
    /// A data set for LeRobot
    Lerobot,
}

/// What `taxel export` takes.
#[derive(Debug, Clone, Args)]
pub struct ExportArgs {
    /// Recording: .mcap; for LeRobot one or more
    #[arg(required = true, value_name = "FILE")]
    pub files: Vec<PathBuf>,
    /// Format to write
    #[arg(long, value_name = "FORM")]
    pub to: Form,
    /// File to write; for images and LeRobot the folder
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,
    /// CSV: only taxels with pressure
    #[arg(long)]
    pub touched: bool,
    /// CSV, LeRobot: write counts even where newtons are known
    #[arg(long)]
    pub counts: bool,
    /// CSV: reference voltage of the converter, V
    #[arg(long, value_name = "V", default_value_t = 3.3)]
    pub reference: f64,
    /// LeRobot: rows per second
    #[arg(long, value_name = "N", default_value = "30")]
    pub fps: NonZeroU16,
    /// LeRobot: name of the task
    #[arg(long, value_name = "TEXT", default_value = "touch")]
    pub task: String,
    /// Only every N-th frame
    #[arg(long, value_name = "N", default_value = "1")]
    pub every: NonZeroU64,
}

impl ExportArgs {
    /// All of these recordings, with nothing else asked for.
    pub fn of(files: Vec<PathBuf>, to: Form, output: PathBuf) -> ExportArgs {
        ExportArgs {
            files,
            to,
            output,
            touched: false,
            counts: false,
            reference: 3.3,
            fps: NonZeroU16::MIN.saturating_add(29),
            task: "touch".into(),
            every: NonZeroU64::MIN,
        }
    }
}

/// Runs the command.
pub fn run(args: ExportArgs) -> Result<()> {
    ensure!(
        cfg!(feature = "lerobot") || args.to != Form::Lerobot,
        Fault::usage(
            "this program was built without LeRobot: `cargo run --release --features lerobot -- export ...` builds it in"
        )
    );
    ensure!(!args.touched || args.to == Form::Csv, Fault::usage("--touched is for --to csv"));
    let in_units = matches!(args.to, Form::Csv | Form::Lerobot);
    ensure!(
        !args.counts || in_units,
        Fault::usage("--counts is for --to csv and --to lerobot: the others hold counts")
    );
    ensure!(
        args.reference.is_finite() && args.reference > 0.0,
        Fault::usage("--reference must be a voltage above 0")
    );
    if let Some(same) = args.files.iter().find(|file| **file == args.output) {
        bail!(Fault::usage(format!("{} is the recording itself: give another name", same.display())));
    }
    let frames = |file| Frames::new(file, args.every, args.counts || !in_units);
    let recordings = args.files.iter().map(|file| frames(file)).collect::<Result<Vec<_>>>()?;
    let done = match (args.to, recordings.as_slice()) {
        #[cfg(feature = "lerobot")]
        (Form::Lerobot, all) => lerobot(all, &args),
        (Form::Csv, [one]) => {
            csv::Table { touched: args.touched, reference: args.reference }.write(one, &args.output)
        }
        (Form::Npz, [one]) => npz::write(one, &args.output),
        (Form::Png, [one]) => png::write(one, &args.output),
        (_, all) => {
            bail!(Fault::usage(format!("{} recordings: only --to lerobot takes more than one", all.len())))
        }
    };
    let names: Vec<_> = args.files.iter().map(|file| file.display().to_string()).collect();
    let count = done.with_context(|| format!("{} to {}", names.join(", "), args.output.display()))?;
    eprintln!("{}: {count} frames", args.output.display());
    Ok(())
}

#[cfg(feature = "lerobot")]
fn lerobot(recordings: &[Frames<'_>], args: &ExportArgs) -> Result<u64> {
    lerobot::write(recordings, &lerobot::Choices { fps: args.fps, task: &args.task }, &args.output)
}
