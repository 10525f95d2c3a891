//! Adds examples to a base.

use super::cluster::centres;
use super::confidence::count;
use crate::error::{LearnError, Result};
use crate::files::bases::{Base, LEFT_OUT};
use crate::learn::confusion::Confusion;
use taxel_core::format::name;
use taxel_core::shape::{Exemplar, GALLERY_CLASSES, GALLERY_PROTOTYPES, Point, Recognised};

/// Checks that a board can hold a class of this name.
pub fn check_name(class: &str) -> Result<()> {
    let bytes = class.len();
    require!(
        (1..=16).contains(&bytes),
        LearnError::Data,
        "the name {class:?} has {bytes} bytes, expected 1 to 16"
    );
    Ok(())
}

/// Adds at most `most` prototypes of a class with a [checked](check_name) name. Returns their number.
pub fn extend(base: &mut Base, class: &str, points: &[Point], most: usize) -> Result<usize> {
    let added = centres(points, most.max(1));
    let (count, left) = (added.len(), GALLERY_PROTOTYPES - base.gallery.prototypes.len());
    require!(
        count <= left,
        LearnError::Data,
        "{count} prototypes do not fit, there is room for {left}: prune the base or add fewer"
    );
    let index = named(base, class)?;
    for at in added {
        let _ = base.gallery.prototypes.push(Exemplar { class: index as u8, at });
    }
    if base.card.split == LEFT_OUT {
        judge(base);
    }
    Ok(count)
}

/// Index of a class, which is added if needed.
fn named(base: &mut Base, class: &str) -> Result<usize> {
    let names = &mut base.gallery.names;
    if let Some(known) = names.iter().position(|known| known == class) {
        return Ok(known);
    }
    let room = names.push(name(class)).is_ok();
    require!(
        room,
        LearnError::TooLarge,
        "the base holds {GALLERY_CLASSES} classes, which is all that a board holds"
    );
    // A new row and column of the card: this class has not been tested.
    base.card.confusion.push(Vec::new());
    let columns = names.len() + 1;
    for row in &mut base.card.confusion {
        let none = row.pop().unwrap_or(0);
        row.resize(columns - 1, 0);
        row.push(none);
    }
    Ok(names.len() - 1)
}

/// Classifies each prototype by the others: fills the card and the table of confidence.
fn judge(base: &mut Base) {
    let all = &base.gallery.prototypes;
    let by_others = |out: usize| {
        let others = all.iter().enumerate().filter(|(at, _)| *at != out).map(|(_, exemplar)| *exemplar);
        let mut gallery = base.gallery.clone();
        gallery.prototypes = others.collect();
        gallery.recognise_at(&all[out].at)
    };
    let found: Vec<Recognised> = (0..all.len()).map(by_others).collect();
    let hits: Vec<bool> =
        found.iter().zip(all).map(|(found, exemplar)| found.class == Some(exemplar.class)).collect();
    let mut confusion = Confusion::new(&base.names(), &base.names());
    for (found, exemplar) in found.iter().zip(all) {
        confusion.count(exemplar.class.into(), found.class.map(usize::from));
    }
    // A few right answers do not guarantee the next.
    let right = hits.iter().filter(|hit| **hit).count() as f64;
    let mean = (right + 1.0) / (hits.len() as f64 + 2.0);
    count(&mut base.gallery.confidence, &found, &hits, mean);
    (base.card.accuracy, base.card.confusion) = (confusion.accuracy(), confusion.counts);
}
