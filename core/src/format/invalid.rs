//! What is wrong with a setting.

use core::fmt;

/// Why a configuration is refused: the parameter by its name in the file, and what it must be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Invalid {
    /// Name of the parameter as the author writes it, with its section: `contact.low`.
    pub parameter: &'static str,
    /// What it must be, as the end of a sentence: "must be at least 1".
    pub must: &'static str,
}

impl fmt::Display for Invalid {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", self.parameter, self.must)
    }
}

impl core::error::Error for Invalid {}
