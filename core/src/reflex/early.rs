//! A reflex that has begun, before its frame is complete.

use crate::format::{Code, Micros};

/// A reflex that has begun.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Early {
    /// Index into the scene's table of reactions.
    pub index: u8,
    /// Time at which the sub-field had been read.
    pub time: Micros,
    /// Number of the taxel that triggered it.
    pub taxel: u16,
    /// Code of the taxel.
    pub code: Code,
    /// Number of the taxel that agreed, if two must.
    pub other: Option<u16>,
}
