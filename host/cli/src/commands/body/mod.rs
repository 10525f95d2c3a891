//! `taxel body`: where the garment's taxels lie on the robot.

mod check;

use crate::watch::Overwrite;
use anyhow::Result;
use clap::{Args, Subcommand};
use std::path::PathBuf;
use taxel::body::{self, Surface};
use taxel::files::garments;
use taxel::files::output::Output;
use taxel_core::capacity::TAXELS;
use taxel_core::garment::Layout;

/// Arguments of `taxel body`.
#[derive(Debug, Clone, Args)]
pub struct BodyArgs {
    #[command(subcommand)]
    what: BodyTask,
}

/// A body and its garment.
#[derive(Debug, Clone, Args)]
pub struct WornArgs {
    /// The body: a TOML file or `reference`
    body: String,
    /// The garment that it wears: a TOML file or a preset
    #[arg(long, value_name = "G", default_value = "reference")]
    garment: String,
}

impl WornArgs {
    /// Places the taxels.
    fn surface(&self) -> Result<(Layout, Surface)> {
        let garment = garments::read(&self.garment)?;
        let layout = Layout::build(&garment.garment, TAXELS, u16::MAX).map_err(|e| garment.error(&e))?;
        let surface = body::read(&self.body)?.surface(&garment.garment, &layout)?;
        Ok((layout, surface))
    }
}

#[derive(Debug, Clone, Subcommand)]
enum BodyTask {
    /// Check a body file: how each panel lies on its link; errors name line and key
    #[command(after_help = "Example:\n  taxel body check reference")]
    Check {
        /// BodyTask is checked.
        #[command(flatten)]
        worn: WornArgs,
        /// Print JSON instead of a table
        #[arg(long)]
        json: bool,
    },
    /// Write the place and the normal of every taxel as CSV
    #[command(after_help = "Example:\n  taxel body places reference -o places.csv")]
    Places {
        /// BodyTask is placed.
        #[command(flatten)]
        worn: WornArgs,
        /// The file to write; - for the standard output
        #[arg(short, long, value_name = "FILE")]
        output: PathBuf,
        /// Whether an existing file is replaced.
        #[command(flatten)]
        force: Overwrite,
    },
}

/// Runs the command.
pub fn run(args: &BodyArgs) -> Result<()> {
    match &args.what {
        BodyTask::Check { worn, json } => {
            let (layout, surface) = worn.surface()?;
            print!("{}", check::told(&layout, &surface, *json)?);
            Ok(())
        }
        BodyTask::Places { worn, output, force } => {
            let output = Output::stream(output, *force, [&worn.body, &worn.garment])?;
            let (_, surface) = worn.surface()?;
            Ok(output.write(body::text(&surface).as_bytes())?)
        }
    }
}
