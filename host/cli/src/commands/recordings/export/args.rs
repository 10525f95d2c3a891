//! Arguments of `taxel export`.

use crate::fault::Fault;
use crate::watch::Overwrite;
use anyhow::{Result, ensure};
use clap::{Args, ValueEnum};
use std::num::{NonZeroU16, NonZeroU64};
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
    /// A data set for LeRobot
    Lerobot,
}

/// Arguments of `taxel export`.
#[derive(Debug, Clone, Args)]
pub struct ExportArgs {
    /// Recording: .mcap, of a robot .mcap#BOARD; for LeRobot one or more
    #[arg(required = true, value_name = "FILE")]
    pub files: Vec<BoardRecording>,
    /// Format to write
    #[arg(long, value_name = "FORM")]
    pub to: Form,
    /// File to write, `-` for standard output (CSV); for images and LeRobot the folder
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
    /// CSV, LeRobot: counts even if newtons are known; images: grey levels are counts
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
    /// All of these recordings, with all options at their defaults.
    pub fn of(files: Vec<PathBuf>, to: Form, output: PathBuf) -> ExportArgs {
        ExportArgs {
            files: files.into_iter().map(Into::into).collect(),
            to,
            output,
            force: Overwrite::default(),
            touched: false,
            contacts: false,
            counts: false,
            reference: 3.3,
            fps: NonZeroU16::MIN.saturating_add(29),
            task: "touch".into(),
            every: NonZeroU64::MIN,
        }
    }

    /// The files that no output may replace.
    pub fn inputs(&self) -> impl Iterator<Item = &Path> {
        self.files.iter().map(|recording| recording.path.as_path())
    }

    /// Refuses options of other formats.
    pub fn check(&self) -> Result<()> {
        let refuse = Fault::usage;
        ensure!(
            cfg!(feature = "lerobot") || self.to != Form::Lerobot,
            refuse(
                "this program was built without LeRobot: `cargo run --release --features lerobot -- export ...` builds it in"
            )
        );
        let count = self.files.len();
        ensure!(
            count <= 1 || self.to == Form::Lerobot,
            Fault::usage(format!("{count} recordings: only --to lerobot takes more than one"))
        );
        ensure!(!self.touched || self.to == Form::Csv, refuse("--touched is for --to csv"));
        ensure!(!self.contacts || self.to == Form::Csv, refuse("--contacts is for --to csv"));
        ensure!(!self.counts || self.to != Form::Npz, refuse("--counts: an .npz always holds counts"));
        let voltage = self.reference.is_finite() && self.reference > 0.0;
        ensure!(voltage, refuse("--reference must be a voltage above 0"));
        Ok(())
    }
}
