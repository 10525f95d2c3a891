//! The input of the stage.

use crate::format::{Code, Micros};

/// The codes of a scan, and how to read them.
#[derive(Debug, Clone, Copy)]
pub struct Sampled<'a> {
    /// Codes by taxel number; missing ones read as no pressure, surplus ones are ignored.
    pub codes: &'a [Code],
    /// True if pressure lowers the code.
    pub falling: bool,
    /// Mask of the panels read; the others read as zero and keep their baseline.
    pub panels: u8,
    /// Start of the scan, us.
    pub now: Micros,
}
