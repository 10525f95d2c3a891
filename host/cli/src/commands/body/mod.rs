//! `taxel body`: where the garment's taxels lie on the robot.

mod check;
mod drape;
mod dressed;
mod fit;
mod fit_text;
mod learn;
mod mark_dialogue;
mod posed;
mod show;

use crate::watch::Overwrite;
use anyhow::Result;
use clap::{Args, Subcommand};
use drape::DrapeArgs;
use dressed::DressedArgs;
use fit::FitArgs;
use learn::BodyLearnArgs;
use posed::PosedArgs;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use taxel::body::{self, Surface, robot};
use taxel::files::output::Output;
use taxel_core::garment::Layout;

/// Shown below the help.
const EXAMPLES: &str = "Examples:
  taxel body check reference
  taxel body check mine.body.toml --garment mine.toml --json
  taxel body show reference -o body.svg
  taxel body places reference -o places.csv
  taxel body places reference --robot reference --joints left_elbow=30deg --frame base -o places.csv
  taxel body drape torso.stl --scale 0.001 --panel chest --at 0.06,0,0.2 -o chest.txt
  taxel body fit reference --marks marks.txt -o fitted.toml";

/// Place a garment's taxels on the robot's links
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLES)]
pub struct BodyArgs {
    #[command(subcommand)]
    what: BodyTask,
}

/// A body, its garment, and a file to write.
#[derive(Debug, Clone, Args)]
pub struct WrittenArgs {
    #[command(flatten)]
    dressed: DressedArgs,
    /// The robot that carries it, and its posture.
    #[command(flatten)]
    posed: PosedArgs,
    /// The file to write; - for the standard output
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Whether an existing file is replaced.
    #[command(flatten)]
    force: Overwrite,
}

impl WrittenArgs {
    /// Places the taxels, and writes what `text` says of them and of the frame that they are in.
    fn write(&self, text: impl Fn(&Layout, &Surface, Option<&str>) -> String) -> Result<()> {
        let DressedArgs { body, garment } = &self.dressed;
        let read = body::read(body)?;
        let files =
            [Some(body), Some(garment), self.posed.robot.as_ref()].into_iter().flatten().map(Path::new);
        let output = Output::stream(&self.output, self.force, files.chain(read.lists()))?;
        let (garment, layout) = self.dressed.garment()?;
        let (surface, frame) = self.posed.surface(&read, &garment, &layout)?;
        Ok(output.write(text(&layout, &surface, frame.as_deref()).as_bytes())?)
    }
}

#[derive(Debug, Clone, Subcommand)]
enum BodyTask {
    /// Check a body file: how each panel lies on its link; errors name line and key
    #[command(
        after_help = "Examples:\n  taxel body check reference\n  taxel body check reference --robot reference"
    )]
    Check {
        /// The garment and the body that are checked.
        #[command(flatten)]
        dressed: DressedArgs,
        /// The robot, whose links it must lie on: a URDF file or `reference`
        #[arg(long, value_name = "URDF")]
        robot: Option<String>,
        /// Print JSON instead of a table
        #[arg(long)]
        json: bool,
    },
    /// Draw the taxels from three sides: each link, or the whole robot in a posture
    #[command(
        after_help = "Examples:\n  taxel body show reference -o body.svg\n  taxel body show reference --robot reference \
                      --joints left_elbow=90deg -o body.svg"
    )]
    Show(WrittenArgs),
    /// Write the place and the normal of every taxel as CSV, in the frame of its link or of one for all
    #[command(
        after_help = "Examples:\n  taxel body places reference -o places.csv\n  taxel body places reference --robot reference \
                      --joints waist=30deg --frame base -o -"
    )]
    Places(WrittenArgs),
    /// Lay a panel over a link's mesh as cloth, and write the list of its taxels
    #[command(
        after_help = "Examples:\n  taxel body drape torso.stl --scale 0.001 --panel chest --at 0.06,0,0.2 -o chest.txt\n  taxel body \
                      drape --robot robot.urdf --link torso --panel chest --at 0.06,0,0.2 -o chest.txt"
    )]
    Drape(DrapeArgs),
    /// Learn what the garment's folds press where joints bend, from recordings in which nothing touches it
    #[command(
        after_help = "Example:\n  taxel body learn monday.mcap tuesday.mcap wednesday.mcap -o elbows.folds\n  taxel live --folds elbows.folds"
    )]
    Learn(BodyLearnArgs),
    /// Find how each panel sits, by touches whose place on the robot is known, and write the body file
    /// that says so
    #[command(
        after_help = "Examples:\n  taxel body fit reference --marks marks.txt -o fitted.toml\n  taxel body fit reference --pick 5 -o \
                      fitted.toml\n  taxel body fit body.toml --touches touches.csv -o fitted.toml"
    )]
    Fit(FitArgs),
}

/// Runs the command.
pub fn run(args: BodyArgs) -> Result<()> {
    match &args.what {
        BodyTask::Check { dressed, robot, json } => {
            let read = body::read(&dressed.body)?;
            let (garment, layout) = dressed.garment()?;
            let robot = robot.as_deref().map(robot::read).transpose()?.map(Arc::new);
            let surface = match &robot {
                Some(robot) => read.on_robot(&garment, &layout, robot.clone())?.surface().clone(),
                None => read.surface(&garment, &layout)?,
            };
            read.check_overlap(&surface, &layout)?;
            print!("{}", check::text(&layout, &surface, robot.as_deref(), *json));
            Ok(())
        }
        BodyTask::Drape(args) => drape::run(args),
        BodyTask::Learn(args) => learn::run(args),
        BodyTask::Fit(args) => fit::run(args),
        BodyTask::Show(written) => written.write(show::picture),
        BodyTask::Places(written) => written.write(|_, surface, _| body::text(surface)),
    }
}
