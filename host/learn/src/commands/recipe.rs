//! Training settings of bases of shapes, on the command line.

use crate::shapes::train::Recipe;
use taxel_core::shape::GALLERY_PROTOTYPES;

/// Training settings.
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
