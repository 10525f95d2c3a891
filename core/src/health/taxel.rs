//! What may be wrong with a taxel.

use core::fmt;
use serde::{Deserialize, Serialize};

/// The class of a taxel.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[repr(u8)]
pub enum TaxelHealth {
    /// nothing is known against it
    #[default]
    Good = 0,
    /// it does not answer to pressure
    Dead = 1,
    /// it gives one code, without noise
    Stuck = 2,
    /// its line is broken: no signal
    Open = 3,
    /// its line has a short circuit: full signal
    Shorted = 4,
    /// its noise is many times that of the others
    Noisy = 5,
    /// nobody can tell its drift from a touch; no intention follows from its panel
    Unsure = 6,
}

impl fmt::Display for TaxelHealth {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            TaxelHealth::Good => "good",
            TaxelHealth::Dead => "dead",
            TaxelHealth::Stuck => "stuck",
            TaxelHealth::Open => "open",
            TaxelHealth::Shorted => "shorted",
            TaxelHealth::Noisy => "noisy",
            TaxelHealth::Unsure => "baseline unsure",
        })
    }
}
