//! Expected pressure of the garment's folds.

#[cfg(feature = "schema")]
use crate::json::schema::TypeIs;
use serde::Serialize;

/// Expected pressure of the garment's folds.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = TypeIs("folds")))]
#[serde(tag = "type", rename = "folds")]
pub struct FoldsLine {
    /// Number of the scan.
    pub frame: u32,
    /// Start of the scan, us of the board.
    pub time_us: u64,
    /// Time at which the board received the posture in force, us of the board; null without one.
    pub posed_us: Option<u64>,
    /// True if the folds follow the posture. False without a posture, or if it is too old: taxels that fold
    /// are then touched only beyond the most that they feel at any posture.
    pub followed: bool,
    /// Number of taxels of which something is expected, or that are in doubt.
    pub taxels: u16,
    /// Sum of the expected pressures, counts.
    pub expected: u32,
    /// Sum of the doubts, counts.
    pub doubt: u32,
    /// Present contacts on such taxels.
    pub contacts: Vec<DoubtLine>,
}

/// By how much the force of a contact may be off for the folds beneath it.
#[derive(Debug, Clone, Copy, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct DoubtLine {
    /// Id of the contact.
    pub id: u32,
    /// Sum of the doubts of its taxels, counts.
    pub doubt: u32,
}
