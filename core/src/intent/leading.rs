//! The three intentions, and none.

use serde::{Deserialize, Serialize};

/// The intention that leads. Variants are only appended.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Leading {
    /// No clear lead of any of the three.
    #[default]
    None,
    /// The concept *kindness*.
    Kindness,
    /// The concept *threat*.
    Threat,
    /// The concept *attack*.
    Attack,
}

impl Leading {
    /// The three intentions, in the order in which the stage keeps them.
    pub const INTENTIONS: [Leading; 3] = [Leading::Kindness, Leading::Threat, Leading::Attack];

    /// Name in lower case; it is also the name of its concept.
    pub const fn as_str(self) -> &'static str {
        match self {
            Leading::None => "none",
            Leading::Kindness => "kindness",
            Leading::Threat => "threat",
            Leading::Attack => "attack",
        }
    }
}
