//! `taxel-learn shapes train`: trains a base on labelled images.

use super::recipe::RecipeArgs;
use crate::shapes::data::Images;
use crate::shapes::trained::train;
use anyhow::Result;
use std::path::PathBuf;
use taxel::files::output::{Force, Output};

/// Arguments of `taxel-learn shapes train`.
#[derive(Debug, Clone, clap::Args)]
pub struct ShapesTrainArgs {
    /// Training images.
    #[command(flatten)]
    pub images: Images,
    /// Training settings.
    #[command(flatten)]
    pub recipe: RecipeArgs,
    /// File to write
    #[arg(short, long, value_name = "BASE")]
    pub output: PathBuf,
    /// Replace the output if it exists
    #[arg(long)]
    pub force: bool,
}

/// Runs the command.
pub fn run(args: &ShapesTrainArgs) -> Result<()> {
    let inputs = [Some(&args.images.images), args.images.labels.as_ref()];
    let output = Output::stream(&args.output, Force { force: args.force }, inputs.into_iter().flatten())?;
    eprintln!("reading {}", args.images.images.display());
    let examples = args.images.read(None)?;
    let base = train(&args.images, &examples, &args.recipe.recipe())?;
    base.save(output)?;
    let gallery = &base.gallery;
    eprintln!(
        "{}: {} classes, {} prototypes in {} dimensions from {} images; {:.1} % right in {}",
        args.output.display(),
        gallery.names.len(),
        gallery.prototypes.len(),
        gallery.space.weights.len(),
        examples.list.len(),
        100.0 * base.card.accuracy,
        base.card.split,
    );
    Ok(())
}
