//! `taxel shapes train`: trains a base on labelled images.

use super::images::ImagesArgs;
use crate::watch::Overwrite;
use anyhow::Result;
use std::path::PathBuf;
use taxel::files::output::Output;
use taxel::learn::shapes::train::Recipe;
use taxel::learn::shapes::trained::train;
use taxel_core::shape::GALLERY_PROTOTYPES;

/// Arguments of `taxel shapes train`.
#[derive(Debug, Clone, clap::Args)]
pub struct ShapesTrainArgs {
    /// Training images.
    #[command(flatten)]
    pub images: ImagesArgs,
    /// Training settings.
    #[command(flatten)]
    pub recipe: RecipeArgs,
    /// File to write
    #[arg(short, long, value_name = "BASE")]
    pub output: PathBuf,
    /// Whether an existing output is replaced.
    #[command(flatten)]
    pub force: Overwrite,
}

/// Training settings on the command line.
#[derive(Debug, Clone, clap::Args)]
pub struct RecipeArgs {
    /// Largest number of prototypes
    #[arg(long, value_name = "N", default_value_t = GALLERY_PROTOTYPES as u8, value_parser = clap::value_parser!(u8).range(2..=GALLERY_PROTOTYPES as i64))]
    pub prototypes: u8,
    /// Neighbours that vote
    #[arg(long, value_name = "K", default_value_t = 3, value_parser = clap::value_parser!(u8).range(1..=9))]
    pub k: u8,
    /// Shrinkage of the scatter within classes towards that of unrelated measures, 0 to 1: more for fewer
    /// images
    #[arg(long, value_name = "SHARE", default_value_t = 0.05, value_parser = share)]
    pub shrinkage: f64,
    /// Share of the way by which prototypes are moved towards the mean of their class, 0 to 1: more for fewer
    /// images
    #[arg(long, value_name = "SHARE", default_value_t = 0.0, value_parser = share)]
    pub pull: f64,
    /// Use only helpful measures, selected in each fold; for fewer than about 300 images
    #[arg(long)]
    pub select: bool,
}

/// A number from 0 to 1.
fn share(text: &str) -> Result<f64, String> {
    let number = text.parse::<f64>().ok().filter(|number| (0.0..=1.0).contains(number));
    number.ok_or_else(|| "expected a number from 0 to 1".into())
}

impl RecipeArgs {
    /// Settings with all measures.
    pub fn recipe(&self) -> Recipe {
        Recipe {
            k: self.k,
            shrinkage: self.shrinkage,
            pull: self.pull,
            select: self.select,
            prototypes: self.prototypes.into(),
            ..Recipe::default()
        }
    }
}

/// Runs the command.
pub fn run(args: ShapesTrainArgs) -> Result<()> {
    let inputs = [Some(&args.images.images), args.images.labels.as_ref()];
    let output = Output::stream(&args.output, args.force, inputs.into_iter().flatten())?;
    eprintln!("reading {}", args.images.images.display());
    let examples = args.images.images().read(None)?;
    let base = train(&args.images.images(), &examples, &args.recipe.recipe())?;
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
