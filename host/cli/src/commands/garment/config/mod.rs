//! `taxel config`: creates garment and scene files, checks them, and prints their schemas; lists the scripts of
//! touches.

mod check;
mod robot;
mod scene;
mod touches;

pub use check::check;

use crate::watch::Overwrite;
use anyhow::Result;
use clap::{Args, Subcommand, ValueEnum};
use std::path::{Path, PathBuf};
use taxel::files::output::{Force, Output};
use taxel::files::{garments, input, schemas};
use touches::TouchesArgs;

/// Kind of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum FileKind {
    /// panels, blocks, pins, links of the body
    Garment,
    /// limits, map, reactions, stream of a deployment
    Scene,
    /// touches of a simulated garment: place, time, force
    Touches,
    /// boards of a robot, and what they are asked
    Robot,
}

impl FileKind {
    /// JSON schema of such a file.
    pub fn schema(self) -> &'static str {
        match self {
            FileKind::Garment => schemas::GARMENT,
            FileKind::Scene => schemas::SCENE,
            FileKind::Touches => schemas::TOUCHES,
            FileKind::Robot => schemas::ROBOT,
        }
    }

    /// Name of the schema's file beside such a file.
    fn schema_file(self) -> &'static str {
        match self {
            FileKind::Garment => "taxel-garment.schema.json",
            FileKind::Scene => "taxel-scene.schema.json",
            FileKind::Touches => "taxel-touches.schema.json",
            FileKind::Robot => "taxel-robot.schema.json",
        }
    }
}

/// Shown below the help.
const EXAMPLES: &str = "Examples:
  taxel config new mine.toml --like block-4x16
  taxel config check mine.toml --scene scene.toml
  taxel config schema
  taxel config touches";

/// Create and check garment and scene files; list the scripts of touches
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLES)]
pub struct ConfigArgs {
    #[command(subcommand)]
    what: What,
}

#[derive(Debug, Clone, Subcommand)]
enum What {
    /// Create a garment file, and beside it its schema for editors
    #[command(after_help = "Example:\n  taxel config new mine.toml --like reference")]
    New {
        /// The file to write
        file: PathBuf,
        /// Whether an existing file is replaced.
        #[command(flatten)]
        force: Overwrite,
        /// The garment to begin with: a preset or a TOML file
        #[arg(long, value_name = "G", default_value = "block-4x16")]
        like: String,
    },
    /// Create a scene file with the shipped values, and beside it its schema
    #[command(after_help = "Example:\n  taxel config scene calm.toml")]
    Scene {
        /// The file to write
        file: PathBuf,
        /// Whether an existing file is replaced.
        #[command(flatten)]
        force: Overwrite,
    },
    /// Check a garment file, and a scene file with it, or a robot's file; errors name line and key
    #[command(
        after_help = "Examples:\n  taxel config check mine.toml --scene scene.toml\n  taxel config check robot.toml"
    )]
    Check {
        /// The garment: a TOML file or a preset; or a robot's file, whose boards are listed
        #[arg(value_name = "FILE")]
        file: String,
        /// Print JSON instead of tables (for a robot's file)
        #[arg(long)]
        json: bool,
        /// A scene for this garment
        #[arg(long, value_name = "FILE")]
        scene: Option<PathBuf>,
    },
    /// Print the JSON schema of garment files, scene files or scripts of touches
    #[command(after_help = "Example:\n  taxel config schema scene > taxel-scene.schema.json")]
    Schema {
        /// Kind of file
        #[arg(value_enum, default_value_t = FileKind::Garment)]
        of: FileKind,
    },
    /// List the scripts of touches that a simulation plays
    #[command(after_help = "Examples:\n  taxel config touches\n  taxel config touches --json")]
    Touches(TouchesArgs),
}

/// Runs the command.
pub fn run(args: ConfigArgs) -> Result<()> {
    match &args.what {
        What::New { file, force, like } => {
            let text = garments::read(like)?.text;
            let begun = format!("# Like {like}. {}\n", next(file, ""));
            let output = Output::file(file, *force, [like])?;
            begin(output, (*force).into(), FileKind::Garment, &(begun + without_schema(&text)))
        }
        What::Scene { file, force } => {
            let next = next(Path::new("GARMENT.toml"), &format!(" --scene {}", file.display()));
            let comment = format!("# The shipped scene; missing keys keep these values. {next}\n");
            let none: [&Path; 0] = [];
            let output = Output::file(file, *force, none)?;
            begin(output, (*force).into(), FileKind::Scene, &(comment + &scene::text()?))
        }
        What::Check { file, json, .. } if is_robot(file) => robot::run(Path::new(file), *json),
        What::Check { file, scene, .. } => {
            println!("{}", check(file, scene.as_deref())?);
            Ok(())
        }
        What::Schema { of } => {
            print!("{}", of.schema());
            Ok(())
        }
        What::Touches(args) => touches::run(args),
    }
}

/// True if the file lists the boards of a robot.
fn is_robot(file: &str) -> bool {
    input::text(Path::new(file)).is_ok_and(|text| text.contains("[[boards]]"))
}

/// A file's text without the first line that names its schema; a new file gets such a line of its own.
fn without_schema(text: &str) -> &str {
    match text.strip_prefix("#:schema") {
        Some(rest) => rest.split_once('\n').map_or("", |(_, rest)| rest),
        None => text,
    }
}

fn next(file: &Path, more: &str) -> String {
    format!("Change it, then: taxel config check {}{more}", file.display())
}

/// Writes a file, and its schema beside it.
fn begin(output: Output, force: Force, kind: FileKind, text: &str) -> Result<()> {
    let file = output.name().to_path_buf();
    let schema = file.with_file_name(kind.schema_file());
    let is_known = input::bytes(&schema).is_ok_and(|known| known == kind.schema().as_bytes());
    let beside = (!is_known).then(|| Output::file(&schema, force, [&file])).transpose()?;
    // First the schema: if the file cannot be written, the command can be repeated unchanged.
    beside.map_or(Ok(()), |beside| beside.write(kind.schema().as_bytes()))?;
    // Editors look for `#:schema` in the first line.
    output.write(format!("#:schema ./{}\n{text}", kind.schema_file()).as_bytes())?;
    println!("{} and {} are written.", file.display(), schema.display());
    Ok(())
}
