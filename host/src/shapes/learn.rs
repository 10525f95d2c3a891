//! `taxel shapes learn`: one more class for a base, or more of a class, by images of it.

use super::base::{Base, Source};
use super::cluster::centres;
use super::view::ViewArgs;
use crate::arrays;
use crate::learn::fingerprint::Fingerprint;
use anyhow::{Result, ensure};
use std::path::PathBuf;
use taxel_core::format::name;
use taxel_core::shape::{Exemplar, GALLERY_CLASSES, GALLERY_PROTOTYPES, Point};

/// Arguments of `taxel shapes learn`.
#[derive(Debug, Clone, clap::Args)]
pub struct LearnArgs {
    /// What it is called, at most 16 bytes
    pub name: String,
    /// Images or frames of it: .npz, .npy or .csv
    #[arg(long, value_name = "FILE")]
    pub images: PathBuf,
    /// Which array of an .npz with several
    #[arg(long, value_name = "NAME")]
    pub array: Option<String>,
    /// Base to add it to: a file, or the name of one that is shipped
    #[arg(long, value_name = "BASE")]
    pub base: PathBuf,
    /// Most prototypes to add
    #[arg(long, value_name = "N", default_value_t = 8)]
    pub prototypes: usize,
    /// File to write
    #[arg(short, long, value_name = "BASE")]
    pub output: PathBuf,
}

/// Runs the command.
pub fn run(args: LearnArgs) -> Result<()> {
    let mut base = Base::open(&args.base)?;
    let view = ViewArgs::default().build(Some(base.view), 0);
    let frames = arrays::read(&args.images, args.array.as_deref())?;
    let touched = frames.iter().filter(|image| image.iter().any(|value| *value >= view.threshold));
    let place = |image| base.gallery.space.place(&view.describe(image, frames.columns));
    let points: Vec<Point> = touched.map(place).collect();
    let file = args.images.display();
    ensure!(!points.is_empty(), "{file}: nothing touches: no value reaches {} counts", view.threshold);
    let added = teach(&mut base, &args.name, &points, args.prototypes)?;
    base.trained_on.push(Source {
        file: args.images.file_name().unwrap_or_default().to_string_lossy().into_owned(),
        fingerprint: Fingerprint::of(&args.images)?.to_string(),
        sets: args.array.into_iter().collect(),
        images: points.len(),
    });
    base.save(&args.output)?;
    eprintln!("{}: {added} prototypes of {} from {} images", args.output.display(), args.name, points.len());
    Ok(())
}

/// Adds prototypes of a class; how many.
fn teach(base: &mut Base, class: &str, points: &[Point], most: usize) -> Result<usize> {
    let gallery = &mut base.gallery;
    ensure!(
        !class.is_empty() && class.len() <= 16,
        "the name {class:?} has {} bytes, expected 1 to 16",
        class.len()
    );
    let index = gallery.names.iter().position(|known| known == class).unwrap_or(gallery.names.len());
    if index == gallery.names.len() {
        let room = gallery.names.push(name(class)).is_ok();
        ensure!(room, "the base holds {GALLERY_CLASSES} classes, which is all that a board holds");
        // The card has a row and a column more: nobody has tested this class.
        base.card.confusion.push(Vec::new());
        let columns = gallery.names.len() + 1;
        for row in &mut base.card.confusion {
            let none = row.pop().unwrap_or(0);
            row.resize(columns - 1, 0);
            row.push(none);
        }
    }
    let added = centres(points, most.max(1));
    let left = GALLERY_PROTOTYPES - gallery.prototypes.len();
    let count = added.len();
    ensure!(
        count <= left,
        "{count} prototypes do not fit, there is room for {left}: prune the base, or add fewer"
    );
    for at in added {
        let _ = gallery.prototypes.push(Exemplar { class: index as u8, at });
    }
    Ok(count)
}
