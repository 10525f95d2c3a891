//! Bases of shapes: a gallery and its origin, as a file.

pub mod view;

use crate::error::{Context, FileError, LearnError, Result, UsageError};
use crate::files::input;
use crate::files::output::Output;
use crate::text::words;
use serde::{Deserialize, Serialize};
use std::path::Path;
use taxel_core::shape::{DIMENSIONS, GALLERY_CLASSES, GALLERY_PROTOTYPES, Gallery, MEASURE_NAMES, MEASURES};
use view::View;

/// A gallery of the size that a board holds.
pub type BoardGallery = Gallery<GALLERY_PROTOTYPES>;

/// First value of the file.
const KIND: &str = "taxel shapes 1";
/// Size limit of a file, far above the largest base.
const LONGEST: u64 = 1 << 20;

/// A base that is part of the program.
struct Shipped {
    name: &'static str,
    /// Rows and columns of the images that it is for; none for any.
    grid: Option<(u16, u16)>,
    text: &'static str,
}

macro_rules! shipped {
    ($name:literal, $grid:expr) => {
        Shipped { name: $name, grid: $grid, text: include_str!(concat!("../../../bases/", $name, ".json")) }
    };
}

/// Drawn shapes, on all grids and on one, and the objects of tactnet.
const SHIPPED: [Shipped; 5] = [
    shipped!("drawn", None),
    shipped!("drawn-4x16", Some((4, 16))),
    shipped!("drawn-16x16", Some((16, 16))),
    shipped!("drawn-32x64", Some((32, 64))),
    shipped!("objects", None),
];

/// Names of the shipped bases.
pub fn shipped_names() -> impl Iterator<Item = &'static str> {
    SHIPPED.iter().map(|shipped| shipped.name)
}

/// Test of a base that was taught from nothing: each of its prototypes by the others.
pub const LEFT_OUT: &str = "each prototype left out in turn";

/// A base.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Base {
    /// Kind and version of the file.
    pub kind: String,
    /// Measures of the space, in order.
    pub measures: Vec<String>,
    /// Which part of an image is the touch.
    pub view: View,
    /// Training data.
    pub trained_on: Vec<ImagesFile>,
    /// Results on data left out of training.
    pub card: Card,
    /// The gallery.
    pub gallery: BoardGallery,
}

/// A file of training data.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ImagesFile {
    /// Name without folders.
    pub file: String,
    /// Fingerprint of its content; empty for touches on a board.
    pub fingerprint: String,
    /// Sets of the file that were used; empty for all.
    pub sets: Vec<String>,
    /// Number of examples.
    pub images: usize,
}

/// Accuracy of a base.
#[derive(Debug, Default, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Card {
    /// Method of testing.
    pub split: String,
    /// Share of right answers.
    pub accuracy: f64,
    /// A row for each class, a column for each answer; "none" is last.
    pub confusion: Vec<Vec<u32>>,
}

impl Base {
    /// A new base.
    pub fn new(view: View, trained_on: ImagesFile, card: Card, gallery: BoardGallery) -> Base {
        let measures = MEASURE_NAMES.map(String::from).to_vec();
        Base { kind: KIND.into(), measures, view, trained_on: vec![trained_on], card, gallery }
    }

    /// A base without classes, with the view of `drawn`.
    pub fn empty() -> Result<Base> {
        let mut base = Base::open(Path::new(SHIPPED[0].name))?;
        base.gallery.names.clear();
        base.gallery.prototypes.clear();
        // With few examples, only the nearest votes.
        base.gallery.k = 1;
        base.card = Card { split: LEFT_OUT.into(), ..Card::default() };
        Ok(base)
    }

    /// Opens the shipped base of this name, else the file.
    pub fn open(name: &Path) -> Result<Base> {
        if let Some(shipped) = SHIPPED.iter().find(|shipped| Path::new(shipped.name) == name) {
            return Base::parse(shipped.text).with_context(|| format!("base {}", shipped.name));
        }
        let unread = |error| FileError::read(name, error);
        let read = || {
            let size = std::fs::metadata(name).map_err(unread).context("cannot be read")?.len();
            require!(
                size <= LONGEST,
                LearnError::Base,
                "is not a base of shapes: it has {size} bytes, expected at most {LONGEST}"
            );
            Base::parse(&input::text(name).context("cannot be read")?)
        };
        // A text that cannot be a path is a name.
        let said = name.to_str().filter(|said| !name.exists() && !said.contains(['.', '/', '\\']));
        if let Some(said) = said {
            let known = words::unknown("base", said, shipped_names());
            fail!(UsageError::Unknown, "{known}, or give a .json file");
        }
        read().with_context(|| name.display().to_string())
    }

    /// Shipped base with most of these classes; among equals the one for images with these rows and columns.
    pub fn shipped_for(classes: &[String], grid: Option<(u16, u16)>) -> Result<(&'static str, Base)> {
        let known = |base: &Base| {
            let names = base.gallery.names.iter();
            names.filter(|name| classes.iter().any(|class| class == name.as_str())).count()
        };
        let mut best: Option<((usize, bool), &'static str, Base)> = None;
        for Shipped { name, grid: own, text } in &SHIPPED {
            let base = Base::parse(text).with_context(|| format!("base {name}"))?;
            let worth = (known(&base), own.is_some());
            let fits = worth.0 > 0 && (own.is_none() || *own == grid);
            if fits && best.as_ref().is_none_or(|(most, ..)| worth > *most) {
                best = Some((worth, name, base));
            }
        }
        let (_, name, base) = best.ok_or_else(|| {
            let classes = classes.join(", ");
            error!(LearnError::Data, "no shipped base knows any of the classes {classes}: give --base")
        })?;
        Ok((name, base))
    }

    /// Parses the text of a file. Error if a board could not use it.
    pub fn parse(text: &str) -> Result<Base> {
        let value: serde_json::Value = serde_json::from_str(text).context("is not a base of shapes")?;
        match value.get("kind").and_then(|kind| kind.as_str()) {
            Some(KIND) => {}
            Some(other) => fail!(LearnError::Version, "is of kind {other:?}, expected {KIND:?}"),
            None => fail!(LearnError::Base, "is not a base of shapes: it has no `kind`"),
        }
        check_sizes(&value)?;
        let base: Base = serde_json::from_value(value)
            .map_err(|error| error!(LearnError::Base, "is not a base of shapes: {}", words::cause(&error)))?;
        require!(
            base.measures == MEASURE_NAMES,
            LearnError::Base,
            "was made for other measures than this program has"
        );
        base.gallery.check().map_err(|invalid| error!(LearnError::Base, "{invalid}"))?;
        let classes = base.gallery.names.len();
        let fits = base.card.confusion.len() == classes
            && base.card.confusion.iter().all(|row| row.len() == classes + 1);
        require!(fits, LearnError::Base, "has a card of other classes than its own");
        Ok(base)
    }

    /// Text of the file; [`Base::parse`] reads it.
    pub fn text(&self) -> Result<String> {
        Ok(format!("{}\n", serde_json::to_string(self)?))
    }

    /// Writes the file.
    pub fn save(&self, output: Output) -> Result<()> {
        output.write(self.text()?.as_bytes())
    }

    /// Names of the classes.
    pub fn names(&self) -> Vec<String> {
        self.gallery.names.iter().map(ToString::to_string).collect()
    }

    /// True if a file with this fingerprint was trained on.
    pub fn knows_file(&self, fingerprint: &str) -> bool {
        self.trained_on.iter().any(|source| source.fingerprint == fingerprint)
    }
}

/// Error about what is too long for a board, in clearer words than those of a list that is full.
fn check_sizes(value: &serde_json::Value) -> Result<()> {
    let length = |path: &str| value.pointer(path).and_then(|list| list.as_array()).map_or(0, Vec::len);
    for (path, what, most) in [
        ("/gallery/prototypes", "prototypes", GALLERY_PROTOTYPES),
        ("/gallery/names", "classes", GALLERY_CLASSES),
        ("/gallery/space/weights", "dimensions", DIMENSIONS),
        ("/gallery/space/origin", "measures", MEASURES),
    ] {
        let have = length(path);
        require!(
            have <= most,
            LearnError::TooLarge,
            "is too large for a board: {have} {what}, at most {most}"
        );
    }
    Ok(())
}
