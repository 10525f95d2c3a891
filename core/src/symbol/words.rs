//! The words for a contact.

use crate::shape::Class;
use serde::{Deserialize, Serialize};

/// Strength: total pressure.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Strength {
    /// Below the first limit.
    #[default]
    Faint,
    /// From the first limit on.
    Light,
    /// From the second limit on.
    Firm,
    /// From the third limit on.
    Hard,
}

impl Strength {
    /// Name in lower case.
    pub const fn as_str(self) -> &'static str {
        match self {
            Strength::Faint => "faint",
            Strength::Light => "light",
            Strength::Firm => "firm",
            Strength::Hard => "hard",
        }
    }
}

/// Extent: touched area. Variants are only appended.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Extent {
    /// Below the first limit.
    #[default]
    Point,
    /// From the first limit on.
    Patch,
    /// From the second limit on.
    Wide,
    /// A point with [`SHARP`] counts on a taxel: a needle, a pen, the edge of a key.
    Sharp,
}

/// Pressure at which a taxel is nearly full, counts: the middle of the range in which the shipped map's
/// `sharp` rises.
pub const SHARP: u16 = 3_000;

impl Extent {
    /// Name in lower case.
    pub const fn as_str(self) -> &'static str {
        match self {
            Extent::Point => "point",
            Extent::Patch => "patch",
            Extent::Wide => "wide",
            Extent::Sharp => "sharp",
        }
    }

    /// Rank of the size.
    pub(super) const fn size(self) -> usize {
        match self {
            Extent::Point | Extent::Sharp => 0,
            Extent::Patch => 1,
            Extent::Wide => 2,
        }
    }
}

/// Span: duration.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Span {
    /// Below the first limit.
    #[default]
    Brief,
    /// From the first limit on.
    Short,
    /// From the second limit on.
    Long,
}

impl Span {
    /// Name in lower case.
    pub const fn as_str(self) -> &'static str {
        match self {
            Span::Brief => "brief",
            Span::Short => "short",
            Span::Long => "long",
        }
    }
}

/// The words for one contact.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Words {
    /// Strength, at its greatest so far.
    pub strength: Strength,
    /// Extent, at its largest so far; a point that was sharp stays so.
    pub extent: Extent,
    /// Span so far.
    pub span: Span,
    /// True if it slides over the surface, or did within the last quarter of a second.
    pub moving: bool,
    /// Shape, by the evidence of the last 0.4 s in which it pressed with at least half of its greatest total:
    /// the remainder of a touch later has another shape.
    pub class: Class,
}
