//! Lines that come with every frame.

use crate::json::contact::ContactLine;
use crate::json::meaning::MeaningOfTouch;
#[cfg(feature = "schema")]
use crate::json::schema::TypeIs;
use serde::Serialize;

/// A frame with the present contacts and the meaning of the touch.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = TypeIs("frame")))]
#[serde(tag = "type", rename = "frame")]
pub struct FrameLine<'a> {
    /// Number of the scan.
    pub frame: u32,
    /// Start of the scan, us of the board.
    pub time_us: u64,
    /// Present contacts.
    pub contacts: Vec<ContactLine<'a>>,
    /// Meaning of the touch.
    pub intent: MeaningOfTouch,
    /// Ids of the contacts that have ended since the last frame; absent if none has.
    #[serde(skip_serializing_if = "<[u32]>::is_empty")]
    pub released: &'a [u32],
    /// True for a key frame, which is decoded without the frames before it.
    pub key: bool,
    /// True if the image could be decoded.
    pub decoded: bool,
    /// Messages lost so far.
    pub lost: u64,
    /// Images left out so far, because the link had no room.
    pub thinned: u64,
    /// Pressure by panel; absent unless requested.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub panels: Option<Vec<PanelPixels<'a>>>,
    /// Force on each panel, N; null where a panel has none, absent if it is unknown.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub force_n: Option<Vec<Option<f64>>>,
    /// Basis of the forces: `calibrated`, `nominal` or `simulated`; absent if they are unknown.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub force_basis: Option<&'static str>,
}

/// Pressure of a panel.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PanelPixels<'a> {
    /// Name of the panel.
    pub name: &'a str,
    /// Pressure of each taxel by row, counts.
    pub rows: Vec<&'a [u16]>,
}

/// Contacts that are present, and those that have ended since the last such message.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = TypeIs("contacts")))]
#[serde(tag = "type", rename = "contacts")]
pub struct ContactsLine<'a> {
    /// Number of the scan.
    pub frame: u32,
    /// Start of the scan, us of the board.
    pub time_us: u64,
    /// Present contacts.
    pub contacts: Vec<ContactLine<'a>>,
    /// Contacts that have ended.
    pub released: Vec<ContactLine<'a>>,
    /// Number of contacts that did not fit.
    pub dropped: u16,
    /// Basis of the forces: `calibrated`, `nominal` or `simulated`; absent if they are unknown.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub force_basis: Option<&'static str>,
}

/// Raw codes have come.
#[derive(Debug, Clone, Copy, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = TypeIs("raw")))]
#[serde(tag = "type", rename = "raw")]
pub struct RawLine {
    /// Number of the scan.
    pub frame: u32,
    /// Start of the scan, us of the board.
    pub time_us: u64,
    /// True if the codes could be decoded.
    pub decoded: bool,
}
