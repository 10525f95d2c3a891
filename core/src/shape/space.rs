//! The space in which a gallery compares touches: a projection of the descriptor.

use super::descriptor::{Descriptor, MEASURES};
use heapless::Vec;
use serde::{Deserialize, Serialize};

/// Greatest number of dimensions of a space; none without the feature `gallery`.
pub const DIMENSIONS: usize = if cfg!(feature = "gallery") { 12 } else { 0 };

/// A position in a space, in 1/256 of the spread that the trainer found within a class; 0 in unused
/// dimensions.
pub type Point = [i16; DIMENSIONS];

/// The projection `point = weights (descriptor - origin) / 2^shift`, rounded to the nearest; saturates at the
/// ends of `i16`.
#[derive(Debug, Default, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Space {
    /// The descriptor whose position is 0.
    pub origin: Descriptor,
    /// A row for each dimension; an unused measure has 0 in all of them.
    pub weights: Vec<[i16; MEASURES], DIMENSIONS>,
    /// Right shift, 0 ..= 30.
    pub shift: u8,
}

impl Space {
    /// Returns the position of a touch.
    pub fn place(&self, descriptor: &Descriptor) -> Point {
        let mut point = [0; DIMENSIONS];
        for (at, row) in point.iter_mut().zip(&self.weights) {
            // Fits: 24 products of 33 bits.
            let terms = row.iter().zip(descriptor.iter().zip(&self.origin));
            let sum: i64 = terms
                .filter(|(weight, _)| **weight != 0)
                .map(|(weight, (x, origin))| i64::from(*weight) * (i64::from(*x) - i64::from(*origin)))
                .sum();
            let shift = self.shift.min(30);
            let rounded = (sum + (1 << shift >> 1)) >> shift;
            *at = rounded.clamp(i16::MIN.into(), i16::MAX.into()) as i16;
        }
        point
    }
}

/// Returns the squared distance. The difference in each dimension is limited to 16383, so that twelve squares
/// fit.
pub fn distance2(a: &Point, b: &Point) -> u32 {
    let square = |(a, b): (&i16, &i16)| u32::from(a.abs_diff(*b).min(16_383)).pow(2);
    a.iter().zip(b).map(square).sum()
}
