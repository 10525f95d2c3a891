//! `taxel features`: moments, NMI and axis of one recorded image, without conditioning or thresholds.

use crate::fault::Fault;
use anyhow::{Context, Result, bail};
use std::path::PathBuf;
use taxel::files::arrays;
use taxel::moments::Features;

/// Shown below the help.
const EXAMPLES: &str = "Examples:
  taxel features image.npy
  taxel features subject_01.npz --array posture_03 --frame 20 --json";

/// Compute moments, NMI and axis of one recorded image
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct FeaturesArgs {
    /// Image or frames: .npy, .npz or .csv
    pub file: PathBuf,
    /// Array of an .npz that holds several
    #[arg(long, value_name = "NAME")]
    pub array: Option<String>,
    /// Number of the frame, from 0
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub frame: usize,
    /// Print JSON instead of a table
    #[arg(long)]
    pub json: bool,
}

/// Runs the command.
pub fn run(args: FeaturesArgs) -> Result<()> {
    let frames = arrays::read(&args.file, args.array.as_deref())?;
    let file = args.file.display();
    let Some(image) = frames.frame(args.frame) else {
        let (wanted, last) = (args.frame, frames.count - 1);
        bail!(Fault::usage(format!("{file}: there is no frame {wanted}, the last is {last}")));
    };
    let features = Features::of(image, frames.columns.into()).with_context(|| file.to_string())?;
    if args.json {
        println!("{}", serde_json::to_string(&features)?);
    } else {
        print!("{}", features.table());
    }
    Ok(())
}
