//! The base of shapes that comes with the program: rectangle, round, finger.
//!
//! The prototypes are learned, not measured: 16 per class, placed by k-means and moved by generalised
//! learning vector quantisation (GLVQ) in the space of [`features`](super::features). The examples are drawn
//! by three generators that share no formula for pressure, on grids of 4 x 16, 16 x 16 and 32 x 64
//! (`core/tests/core/shape/kinds`). `core/tests/core/shape/base` learns the prototypes anew, asserts that they
//! are these, and judges each generator by a base that was learned without it. `docs/shapes.md` has the
//! figures.

use super::features::{FEATURES, ShapeFeatures};
use super::knn::{Class, Prototype};

/// Prototypes of each class.
const EACH: usize = 16;

const RECTANGLE: [ShapeFeatures; EACH] = [
    [826, 193, 402, 810, 404, 85],
    [828, 252, 257, 749, 444, 92],
    [722, 182, 192, 698, 209, 92],
    [766, 214, 252, 740, 331, 96],
    [730, 149, 236, 749, 132, 112],
    [789, 143, 335, 742, 183, 119],
    [890, 322, 313, 785, 544, 165],
    [945, 351, 449, 846, 627, 188],
    [726, 113, 233, 716, 81, 198],
    [705, 185, 192, 781, 334, 215],
    [776, 47, 348, 733, 76, 228],
    [944, 368, 344, 826, 634, 263],
    [741, 216, 138, 758, 221, 319],
    [989, 383, 447, 855, 686, 321],
    [889, 155, 76, 950, 575, 444],
    [892, 56, 226, 1266, 683, 723],
];

const ROUND: [ShapeFeatures; EACH] = [
    [777, 3, 414, 716, 15, -7],
    [757, 0, 317, 732, 62, 38],
    [680, 12, 187, 706, 117, 39],
    [749, -14, 237, 710, 37, 66],
    [748, -36, 291, 791, 79, 75],
    [752, -8, 251, 710, 130, 79],
    [729, 7, 225, 709, 177, 85],
    [642, 72, 152, 697, 280, 87],
    [704, 3, 186, 625, 36, 100],
    [733, 1, 241, 796, 191, 122],
    [663, -6, 136, 631, 146, 191],
    [700, 52, 196, 857, 374, 220],
    [723, 9, 177, 785, 263, 323],
    [629, -3, 105, 620, 91, 358],
    [785, 77, 152, 1023, 595, 465],
    [821, 210, 175, 1640, 1139, 933],
];

const FINGER: [ShapeFeatures; EACH] = [
    [816, 203, 198, 827, 154, 108],
    [742, 336, 151, 781, 485, 199],
    [889, 305, 216, 915, 533, 205],
    [775, 293, 213, 756, 393, 246],
    [798, 289, 293, 826, 533, 289],
    [895, 319, 320, 933, 651, 294],
    [832, 350, 201, 750, 484, 306],
    [859, 314, 354, 814, 600, 349],
    [864, 321, 253, 872, 584, 376],
    [887, 322, 465, 827, 647, 404],
    [856, 331, 370, 854, 657, 418],
    [938, 391, 197, 846, 611, 444],
    [896, 352, 452, 831, 676, 454],
    [933, 376, 326, 883, 718, 509],
    [984, 398, 463, 873, 761, 556],
    [1033, 413, 321, 969, 830, 696],
];

/// All of them, class by class.
const PROTOTYPES: [Prototype; 3 * EACH] = {
    let mut all = [Prototype { class: Class::UNKNOWN, features: [0; FEATURES] }; 3 * EACH];
    let mut index = 0;
    while index < EACH {
        all[index] = Prototype { class: Class::RECTANGLE, features: RECTANGLE[index] };
        all[EACH + index] = Prototype { class: Class::ROUND, features: ROUND[index] };
        all[2 * EACH + index] = Prototype { class: Class::FINGER, features: FINGER[index] };
        index += 1;
    }
    all
};

/// A base of shapes, which stays in flash. What a board is taught later is a [`Gallery`](super::Gallery).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Base {
    /// Names of the classes, from 1.
    pub names: &'static [&'static str],
    /// Examples; ties go to the earlier one.
    pub prototypes: &'static [Prototype],
}

impl Base {
    /// Rectangle, round and finger.
    pub const BUILT_IN: Base = Base { names: &["rectangle", "round", "finger"], prototypes: &PROTOTYPES };

    /// Name of a class; "unknown" if the base does not have it.
    pub fn name(&self, class: Class) -> &'static str {
        let index = usize::from(class.0).checked_sub(1);
        index.and_then(|index| self.names.get(index)).copied().unwrap_or("unknown")
    }
}
