//! The words for a contact.

use crate::shape::Class;
use serde::{Deserialize, Serialize};

/// How hard.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Strength {
    /// below the first limit
    #[default]
    Faint,
    /// from the first limit
    Light,
    /// from the second
    Firm,
    /// from the third
    Hard,
}

/// How large. Variants are only appended.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Extent {
    /// below the first limit
    #[default]
    Point,
    /// from the first limit
    Patch,
    /// from the second
    Wide,
    /// a point with [`SHARP`] counts on a taxel: a needle, a pen, the edge of a key
    Sharp,
}

/// A taxel is as good as full, counts: the middle of what is sharp to the shipped map.
pub const SHARP: u16 = 3_000;

impl Extent {
    /// Its place among the sizes.
    pub(super) const fn size(self) -> usize {
        match self {
            Extent::Point | Extent::Sharp => 0,
            Extent::Patch => 1,
            Extent::Wide => 2,
        }
    }
}

/// How long.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Span {
    /// below the first limit
    #[default]
    Brief,
    /// from the first limit
    Short,
    /// from the second
    Long,
}

/// The words for one contact.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Words {
    /// How hard, at its hardest so far.
    pub strength: Strength,
    /// How large, at its largest so far; a point that was sharp stays so.
    pub extent: Extent,
    /// How long so far.
    pub span: Span,
    /// It slides over the surface, or did within the last quarter of a second.
    pub moving: bool,
    /// What shape, by the evidence of the last 0.4 s in which it pressed with at least half of its greatest
    /// total: what is left of it later has another.
    pub class: Class,
}
