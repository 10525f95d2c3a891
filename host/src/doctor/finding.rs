//! Something that was found, and what to do about it.

use serde::Serialize;

/// How grave it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Grade {
    /// as it should be
    Good,
    /// it works, with less than it could
    Weak,
    /// it does not work
    Bad,
}

/// One finding.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Finding {
    /// How grave.
    pub grade: Grade,
    /// Of what.
    pub of: &'static str,
    /// What was found.
    pub what: String,
    /// What to do; empty where nothing is to be done.
    pub cure: &'static str,
}

impl Finding {
    /// As it should be.
    pub fn good(of: &'static str, what: impl Into<String>) -> Finding {
        Finding { grade: Grade::Good, of, what: what.into(), cure: "" }
    }

    /// Less than it could be.
    pub fn weak(of: &'static str, what: impl Into<String>, cure: &'static str) -> Finding {
        Finding { grade: Grade::Weak, of, what: what.into(), cure }
    }

    /// It does not work.
    pub fn bad(of: &'static str, what: impl Into<String>, cure: &'static str) -> Finding {
        Finding { grade: Grade::Bad, of, what: what.into(), cure }
    }
}
