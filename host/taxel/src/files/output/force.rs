//! Permission to replace another output.

/// Permission to replace an existing output.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Force {
    /// Replace the output if it exists.
    pub force: bool,
}
