//! The base of shapes that comes with the program: rectangle, round, finger.

use super::features::Features;
use super::knn::{Base, Class, Prototype};
use crate::format::name;
use heapless::Vec;

/// Prototypes of the built-in base.
pub const BUILT_IN: usize = 3;

const TABLE: [(Class, Features); BUILT_IN] = [
    (Class::RECTANGLE, [1180, 1300, 100, 80]),
    (Class::ROUND, [1100, 1200, 5, 80]),
    (Class::FINGER, [1150, 1250, 190, 80]),
];

impl<const PROTOTYPES: usize> Base<PROTOTYPES> {
    /// Rectangle, round and finger; cut to the capacity, which should be at least [`BUILT_IN`].
    pub fn built_in() -> Self {
        let prototypes = TABLE.iter().take(PROTOTYPES);
        Base {
            names: Vec::from_iter(["rectangle", "round", "finger"].map(name)),
            prototypes: prototypes
                .map(|(class, features)| Prototype { class: *class, features: *features })
                .collect(),
        }
    }
}
