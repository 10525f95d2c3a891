//! The limits between words.

use super::stage::Symbols;
use crate::format::Invalid;
use serde::{Deserialize, Serialize};

/// Limits between the words; each row rises.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct SymbolConfig {
    /// Total pressure in counts from which a touch is light, firm, hard; below it is faint.
    pub strength: [u32; 3],
    /// Area in taxels from which a touch is a patch, a wide one; below it is a point.
    pub extent: [u16; 2],
    /// Duration in ms from which a touch is short, long; below it is brief.
    pub span_ms: [u32; 2],
}

impl Default for SymbolConfig {
    /// At 1000 counts per newton: light from 1 N, firm from 5 N, hard from 20 N.
    fn default() -> Self {
        SymbolConfig { strength: [1_000, 5_000, 20_000], extent: [9, 40], span_ms: [150, 800] }
    }
}

impl SymbolConfig {
    /// Checks the limits.
    pub fn build(&self) -> Result<Symbols, Invalid> {
        let must = "must rise";
        if !self.strength.is_sorted_by(|a, b| a < b) {
            return Err(Invalid { parameter: "symbol.strength", must });
        }
        if !self.extent.is_sorted_by(|a, b| a < b) {
            return Err(Invalid { parameter: "symbol.extent", must });
        }
        if !self.span_ms.is_sorted_by(|a, b| a < b) {
            return Err(Invalid { parameter: "symbol.span_ms", must });
        }
        Ok(Symbols::new(*self))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_that_do_not_rise_are_refused_by_name() {
        let refused = |edit: fn(&mut SymbolConfig)| {
            let mut config = SymbolConfig::default();
            edit(&mut config);
            config.build().unwrap_err().parameter
        };
        assert_eq!(refused(|c| c.strength[1] = c.strength[0]), "symbol.strength");
        assert_eq!(refused(|c| c.extent = [9, 8]), "symbol.extent");
        assert_eq!(refused(|c| c.span_ms = [800, 150]), "symbol.span_ms");
    }
}
