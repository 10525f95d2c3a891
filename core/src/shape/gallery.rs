//! A gallery: examples of the shapes that a user taught, and k-NN among them.

use super::confidence::{ConfidenceTable, STEPS};
use super::descriptor::{Descriptor, MEASURES};
use super::space::{Point, Space, distance2};
use crate::format::{Invalid, Name, Q15, root};
use heapless::Vec;
use serde::{Deserialize, Serialize};

/// Greatest number of classes of a gallery; none without the feature `gallery`.
pub const GALLERY_CLASSES: usize = if cfg!(feature = "gallery") { 32 } else { 0 };
/// Greatest number of prototypes of a gallery on a board; none without the feature `gallery`.
pub const GALLERY_PROTOTYPES: usize = if cfg!(feature = "gallery") { 200 } else { 0 };
/// Greatest number of neighbours that vote.
const VOTERS: usize = 9;

/// An example of a class.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Exemplar {
    /// Index of its class.
    pub class: u8,
    /// Position in the space.
    pub at: Point,
}

/// Examples of taught shapes, and the settings of their comparison.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Gallery<const PROTOTYPES: usize> {
    /// Names of the classes.
    pub names: Vec<Name, GALLERY_CLASSES>,
    /// Projection of a descriptor to a position.
    pub space: Space,
    /// Number of neighbours that vote, 1 to 9.
    pub k: u8,
    /// Greatest distance from the nearest prototype at which a touch is recognised; in units of a [`Point`].
    pub reject: u16,
    /// Confidence of a vote.
    #[serde(rename = "sureness")]
    pub confidence: ConfidenceTable,
    /// The examples; ties go to the earlier one.
    pub prototypes: Vec<Exemplar, PROTOTYPES>,
}

/// Result of the recognition of a touch.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Recognised {
    /// Index of the class; none if the touch is of no class.
    pub class: Option<u8>,
    /// Accuracy of such votes, see [`ConfidenceTable`]; 0 without a class.
    pub confidence: Q15,
    /// The class's share of the votes, each weighted by 1 / distance.
    pub share: Q15,
    /// Distance to the nearest prototype.
    pub distance: u16,
}

impl<const PROTOTYPES: usize> Default for Gallery<PROTOTYPES> {
    fn default() -> Self {
        Self::new()
    }
}

impl<const PROTOTYPES: usize> Gallery<PROTOTYPES> {
    /// An empty gallery, which recognises nothing. All bytes are 0.
    pub const fn new() -> Self {
        let space = Space { origin: [0; MEASURES], weights: Vec::new(), shift: 0 };
        let confidence =
            ConfidenceTable { shares: [0; STEPS - 1], distances: [0; STEPS - 1], right: [[0; STEPS]; STEPS] };
        Gallery { names: Vec::new(), space, k: 0, reject: 0, confidence, prototypes: Vec::new() }
    }

    /// Checks a gallery from outside. Error if a parameter is out of range.
    pub fn check(&self) -> Result<(), Invalid> {
        let refuse = |parameter, must| Err(Invalid { parameter, must });
        if self.prototypes.is_empty() {
            return refuse("shapes.prototypes", "must be at least one");
        }
        if self.prototypes.iter().any(|prototype| usize::from(prototype.class) >= self.names.len()) {
            return refuse("shapes.names", "must name the class of every prototype");
        }
        if self.space.weights.is_empty() || self.space.shift > 30 {
            return refuse("shapes.space", "must have at least one dimension, and a shift of at most 30");
        }
        if self.k == 0 || usize::from(self.k) > VOTERS {
            return refuse("shapes.k", "must be 1 to 9");
        }
        if self.reject == 0 {
            return refuse("shapes.reject", "must be at least 1");
        }
        self.confidence.check()
    }

    /// Recognises a touch.
    pub fn recognise(&self, descriptor: &Descriptor) -> Recognised {
        self.recognise_at(&self.space.place(descriptor))
    }

    /// Recognises a touch by its position. Among classes with equal votes, that of the nearest prototype
    /// wins.
    pub fn recognise_at(&self, point: &Point) -> Recognised {
        let nearest = self.nearest(point);
        let distance = nearest[0].0;
        let mut best = (0, None);
        let mut all = 0;
        for (_, class) in nearest.iter().take_while(|voter| voter.1.is_some()) {
            let same = nearest.iter().filter(|voter| voter.1 == *class);
            let votes: u64 = same.map(|voter| weight(voter.0)).sum();
            if votes > best.0 {
                best = (votes, *class);
            }
        }
        for voter in nearest.iter().take_while(|voter| voter.1.is_some()) {
            all += weight(voter.0);
        }
        let share = Q15::ratio(best.0, all);
        let class = best.1.filter(|_| distance <= u32::from(self.reject));
        let confidence = if class.is_some() { self.confidence.of(share, distance) } else { Q15(0) };
        Recognised { class, confidence, share, distance: distance.min(u16::MAX.into()) as u16 }
    }

    /// Returns distances and classes of the nearest prototypes in ascending order; class none beyond the
    /// last.
    fn nearest(&self, point: &Point) -> [(u32, Option<u8>); VOTERS] {
        let mut nearest = [(u32::MAX, None); VOTERS];
        let mut limit = u32::MAX;
        for prototype in &self.prototypes {
            let mut carried = (distance2(&prototype.at, point), Some(prototype.class));
            if carried.0 >= limit {
                continue;
            }
            for held in nearest.iter_mut().take(self.k.into()) {
                if carried.0 < held.0 {
                    core::mem::swap(held, &mut carried);
                }
                limit = held.0;
            }
        }
        nearest.map(|(square, class)| (root(square.into()), class))
    }
}

/// Weight of a vote: 1 / distance, limited to that at 1/16 of a class's spread.
fn weight(distance: u32) -> u64 {
    u64::from(u32::MAX / distance.saturating_add(16))
}
