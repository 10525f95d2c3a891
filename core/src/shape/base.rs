//! The base of shapes that comes with the program: rectangle, round, finger.
//!
//! The prototypes are learned, not measured: 16 per class, placed by k-means and moved by generalised learning
//! vector quantisation (GLVQ) in the space of [`features`](super::features). The examples are drawn by three
//! generators that share no formula for pressure (`host/tests/library/kinds`), on grids of 4 x 16, 16 x 16 and
//! 32 x 64. `host/tests/library/base` learns them anew, asserts that they are these, and judges each generator
//! by a base that was learned without it; `docs/shapes.md` tells what they are worth.

use super::features::Features;
use super::knn::{Base, Class, Prototype};
use crate::format::name;
use heapless::Vec;

/// Prototypes of the built-in base.
pub const BUILT_IN: usize = 48;

const RECTANGLE: [Features; 16] = [
    [812, 136, 349, 642, 602, -395],
    [819, 114, 124, 550, 495, -147],
    [796, 76, 374, 470, 505, -59],
    [901, 120, 208, 614, 515, -26],
    [780, 128, 339, 531, 555, -12],
    [840, 266, 264, 400, 437, 7],
    [821, 207, 366, 491, 561, 13],
    [873, 284, 411, 471, 521, 14],
    [764, 126, 250, 414, 441, 23],
    [934, 356, 309, 414, 455, 29],
    [988, 383, 445, 450, 507, 31],
    [955, 364, 391, 449, 573, 48],
    [1081, 425, 421, 434, 471, 50],
    [878, 349, 204, 289, 135, 146],
    [833, 111, 337, 840, 200, 182],
    [953, 187, 267, 817, 777, 440],
];

const ROUND: [Features; 16] = [
    [777, -88, 206, 633, 439, -356],
    [762, -30, 417, 519, 521, -280],
    [755, -15, 291, 788, 499, -248],
    [753, -48, 350, 600, 555, -228],
    [875, 129, 133, 604, 586, -219],
    [726, -32, 247, 539, 512, -180],
    [843, 74, 98, 757, 307, -174],
    [692, -24, 169, 327, 523, -172],
    [838, 99, 142, 539, 493, -146],
    [710, -33, 197, 422, 421, -140],
    [748, -46, 239, 638, 573, -130],
    [702, -14, 227, 546, 399, -105],
    [742, 2, 288, 635, 454, -82],
    [565, -104, 139, 369, 117, -15],
    [787, -36, 240, 609, 539, 3],
    [940, 68, 50, 824, 422, 288],
];

const FINGER: [Features; 16] = [
    [522, 444, -109, 179, 273, -235],
    [786, 191, 401, 553, 561, -196],
    [838, 304, 288, 526, 531, -171],
    [878, 320, 425, 505, 572, -171],
    [814, 348, 172, 454, 248, -164],
    [724, 184, 276, 529, 558, -157],
    [1001, 406, 441, 487, 541, -148],
    [1175, 458, 453, 460, 564, -144],
    [682, 218, 194, 525, 458, -143],
    [968, 401, 311, 490, 503, -140],
    [797, 256, 274, 613, 669, -139],
    [937, 370, 345, 637, 575, -139],
    [763, 252, 276, 575, 520, -135],
    [1139, 453, 352, 483, 502, -109],
    [860, 348, 234, 584, 439, -63],
    [1057, 436, 352, 577, 631, -44],
];

impl<const PROTOTYPES: usize> Base<PROTOTYPES> {
    /// Rectangle, round and finger; cut to the capacity, which should be at least [`BUILT_IN`].
    pub fn built_in() -> Self {
        let classes = [(Class::RECTANGLE, &RECTANGLE), (Class::ROUND, &ROUND), (Class::FINGER, &FINGER)];
        let mut base = Base { names: Vec::new(), prototypes: Vec::new() };
        for ((class, table), text) in classes.into_iter().zip(["rectangle", "round", "finger"]) {
            let _ = base.names.push(name(text));
            for features in table {
                let _ = base.prototypes.push(Prototype { class, features: *features });
            }
        }
        base
    }
}
