//! `taxel fcm check`: finds faults of a map, and what its author may not have intended.

use anyhow::{Result, bail};
use taxel::fcm::check::{check, in_words, report};
use taxel::fcm::{load, wrong};

/// Arguments of `taxel fcm check`.
#[derive(Debug, Clone, clap::Args)]
pub struct MapCheckArgs {
    /// TOML file, or the name of a shipped map
    pub map: String,
    /// Print JSON instead of sentences
    #[arg(long)]
    pub json: bool,
}

/// Runs the command.
pub fn run(args: MapCheckArgs) -> Result<()> {
    let text = load::text(&args.map)?;
    let map = load::parse(&text, &args.map)?;
    let found = check(&map).map_err(|error| wrong::located(error, &text, &args.map))?;
    if args.json {
        println!("{}", report(&map, &found));
    } else {
        print!("{}", in_words(&map, &found));
    }
    match found.faults.first() {
        Some(fault) => bail!("{}: {fault}", args.map),
        None => Ok(()),
    }
}
