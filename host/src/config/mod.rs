//! `taxel config`: the file of a garment, begun, checked, and explained to editors.

mod check;
mod line;

pub use check::check;

use crate::garments;
use crate::sim;
use anyhow::{Context, Result, ensure};
use clap::{Args, Subcommand};
use std::fs;
use std::path::{Path, PathBuf};

/// The JSON schema of a garment's file.
pub const SCHEMA: &str = include_str!("../../schemas/garment.json");
/// Name of the schema's file beside a garment's.
const SCHEMA_FILE: &str = "taxel-garment.schema.json";

/// What `taxel config` takes.
#[derive(Debug, Clone, Args)]
pub struct ConfigArgs {
    #[command(subcommand)]
    what: What,
}

#[derive(Debug, Clone, Subcommand)]
enum What {
    /// Begin a garment's file, and its schema beside it, which editors read
    #[command(after_help = "Example:\n  taxel config new mine.toml --like reference")]
    New {
        /// The file to write; it must not be there yet
        file: PathBuf,
        /// The garment to begin with: a preset or a TOML file
        #[arg(long, value_name = "G", default_value = "block-4x16")]
        like: String,
    },
    /// Check a garment's file, and a scene's with it; errors name line and key
    #[command(after_help = "Example:\n  taxel config check mine.toml --scene scene.toml")]
    Check {
        /// The garment's file
        file: PathBuf,
        /// A scene that the garment is to be used for
        #[arg(long, value_name = "FILE")]
        scene: Option<PathBuf>,
    },
    /// Print the JSON schema of a garment's file
    #[command(after_help = "Example:\n  taxel config schema > taxel-garment.schema.json")]
    Schema,
}

/// Runs the command.
pub fn run(args: &ConfigArgs) -> Result<()> {
    match &args.what {
        What::New { file, like } => new(file, like),
        What::Check { file, scene } => {
            println!("{}", check(file, scene.as_deref())?);
            Ok(())
        }
        What::Schema => {
            print!("{SCHEMA}");
            Ok(())
        }
    }
}

fn new(file: &Path, like: &str) -> Result<()> {
    let garment = sim::garment(like)?;
    ensure!(!file.exists(), "{} is there already: give another name, or remove it", file.display());
    let comment = format!(
        ":schema ./{SCHEMA_FILE}\nLike {like}. Change it, then: taxel config check {}",
        file.display()
    );
    // Editors look for `#:schema` without a space.
    let text = garments::text(&garment, &comment)?.replacen("# :schema", "#:schema", 1);
    fs::write(file, text).with_context(|| format!("{} cannot be written", file.display()))?;
    let schema = file.with_file_name(SCHEMA_FILE);
    fs::write(&schema, SCHEMA).with_context(|| format!("{} cannot be written", schema.display()))?;
    println!("{} and {} are written.", file.display(), schema.display());
    Ok(())
}
