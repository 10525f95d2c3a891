//! Symbols, intentions and reactions.

use crate::json::meaning::MeaningOfTouch;
#[cfg(feature = "schema")]
use crate::json::schema::TypeIs;
use serde::Serialize;
use taxel_core::contact::Phase;
use taxel_core::symbol::{Extent, Span, Strength};

/// Words for the contacts, and the state of the regions of the body.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = TypeIs("symbols")))]
#[serde(tag = "type", rename = "symbols")]
pub struct SymbolsLine<'a> {
    /// Number of the scan.
    pub frame: u32,
    /// Start of the scan, us of the board.
    pub time_us: u64,
    /// Onsets, changes of words, releases.
    pub events: Vec<SymbolLine<'a>>,
    /// Touched regions.
    pub regions: Vec<RegionLine<'a>>,
}

/// The words of a contact at its onset, at a change, or at its release.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SymbolLine<'a> {
    /// Id of the contact.
    pub contact: u32,
    /// `onset`, `released`, or `held` for a change of words.
    #[cfg_attr(feature = "schema", schemars(with = "String"))]
    pub phase: Phase,
    /// Region of the body.
    pub region: &'a str,
    /// The words.
    pub words: WordsLine,
    /// Greatest total so far, counts.
    pub peak_total: u32,
    /// Time since the onset, ms.
    pub duration_ms: u32,
}

/// The words for a contact.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct WordsLine {
    /// `faint`, `light`, `firm` or `hard`: the greatest strength so far.
    #[cfg_attr(feature = "schema", schemars(with = "String"))]
    pub strength: Strength,
    /// `point`, `patch`, `wide` or `sharp`: the largest extent so far.
    #[cfg_attr(feature = "schema", schemars(with = "String"))]
    pub extent: Extent,
    /// `brief`, `short` or `long`: the time so far.
    #[cfg_attr(feature = "schema", schemars(with = "String"))]
    pub span: Span,
    /// True if it slides over the surface, or did within the last quarter of a second.
    pub moving: bool,
    /// Name of the shape, or `unknown`.
    pub shape: String,
}

/// A region of the body.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RegionLine<'a> {
    /// Name of the region.
    pub region: &'a str,
    /// Number of contacts.
    pub contacts: u8,
    /// Sum of their totals, counts.
    pub total: u32,
    /// Greatest pressure of a taxel, counts.
    pub peak: u16,
    /// True if a contact slides.
    pub moving: bool,
    /// Time since which the region has been touched, or untouched, us of the board.
    pub since_us: u64,
}

/// The meaning of the touch has changed.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = TypeIs("intent")))]
#[serde(tag = "type", rename = "intent")]
pub struct IntentLine {
    /// Number of the scan.
    pub frame: u32,
    /// Start of the scan, us of the board.
    pub time_us: u64,
    /// The meaning.
    #[serde(flatten)]
    pub meaning: MeaningOfTouch,
    /// End of the inference: `fixed`, `cycle` or `unsettled`.
    pub outcome: &'static str,
    /// Steps of the inference.
    pub steps: u16,
}

/// A reaction of the garment has begun or ended.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = TypeIs("reaction")))]
#[serde(tag = "type", rename = "reaction")]
pub struct ReactionLine<'a> {
    /// Number of the scan.
    pub frame: u32,
    /// Start of the scan, us of the board.
    pub time_us: u64,
    /// Row of the scene's table, from 0.
    pub index: u8,
    /// Name of the reaction.
    pub name: &'a str,
    /// True if it began, false if it ended.
    pub active: bool,
    /// Value at that moment, in the unit of the cause.
    pub value: i32,
}

/// A reaction has begun within a frame.
#[derive(Debug, Clone, Copy, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = TypeIs("reflex")))]
#[serde(tag = "type", rename = "reflex")]
pub struct ReflexLine {
    /// Number of the scan.
    pub frame: u32,
    /// The taxel that agrees, if two must; else null.
    pub other: Option<u16>,
    /// Row of the scene's table, from 0.
    pub index: u8,
    /// The taxel that decided.
    pub taxel: u16,
    /// Pressure of the taxel, counts.
    pub value: u16,
    /// Time at which the deciding part of the scan had been read, us of the board.
    pub time_us: u64,
}
