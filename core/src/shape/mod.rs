//! Shape: the normalised moment of inertia, and the nearest of the known shapes.
//!
//! | | |
//! |---|---|
//! | input | exact [`Moments`](crate::contact::Moments) of a [`Contact`](crate::contact::Contact) |
//! | output | [`Shape`]: forms of the NMI in Q8.24, class, confidence in Q15 |
//! | saturation | forms just below 256 |
//! | latency | none; there is no state |
//! | RAM | [`Shapes`]: 20 bytes; the built-in base stays in flash, 14 bytes per prototype |
//! | M0+ cycles | 5.5 k with the built-in base of 48 prototypes, for each contact whose form is measured |
//!
//! Measured are the forms of new contacts, and of one other in each frame.

mod base;
mod confidence;
mod config;
mod descriptor;
mod features;
mod gallery;
mod knn;
mod nmi;
mod outline;
mod patch;
mod seen;
mod space;
mod spread;
mod stage;
mod taught;

pub use base::Base;
pub use confidence::{ConfidenceTable, STEPS};
pub use config::ShapeConfig;
pub use descriptor::{Descriptor, MEASURE_NAMES, MEASURES, descriptor};
pub use features::{FEATURES, ShapeFeatures, features};
pub use gallery::{Exemplar, GALLERY_CLASSES, GALLERY_PROTOTYPES, Gallery, Recognised};
pub use knn::{Class, Prototype};
pub use nmi::{Nmi, nmi};
pub use outline::Outline;
pub use patch::Patch;
pub use seen::seen;
pub use space::{DIMENSIONS, Point, Space};
pub use spread::Spread;
pub use stage::{Shape, Shapes};
pub use taught::{GalleryHead, Taught};

#[cfg(test)]
mod tests;
