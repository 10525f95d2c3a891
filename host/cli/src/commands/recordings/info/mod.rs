//! `taxel info`: shows a recording's contents.

mod found;

use super::repair::RepairArgs;
use anyhow::Result;
use clap::Args;
use found::Contents;
use std::path::PathBuf;
use taxel::text::words::printable_json;

/// Shown below the help.
const EXAMPLES: &str = "Examples:
  taxel info touch.mcap
  taxel info touch.mcap --repair";

/// Show a recording's contents; repair a damaged or truncated one
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLES)]
pub struct InfoArgs {
    /// Recording: .mcap
    pub file: PathBuf,
    /// Print JSON instead of a table
    #[arg(long)]
    pub json: bool,
    /// Read every message, also of a large file: is anything damaged or lost?
    #[arg(long)]
    pub check: bool,
    /// The repair.
    #[command(flatten)]
    pub repair: RepairArgs,
}

/// Runs the command.
pub fn run(args: InfoArgs) -> Result<()> {
    let repaired = args.repair.repair;
    let file = if repaired { args.repair.run(&args.file)? } else { args.file };
    let found = Contents::of(&file, args.check, repaired)?;
    if args.json {
        println!("{}", printable_json(&found.json().to_string()));
    } else {
        print!("{}", found.table());
    }
    Ok(())
}
