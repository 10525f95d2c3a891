//! Errors of settings.

use core::fmt;

/// Error of a configuration: the parameter, and what it must be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Invalid {
    /// Name of the parameter as the author writes it, with its section: `contact.low`.
    pub parameter: &'static str,
    /// Condition that it must meet, as the end of a sentence: "must be at least 1".
    pub must: &'static str,
}

/// Text of an [`Invalid`] about a part that this build leaves out: a feature of the crate.
pub const LEFT_OUT: &str = "is left out of this firmware";

impl fmt::Display for Invalid {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", self.parameter, self.must)
    }
}

impl core::error::Error for Invalid {}

/// Error of a row of a list.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct InvalidRow {
    /// Name of the list as the author writes it: `react`.
    pub list: &'static str,
    /// Index of the row, from 0.
    pub index: usize,
    /// Parameter within the row; an empty name stands for the row itself.
    pub invalid: Invalid,
}

impl fmt::Display for InvalidRow {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let InvalidRow { list, index, invalid } = self;
        let dot = if invalid.parameter.is_empty() { "" } else { "." };
        write!(f, "{list}[{index}]{dot}{invalid}")
    }
}

impl core::error::Error for InvalidRow {}
