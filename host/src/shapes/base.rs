//! A base of shapes: a gallery with where it comes from, as a file.

use super::train::Known;
use super::view::View;
use crate::fault::Fault;
use crate::output::Output;
use crate::words;
use anyhow::{Context, Result, anyhow, bail, ensure};
use serde::{Deserialize, Serialize};
use std::path::Path;
use taxel_core::shape::{DIMENSIONS, GALLERY_CLASSES, GALLERY_PROTOTYPES, MEASURE_NAMES, MEASURES};

/// What the file begins with.
const KIND: &str = "taxel shapes 1";
/// Much more than the largest base takes.
const LONGEST: u64 = 1 << 20;

/// A base that comes with the program.
struct Shipped {
    name: &'static str,
    /// Rows and columns of the only images that it is for.
    grid: Option<(u16, u16)>,
    text: &'static str,
}

macro_rules! shipped {
    ($name:literal, $grid:expr) => {
        Shipped { name: $name, grid: $grid, text: include_str!(concat!("../../bases/", $name, ".json")) }
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

/// Names of the bases that come with the program.
pub fn shipped_names() -> impl Iterator<Item = &'static str> {
    SHIPPED.iter().map(|shipped| shipped.name)
}

/// How a base was tested that was taught from nothing: each of its prototypes by the others.
pub const LEFT_OUT: &str = "each prototype left out in turn";

/// A base.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Base {
    /// Kind and version of the file.
    pub kind: String,
    /// The measures that the space was made for, in their order.
    pub measures: Vec<String>,
    /// What of an image is the touch.
    pub view: View,
    /// What it was trained on.
    pub trained_on: Vec<Source>,
    /// How it fared on what was left out of training.
    pub card: Card,
    /// What it knows.
    pub gallery: Known,
}

/// A file that was trained on.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Source {
    /// Name without folders.
    pub file: String,
    /// See [`Fingerprint`](crate::learn::fingerprint::Fingerprint); empty: it was a board.
    pub fingerprint: String,
    /// The sets of it that were used; all if empty.
    pub sets: Vec<String>,
    /// Examples.
    pub images: usize,
}

/// What is known of a base's worth.
#[derive(Debug, Default, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Card {
    /// How it was split.
    pub split: String,
    /// Right answers, of 1.
    pub accuracy: f64,
    /// A row for each class, a column for each answer, "none" last.
    pub confusion: Vec<Vec<u32>>,
}

impl Base {
    /// A new one.
    pub fn new(view: View, trained_on: Source, card: Card, gallery: Known) -> Base {
        let measures = MEASURE_NAMES.map(String::from).to_vec();
        Base { kind: KIND.into(), measures, view, trained_on: vec![trained_on], card, gallery }
    }

    /// One that knows nothing yet, and sees as `drawn` does.
    pub fn empty() -> Result<Base> {
        let mut base = Base::open(Path::new(SHIPPED[0].name))?;
        base.gallery.names.clear();
        base.gallery.prototypes.clear();
        // Of a few examples the nearest decides.
        base.gallery.k = 1;
        base.card = Card { split: LEFT_OUT.into(), ..Card::default() };
        Ok(base)
    }

    /// The shipped one of that name, else the file.
    pub fn open(name: &Path) -> Result<Base> {
        if let Some(shipped) = SHIPPED.iter().find(|shipped| Path::new(shipped.name) == name) {
            return Base::parse(shipped.text).with_context(|| format!("base {}", shipped.name));
        }
        crate::verbose::reads(name);
        let read = || {
            let size = std::fs::metadata(name).context("cannot be read")?.len();
            ensure!(size <= LONGEST, "is no base of shapes: it has {size} bytes, expected at most {LONGEST}");
            Base::parse(&std::fs::read_to_string(name).context("cannot be read")?)
        };
        // What is no path can only be a name.
        let said = name.to_str().filter(|said| !name.exists() && !said.contains(['.', '/', '\\']));
        if let Some(said) = said {
            let known = words::unknown("base", said, shipped_names());
            bail!(Fault::usage(format!("{known}, or give a .json file")));
        }
        read().with_context(|| name.display().to_string())
    }

    /// The shipped base that knows the most of these classes; of those that know as many, the one that is
    /// made for images of these rows and columns.
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
        let (_, name, base) = best.with_context(|| {
            format!("no shipped base knows any of the classes {}: give --base", classes.join(", "))
        })?;
        Ok((name, base))
    }

    /// Of the text of a file. Everything that would not run on a board is refused.
    pub fn parse(text: &str) -> Result<Base> {
        let value: serde_json::Value = serde_json::from_str(text).context("is no base of shapes")?;
        match value.get("kind").and_then(|kind| kind.as_str()) {
            Some(KIND) => {}
            Some(other) => bail!("is of kind {other:?}, expected {KIND:?}"),
            None => bail!("is no base of shapes: it has no `kind`"),
        }
        check_sizes(&value)?;
        let base: Base = serde_json::from_value(value)
            .map_err(|error| anyhow!("is no base of shapes: {}", words::cause(&error)))?;
        ensure!(base.measures == MEASURE_NAMES, "was made for other measures than this program has");
        base.gallery.check().map_err(|invalid| anyhow!("{invalid}"))?;
        let classes = base.gallery.names.len();
        let fits = base.card.confusion.len() == classes
            && base.card.confusion.iter().all(|row| row.len() == classes + 1);
        ensure!(fits, "has a card of other classes than its own");
        Ok(base)
    }

    /// Text of the file; read by [`Base::parse`].
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

    /// Whether a file of this fingerprint was trained on.
    pub fn knows_file(&self, fingerprint: &str) -> bool {
        self.trained_on.iter().any(|source| source.fingerprint == fingerprint)
    }
}

/// Says what is too long for a board, in better words than a failing list does.
fn check_sizes(value: &serde_json::Value) -> Result<()> {
    let length = |path: &str| value.pointer(path).and_then(|list| list.as_array()).map_or(0, Vec::len);
    for (path, what, most) in [
        ("/gallery/prototypes", "prototypes", GALLERY_PROTOTYPES),
        ("/gallery/names", "classes", GALLERY_CLASSES),
        ("/gallery/space/weights", "dimensions", DIMENSIONS),
        ("/gallery/space/origin", "measures", MEASURES),
    ] {
        let have = length(path);
        ensure!(have <= most, "is too large for a board: {have} {what}, at most {most}");
    }
    Ok(())
}
