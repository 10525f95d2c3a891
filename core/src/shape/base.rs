//! The base of shapes that comes with the program: rectangle, round, finger.
//!
//! The prototypes are learned, not measured: 16 per class, placed by k-means and moved by generalised
//! learning vector quantisation (GLVQ) in the space of [`features`](super::features). The examples were the
//! rectangles, discs and fingers of the project's reference set `shapes.npz` (grids 4 x 16, 16 x 16 and 32 x
//! 64; gain 0.2 to 0.9; unchanged, and blurred, median-filtered and with noise of 0, 1 and 3 % of the full
//! scale: the sets B_n0, C_n0, C_n1, C_n3 and D_n3; 840 images), and 1,800 drawn ones: discs, rotated
//! rectangles with sides of 1 : 1 to 1 : 1.8, and fingers (capsules with a pressure that falls off towards
//! the rim and one end), in the same grids and gains, blurred by 0 to 0.8 taxel, with noise of 0 and 1 %, and
//! the conservative filter.
//!
//! Accuracy among three classes, by the nearest prototype (chance is 33 %):
//!
//! | | 4 x 16 | 16 x 16 | 32 x 64 |
//! |---|--:|--:|--:|
//! | reference set, learned from (in five folds by shape: 71, 77, 89 %) | 71 % | 79 % | 89 % |
//! | drawn by `core/tests/core/shape/built_in.rs`, from codes to class | 86 % | 96 % | 89 % |
//!
//! On a grid of 4 x 16 a shape has some 12 taxels, and most errors confuse square and round; on finer grids,
//! short fingers and rectangles.

use super::features::{FEATURES, ShapeFeatures};
use super::knn::{Base, Class, Prototype};

/// Prototypes of each class.
const EACH: usize = 16;

const RECTANGLE: [ShapeFeatures; EACH] = [
    [3385, 2140, 396, -40],
    [3011, 1583, 245, 213],
    [2982, 1727, 243, 246],
    [3118, 1764, 270, 285],
    [3808, 1923, 664, 303],
    [2977, 1855, 264, 309],
    [3228, 1772, 322, 344],
    [3165, 1705, 152, 375],
    [3369, 1752, 423, 385],
    [3141, 1891, 140, 388],
    [3230, 1905, 281, 430],
    [3561, 1801, 565, 446],
    [3268, 1741, 290, 466],
    [3236, 1716, 76, 473],
    [3408, 1781, 446, 491],
    [3874, 1958, 720, 519],
];

const ROUND: [ShapeFeatures; EACH] = [
    [2591, 1323, -52, 172],
    [3323, 1974, 212, 203],
    [2826, 1610, 35, 213],
    [2913, 1756, 31, 236],
    [3014, 1882, 92, 254],
    [3030, 1636, 1, 313],
    [3075, 1631, -2, 349],
    [3074, 1723, 0, 352],
    [3050, 1848, -8, 367],
    [3129, 1632, -13, 434],
    [3125, 1695, -22, 434],
    [3081, 1714, -18, 453],
    [3131, 1656, -14, 463],
    [3151, 1613, -13, 466],
    [3149, 1634, -16, 494],
    [3094, 1678, -13, 500],
];

const FINGER: [ShapeFeatures; EACH] = [
    [2817, 1599, 547, 189],
    [3017, 1975, 360, 194],
    [3230, 1860, 608, 207],
    [3662, 2130, 757, 238],
    [3515, 1975, 695, 279],
    [3144, 2022, 421, 281],
    [3513, 2212, 608, 332],
    [3306, 2053, 498, 334],
    [4237, 2404, 851, 352],
    [3439, 2043, 596, 402],
    [3845, 2224, 791, 404],
    [4051, 2187, 818, 423],
    [3634, 2118, 682, 441],
    [4530, 2426, 886, 464],
    [3286, 1975, 521, 468],
    [3703, 1926, 734, 487],
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

impl Base {
    /// Rectangle, round and finger.
    pub const BUILT_IN: Base = Base { names: &["rectangle", "round", "finger"], prototypes: &PROTOTYPES };
}
