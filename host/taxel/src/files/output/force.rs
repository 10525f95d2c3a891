//! Whether an output may replace another.

/// Whether an existing output is replaced.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Force {
    /// Replace the output if it exists.
    pub force: bool,
}
