//! Classes of taxel health.

use core::fmt;
use serde::{Deserialize, Serialize};

/// Health of a taxel.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[repr(u8)]
pub enum TaxelHealth {
    /// No fault is known.
    #[default]
    Good = 0,
    /// Does not respond to pressure.
    Dead = 1,
    /// Constant code, without noise.
    Stuck = 2,
    /// Broken line: no signal.
    Open = 3,
    /// Short circuit: full signal.
    Shorted = 4,
    /// Noise many times that of the others.
    Noisy = 5,
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
        })
    }
}
