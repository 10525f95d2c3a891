//! `taxel body`: where the garment's taxels lie on the robot.

mod check;
mod show;

use crate::watch::Overwrite;
use anyhow::Result;
use clap::{Args, Subcommand};
use std::path::{Path, PathBuf};
use taxel::body::{self, ReadBody, Surface};
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
    fn surface(&self, body: &ReadBody) -> Result<(Layout, Surface)> {
        let garment = garments::read(&self.garment)?;
        let layout = Layout::build(&garment.garment, TAXELS, u16::MAX).map_err(|e| garment.error(&e))?;
        let surface = body.surface(&garment.garment, &layout)?;
        Ok((layout, surface))
    }
}

/// A body, its garment, and a file to write.
#[derive(Debug, Clone, Args)]
pub struct WrittenArgs {
    #[command(flatten)]
    worn: WornArgs,
    /// The file to write; - for the standard output
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Whether an existing file is replaced.
    #[command(flatten)]
    force: Overwrite,
}

impl WrittenArgs {
    /// Places the taxels, and writes what `text` says of them.
    fn write(&self, text: impl Fn(&Layout, &Surface) -> String) -> Result<()> {
        let WornArgs { body, garment } = &self.worn;
        let read = body::read(body)?;
        let inputs = [Path::new(body), Path::new(garment)].into_iter().chain(read.lists());
        let output = Output::stream(&self.output, self.force, inputs)?;
        let (layout, surface) = self.worn.surface(&read)?;
        Ok(output.write(text(&layout, &surface).as_bytes())?)
    }
}

#[derive(Debug, Clone, Subcommand)]
enum BodyTask {
    /// Check a body file: how each panel lies on its link; errors name line and key
    #[command(after_help = "Example:\n  taxel body check reference")]
    Check {
        /// What is checked.
        #[command(flatten)]
        worn: WornArgs,
        /// Print JSON instead of a table
        #[arg(long)]
        json: bool,
    },
    /// Draw the taxels of each link from three sides
    #[command(after_help = "Example:\n  taxel body show reference -o body.svg")]
    Show(WrittenArgs),
    /// Write the place and the normal of every taxel as CSV
    #[command(after_help = "Example:\n  taxel body places reference -o places.csv")]
    Places(WrittenArgs),
}

/// Runs the command.
pub fn run(args: &BodyArgs) -> Result<()> {
    match &args.what {
        BodyTask::Check { worn, json } => {
            let (layout, surface) = worn.surface(&body::read(&worn.body)?)?;
            print!("{}", check::told(&layout, &surface, *json)?);
            Ok(())
        }
        BodyTask::Show(written) => written.write(show::picture),
        BodyTask::Places(written) => written.write(|_, surface| body::text(surface)),
    }
}
