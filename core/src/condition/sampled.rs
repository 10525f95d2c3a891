//! What is conditioned.

use crate::format::{Code, Micros};

/// The codes of a scan, and how they are to be read.
#[derive(Debug, Clone, Copy)]
pub struct Sampled<'a> {
    /// By taxel number; what is missing reads as no pressure, what is too much is ignored.
    pub codes: &'a [Code],
    /// Pressure lowers the code.
    pub falling: bool,
    /// Panels whose bit is not set read as zero and keep their baseline.
    pub panels: u8,
    /// Start of the scan, us.
    pub now: Micros,
}
