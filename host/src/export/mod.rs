//! `taxel export`: a recording in the forms of other programs.
//!
//! | `--to` | what |
//! |---|---|
//! | `csv` | one row a taxel and frame, see `csv.rs` |
//! | `npz` | NumPy arrays: an array of frames for each panel, times, contacts, see `npz.rs` |
//! | `png` | a folder with an image of 16 bits for each frame and panel, counts |

mod csv;
mod frames;
mod npz;
mod png;

use anyhow::{Context, Result, bail};
use clap::{Args, ValueEnum};
use std::num::NonZeroU64;
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
}

/// What `taxel export` takes.
#[derive(Debug, Clone, Args)]
pub struct ExportArgs {
    /// Recording: .mcap
    pub file: PathBuf,
    /// What it is to become
    #[arg(long, value_name = "FORM")]
    pub to: Form,
    /// File to write; for images the folder
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,
    /// With --to csv: only taxels with pressure
    #[arg(long)]
    pub touched: bool,
    /// Only each N-th frame
    #[arg(long, value_name = "N", default_value = "1")]
    pub every: NonZeroU64,
}

/// Runs the command.
pub fn run(args: ExportArgs) -> Result<()> {
    if args.touched && args.to != Form::Csv {
        bail!("--touched is for --to csv");
    }
    if args.output == args.file {
        bail!("{} is the recording itself: give another name", args.output.display());
    }
    let frames = frames::Frames::new(&args.file, args.every);
    let written = match args.to {
        Form::Csv => csv::write(&frames, args.touched, &args.output),
        Form::Npz => npz::write(&frames, &args.output),
        Form::Png => png::write(&frames, &args.output),
    };
    let count = written.with_context(|| format!("{} to {}", args.file.display(), args.output.display()))?;
    eprintln!("{}: {count} frames", args.output.display());
    Ok(())
}
