//! Settings of the stage.

use super::knn::{Base, VOTERS};
use super::stage::Shapes;
use crate::format::Invalid;
use serde::{Deserialize, Serialize};

/// How shapes are recognised.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ShapeConfig {
    /// Neighbours that vote: 1 to 9, and not more than the base has prototypes.
    pub k: u8,
    /// A contact farther than this from every prototype is unknown; in the units of [`super::Features`], at least 1.
    pub reject: u16,
}

impl Default for ShapeConfig {
    fn default() -> Self {
        ShapeConfig { k: 1, reject: 400 }
    }
}

impl ShapeConfig {
    /// Checks the settings and a base.
    pub fn build<const PROTOTYPES: usize>(
        &self,
        base: Base<PROTOTYPES>,
    ) -> Result<Shapes<PROTOTYPES>, Invalid> {
        let refuse = |parameter, must| Err(Invalid { parameter, must });
        if base.prototypes.is_empty() {
            return refuse("shape.base", "must have at least one prototype");
        }
        let named = 1..=base.names.len();
        if base.prototypes.iter().any(|p| !named.contains(&usize::from(p.class.0))) {
            return refuse("shape.base", "must name the class of every prototype");
        }
        if self.k == 0 || usize::from(self.k) > VOTERS.min(base.prototypes.len()) {
            return refuse("shape.k", "must be 1 to 9, and not more than there are prototypes");
        }
        if self.reject == 0 {
            return refuse("shape.reject", "must be at least 1");
        }
        Ok(Shapes::new(*self, base))
    }
}
