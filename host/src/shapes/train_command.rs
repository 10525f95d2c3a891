//! `taxel shapes train`: trains a base on labelled images.

use super::base::{Base, Card, Source};
use super::cross::FOLDS;
use super::data::{Example, Examples, ImagesArgs};
use super::train::Recipe;
use super::trained::trained;
use crate::learn::confusion::Confusion;
use crate::learn::fingerprint::Fingerprint;
use crate::output::{Force, Output};
use anyhow::{Result, ensure};
use std::path::PathBuf;
use taxel_core::shape::{GALLERY_CLASSES, GALLERY_PROTOTYPES, Recognised};

/// Arguments of `taxel shapes train`.
#[derive(Debug, Clone, clap::Args)]
pub struct TrainArgs {
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
    pub force: Force,
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
            select: self.select,
            prototypes: self.prototypes.into(),
            ..Recipe::default()
        }
    }
}

/// Runs the command.
pub fn run(args: TrainArgs) -> Result<()> {
    let inputs = [Some(&args.images.images), args.images.labels.as_ref()];
    let output = Output::stream(&args.output, args.force, inputs.into_iter().flatten())?;
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

/// A base from examples that were read from `images`.
pub fn train(images: &ImagesArgs, examples: &Examples, recipe: &Recipe) -> Result<Base> {
    check(examples)?;
    let list: Vec<&Example> = examples.list.iter().collect();
    eprintln!("learning {} classes from {} images, and in {FOLDS} folds", examples.names.len(), list.len());
    let (gallery, found) = trained(&list, &examples.names, recipe);
    let confusion = counted(&list, &examples.names, &found);
    let source = Source {
        file: images.images.file_name().unwrap_or_default().to_string_lossy().into_owned(),
        fingerprint: Fingerprint::of(&images.images)?.to_string(),
        sets: images.set.clone(),
        images: list.len(),
    };
    let split = format!("{FOLDS} folds by shape, stratified");
    let card = Card { split, accuracy: confusion.accuracy(), confusion: confusion.counts };
    Ok(Base::new(examples.view, source, card, gallery))
}

/// Checks that there are enough examples, and not too many classes for a board.
pub fn check(examples: &Examples) -> Result<()> {
    let classes = examples.names.len();
    ensure!(
        classes <= GALLERY_CLASSES,
        "there are {classes} classes, a board holds at most {GALLERY_CLASSES}"
    );
    for (class, name) in examples.names.iter().enumerate() {
        let members = examples.list.iter().filter(|example| example.class == class).count();
        ensure!(members >= FOLDS, "class {name} has {members} images, at least {FOLDS} are needed");
        ensure!(name.len() <= 16, "the name {name:?} is longer than 16 bytes");
    }
    Ok(())
}

/// Confusion of classified examples.
pub fn counted(examples: &[&Example], names: &[String], found: &[Recognised]) -> Confusion {
    let mut confusion = Confusion::new(names, names);
    for (example, found) in examples.iter().zip(found) {
        confusion.count(example.class, found.class.map(usize::from));
    }
    confusion
}
