//! The base of shapes that comes with the program: rectangle, round, finger.
//!
//! The prototypes are learned, not measured: 16 per class, placed by k-means and moved by generalised
//! learning vector quantisation (GLVQ) in the space of [`features`](super::features). The examples are drawn
//! by three generators that share no formula for pressure, on grids of 4 x 16, 16 x 16 and 32 x 64
//! (`core/tests/core/shape/kinds`). `core/tests/core/shape/base` learns the prototypes anew, asserts that they
//! are these, and judges each generator by a base that was learned without it. `docs/shapes.md` has the
//! figures.

use super::features::{FEATURES, ShapeFeatures};
use super::knn::{Base, Class, Prototype};

/// Prototypes of each class.
const EACH: usize = 16;

const RECTANGLE: [ShapeFeatures; EACH] = [
    [822, 25, 392, 608, 672, -421],
    [761, 165, 257, 469, 439, -137],
    [748, 138, 289, 543, 562, -123],
    [788, 51, 375, 494, 509, -62],
    [794, 169, 353, 536, 551, -62],
    [832, 229, 292, 435, 425, -32],
    [754, 141, 242, 454, 478, -18],
    [713, 45, 320, 547, 743, -9],
    [855, 266, 391, 457, 524, -1],
    [888, 312, 339, 419, 442, 14],
    [924, 333, 450, 441, 469, 18],
    [745, -18, 282, 537, 341, 20],
    [700, 219, 168, 422, 72, 41],
    [730, 116, 196, 386, 361, 41],
    [766, 270, 217, 293, 217, 79],
    [752, 354, 294, 1028, 439, 129],
];

const ROUND: [ShapeFeatures; EACH] = [
    [675, -47, 141, 482, 586, -427],
    [753, -21, 391, 512, 520, -272],
    [760, -35, 375, 650, 588, -221],
    [782, 46, 227, 931, 430, -220],
    [735, -22, 289, 574, 520, -192],
    [725, -25, 244, 480, 489, -159],
    [656, -2, 179, 416, 451, -143],
    [714, 7, 238, 536, 368, -135],
    [675, -28, 193, 363, 362, -126],
    [756, -53, 240, 596, 600, -122],
    [743, 9, 267, 628, 477, -90],
    [634, 26, 160, 612, 286, -56],
    [648, 88, 156, 456, -28, -4],
    [620, 38, 141, 57, 290, -2],
    [796, 19, 225, 1137, 573, 34],
    [723, -44, 219, 585, 527, 57],
];

const FINGER: [ShapeFeatures; EACH] = [
    [798, 316, 267, 598, 617, -229],
    [939, 402, 248, 531, 960, -216],
    [958, 383, 470, 490, 532, -154],
    [906, 365, 373, 527, 552, -146],
    [793, 319, 172, 453, 486, -144],
    [789, 236, 213, 533, 617, -124],
    [827, 384, 163, 468, 336, -121],
    [930, 384, 284, 509, 516, -111],
    [868, 332, 316, 609, 585, -96],
    [987, 425, 247, 503, 425, -84],
    [1052, 431, 401, 491, 542, -84],
    [850, 352, 230, 545, 439, -77],
    [815, 344, 193, 446, 112, -38],
    [941, 366, 187, 544, 180, 88],
    [890, 327, 220, 524, 614, 98],
    [1079, 405, 285, 867, 621, 212],
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
