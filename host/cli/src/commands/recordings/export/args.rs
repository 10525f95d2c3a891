//! Arguments of `taxel export`.

use crate::fault::Fault;
use crate::watch::Overwrite;
use anyhow::{Result, ensure};
use clap::{Args, ValueEnum};
use std::num::NonZeroU64;
use std::path::{Path, PathBuf};
use taxel::recording::BoardRecording;

/// Format of an export.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Form {
    /// A table
    Csv,
    /// NumPy arrays
    Npz,
    /// Images
    Png,
}

/// Shown below the help.
const EXAMPLES: &str = "Examples:
  taxel export touch.mcap --to npz -o touch.npz
  taxel export touch.mcap --to csv --touched -o touch.csv
  taxel export touch.mcap --to png -o images";

/// Convert a recording to CSV, NumPy arrays or images
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLES)]
pub struct ExportArgs {
    /// Recording: .mcap, of a robot .mcap#BOARD
    pub file: BoardRecording,
    /// Format to write
    #[arg(long, value_name = "FORM")]
    pub to: Form,
    /// File to write, `-` for standard output (CSV); for images the folder
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,
    /// Whether an existing output is replaced.
    #[command(flatten)]
    pub force: Overwrite,
    /// CSV: only taxels with pressure
    #[arg(long)]
    pub touched: bool,
    /// CSV: only the contacts, one row per contact and frame
    #[arg(long, conflicts_with = "touched")]
    pub contacts: bool,
    /// CSV: counts even if newtons are known; images: grey levels are counts
    #[arg(long)]
    pub counts: bool,
    /// CSV: reference voltage of the converter, V
    #[arg(long, value_name = "V", default_value_t = 3.3)]
    pub reference: f64,
    /// Only every N-th frame
    #[arg(long, value_name = "N", default_value = "1")]
    pub every: NonZeroU64,
}

impl ExportArgs {
    /// All of a recording, with all options at their defaults.
    pub fn of(file: impl Into<BoardRecording>, to: Form, output: PathBuf) -> ExportArgs {
        ExportArgs {
            file: file.into(),
            to,
            output,
            force: Overwrite::default(),
            touched: false,
            contacts: false,
            counts: false,
            reference: 3.3,
            every: NonZeroU64::MIN,
        }
    }

    /// The file that no output may replace.
    pub fn inputs(&self) -> [&Path; 1] {
        [&self.file.path]
    }

    /// Refuses options of other formats.
    pub fn check(&self) -> Result<()> {
        let refuse = Fault::usage;
        ensure!(!self.touched || self.to == Form::Csv, refuse("--touched is for --to csv"));
        ensure!(!self.contacts || self.to == Form::Csv, refuse("--contacts is for --to csv"));
        ensure!(!self.counts || self.to != Form::Npz, refuse("--counts: an .npz always holds counts"));
        let voltage = self.reference.is_finite() && self.reference > 0.0;
        ensure!(voltage, refuse("--reference must be a voltage above 0"));
        Ok(())
    }
}
