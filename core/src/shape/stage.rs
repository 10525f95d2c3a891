//! The stage: recognises the shape of a contact.

use super::base::Base;
use super::config::ShapeConfig;
use super::features::features;
use super::knn::{Class, VOTERS, vote};
use super::nmi::nmi;
use crate::contact::{Contact, Moments, Quartic};
use crate::format::{Fixed24, Invalid, Q15};
use serde::{Deserialize, Serialize};

/// Shape of a contact.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Shape {
    /// sqrt(J) / m, eq. 4: depends on pressure, see [`Nmi`](super::Nmi)
    pub nmi: Fixed24,
    /// NMI sqrt(peak)
    pub nmi_peak: Fixed24,
    /// NMI sqrt(sum f^2 / sum f)
    pub nmi_s2: Fixed24,
    /// Class in the base of shapes.
    pub class: Class,
    /// Share of a known class in the neighbours' votes, weighted by nearness. For an unknown one, the excess
    /// over the limit, from 0 at the limit to 1.
    pub confidence: Q15,
}

impl Shape {
    /// Resets the class, because another base is in force that does not have its name.
    pub const fn forget_class(&mut self) {
        (self.class, self.confidence) = (Class::UNKNOWN, Q15(0));
    }
}

/// Recognises shapes; see the [module](super).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Shapes {
    config: ShapeConfig,
    base: Base,
}

impl ShapeConfig {
    /// Checks the settings and a base. Error if a parameter is out of range.
    pub fn build(&self, base: Base) -> Result<Shapes, Invalid> {
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
        Ok(Shapes { config: *self, base })
    }
}

impl Shapes {
    /// The base of shapes.
    pub const fn base(&self) -> &Base {
        &self.base
    }

    /// Recognises one contact from its moments and its ratios of the fourth order.
    pub fn process(&self, moments: &Moments, quartic: &Quartic, contact: &Contact) -> Shape {
        let nmi = nmi(moments, contact.peak);
        let features = features(&nmi, quartic, contact);
        let (class, confidence) =
            vote(self.base.prototypes, &features, self.config.k.into(), self.config.reject.into());
        Shape { nmi: nmi.published, nmi_peak: nmi.peak, nmi_s2: nmi.s2, class, confidence }
    }
}
