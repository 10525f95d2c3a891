//! `taxel fcm learn`: improves weights by labelled touches, within the limits set by the expert.

use crate::commands::print_beside;
use crate::watch::Overwrite;
use anyhow::Result;
use std::path::PathBuf;
use taxel::fcm::board::BoardMap;
use taxel::fcm::learn::{learn, report, text};
use taxel::fcm::{load, touches};
use taxel::files::output::Output;

/// Arguments of `taxel fcm learn`.
#[derive(Debug, Clone, clap::Args)]
pub struct MapLearnArgs {
    /// TOML file, or the name of a shipped map
    pub map: String,
    /// CSV file: a column for each input concept (activations), `label` (an intention, or none), optionally
    /// `group`
    #[arg(long)]
    pub touches: PathBuf,
    /// File to write
    #[arg(short, long)]
    pub output: PathBuf,
    /// Whether an existing output is replaced.
    #[command(flatten)]
    pub force: Overwrite,
    /// Folds of the cross-validation: by group, if the file has groups
    #[arg(long, default_value_t = 5, value_parser = clap::value_parser!(u8).range(2..=100))]
    pub folds: u8,
    /// Print JSON instead of sentences
    #[arg(long)]
    pub json: bool,
}

/// Runs the command.
pub fn run(args: MapLearnArgs) -> Result<()> {
    let inputs = [PathBuf::from(&args.map), args.touches.clone()];
    let output = Output::stream(&args.output, args.force, inputs)?;
    let is_standard = output.is_standard();
    let file = load::map(&args.map)?;
    let touches = touches::read(&args.touches, &file, &BoardMap::build(&file)?)?;
    let learned = learn(&file, &touches, args.folds.into())?;
    load::save(&learned.map, output)?;
    let text = match args.json {
        true => format!("{}\n", report(&file, &touches, &learned)),
        false => text(&file, &touches, &learned),
    };
    print_beside(is_standard, &text);
    Ok(())
}
