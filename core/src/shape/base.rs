//! The base of shapes that comes with the program: rectangle, round, finger.
//!
//! The prototypes are learned, not measured: 16 per class, placed by k-means and moved by generalised
//! learning vector quantisation (GLVQ) in the space of [`features`](super::features). The examples are drawn
//! by three generators that share no formula for pressure, on grids of 4 x 16, 16 x 16 and 32 x 64
//! (`core/tests/core/shape/kinds`). `core/tests/core/shape/base` learns the prototypes anew, asserts that they
//! are these, and judges each generator by a base that was learned without it. `docs/evidence/shapes.md` has
//! the figures.

use super::features::{FEATURES, ShapeFeatures};
use super::knn::{Class, Prototype};

/// Prototypes of each class.
const EACH: usize = 16;

const RECTANGLE: [ShapeFeatures; EACH] = [
    [849, 250, 283, 758, 458, 88],
    [826, 192, 403, 823, 410, 95],
    [727, 152, 231, 739, 138, 101],
    [737, 192, 184, 695, 238, 109],
    [763, 193, 260, 768, 294, 109],
    [789, 141, 338, 737, 168, 115],
    [890, 319, 319, 789, 548, 161],
    [949, 355, 453, 844, 631, 190],
    [727, 119, 228, 722, 84, 199],
    [776, 49, 351, 736, 78, 229],
    [703, 204, 182, 766, 295, 255],
    [945, 370, 343, 826, 635, 262],
    [1000, 23, 385, 989, 191, 308],
    [988, 383, 443, 853, 685, 322],
    [888, 149, 84, 958, 597, 436],
    [879, 75, 234, 1252, 713, 716],
];

const ROUND: [ShapeFeatures; EACH] = [
    [770, 13, 387, 722, 35, 8],
    [685, 16, 193, 706, 115, 41],
    [751, -8, 245, 711, 37, 57],
    [755, -21, 292, 744, 96, 67],
    [733, 10, 227, 702, 170, 79],
    [642, 75, 147, 675, 285, 94],
    [699, 3, 182, 623, 38, 95],
    [760, -77, 247, 821, 39, 103],
    [736, -1, 242, 796, 193, 114],
    [733, 27, 221, 863, 314, 129],
    [668, -6, 129, 631, 147, 191],
    [706, 14, 186, 790, 277, 286],
    [699, 76, 200, 868, 448, 321],
    [627, -5, 112, 632, 85, 374],
    [802, 69, 138, 1056, 634, 479],
    [842, 221, 198, 1626, 1132, 923],
];

const FINGER: [ShapeFeatures; EACH] = [
    [812, 209, 197, 854, 170, 120],
    [751, 360, 113, 832, 368, 184],
    [890, 303, 219, 913, 534, 204],
    [779, 331, 185, 771, 486, 260],
    [787, 306, 200, 726, 379, 266],
    [804, 279, 293, 831, 526, 289],
    [886, 317, 312, 933, 647, 303],
    [858, 313, 353, 814, 600, 351],
    [883, 350, 221, 846, 574, 399],
    [886, 323, 462, 828, 649, 404],
    [853, 323, 346, 863, 647, 408],
    [892, 351, 431, 834, 675, 455],
    [892, 353, 505, 830, 692, 485],
    [943, 387, 300, 891, 719, 497],
    [1004, 404, 426, 882, 770, 562],
    [1013, 405, 306, 995, 839, 715],
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
