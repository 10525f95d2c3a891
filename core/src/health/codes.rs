//! The input of a frame.

use crate::format::Code;

/// Codes of a frame, with their context.
#[derive(Debug, Clone, Copy)]
pub struct Codes<'a> {
    /// The codes of a frame.
    pub now: &'a [Code],
    /// Codes at rest; none if unknown.
    pub rest: Option<&'a [u16]>,
    /// Largest possible code.
    pub full: u16,
    /// True if something touches the garment.
    pub touched: bool,
}
