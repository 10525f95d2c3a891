//! One finding and its remedy.

use serde::Serialize;

/// Severity of a finding.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Grade {
    /// Part that works as it should.
    Good,
    /// Part that works, but not fully.
    Weak,
    /// Part that does not work.
    Bad,
}

/// Something that was found, and what to do about it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Finding {
    /// Severity.
    pub grade: Grade,
    /// Subject of the finding.
    pub of: &'static str,
    /// Sentence on what was found.
    pub what: String,
    /// Remedy; empty if nothing is to be done.
    pub cure: &'static str,
}

impl Finding {
    /// A finding without fault.
    pub fn good(of: &'static str, what: impl Into<String>) -> Finding {
        Finding { grade: Grade::Good, of, what: what.into(), cure: "" }
    }

    /// A finding of something that works, but not fully.
    pub fn weak(of: &'static str, what: impl Into<String>, cure: &'static str) -> Finding {
        Finding { grade: Grade::Weak, of, what: what.into(), cure }
    }

    /// A finding of something that does not work.
    pub fn bad(of: &'static str, what: impl Into<String>, cure: &'static str) -> Finding {
        Finding { grade: Grade::Bad, of, what: what.into(), cure }
    }
}
