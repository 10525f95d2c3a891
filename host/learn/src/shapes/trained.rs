//! Trains a complete gallery.

use super::calibrate::calibrate;
use super::cross::{FOLDS, SEED, deal, predict};
use super::data::{Example, Examples, Images};
use super::select::select;
use super::train::{Recipe, fit};
use anyhow::{Result, ensure};
use taxel::files::bases::BoardGallery;
use taxel::files::bases::{Base, Card, ImagesFile};
use taxel::learn::confusion::Confusion;
use taxel::learn::fingerprint::Fingerprint;
use taxel_core::shape::{GALLERY_CLASSES, Recognised};

/// A gallery of all examples, completed by five folds of them. Also returns the results of the folds.
pub fn trained(examples: &[&Example], names: &[String], recipe: &Recipe) -> (BoardGallery, Vec<Recognised>) {
    let recipe = &if recipe.select { select(examples, names, recipe) } else { recipe.clone() };
    let found = predict(examples, &deal(examples, FOLDS, SEED), |others| fit(others, names, recipe));
    let mut gallery = fit(examples, names, recipe);
    calibrate(&mut gallery, examples, &found);
    (gallery, found)
}

/// A base from examples that were read from `images`.
pub fn train(images: &Images, examples: &Examples, recipe: &Recipe) -> Result<Base> {
    check(examples)?;
    let list: Vec<&Example> = examples.list.iter().collect();
    eprintln!("learning {} classes from {} images, and in {FOLDS} folds", examples.names.len(), list.len());
    let (gallery, found) = trained(&list, &examples.names, recipe);
    let confusion = counted(&list, &examples.names, &found);
    let source = ImagesFile {
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
