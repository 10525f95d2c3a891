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

/// How large.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Extent {
    /// below the first limit
    #[default]
    Point,
    /// from the first limit
    Patch,
    /// from the second
    Wide,
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
    /// How large, at its largest so far.
    pub extent: Extent,
    /// How long so far.
    pub span: Span,
    /// It slides over the surface, or did within the last quarter of a second.
    pub moving: bool,
    /// What shape, by the evidence of the last 0.4 s in which it pressed with at least half of its greatest total: what is left of
    /// it later has another.
    pub class: Class,
}
