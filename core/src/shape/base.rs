//! The base of shapes that comes with the program: rectangle, round, finger.
//!
//! The prototypes are learned, not measured: 16 per class, placed by k-means and moved by generalised
//! learning vector quantisation (GLVQ) in the space of [`features`](super::features).
//! `host/tests/recorded/base` draws the examples, learns the tables below and asserts that they are these:
//! 600 images of each of three generators (`host/tests/library/kinds`) on each grid, clean, noisy and hard
//! (blur, 3 % of noise, median filter), and 275 images of tactnet. The project's reference set `shapes.npz`
//! has no part in it.
//!
//! Right answers among three classes (chance is 33 %), clean and hard:
//!
//! | | 4 x 16 | 16 x 16 | 32 x 64 |
//! |---|--:|--:|--:|
//! | generator left out: even pressure | 89, 45 % | 94, 80 % | 89, 92 % |
//! | generator left out: elastic layer | 81, 48 % | 92, 83 % | 95, 92 % |
//! | generator left out: bodies in foam | 85, 51 % | 91, 84 % | 95, 93 % |
//! | `shapes.npz` (sets B_n0 and C_n3), never seen | 71, 62 % | 78, 73 % | 83, 76 % |
//!
//! Of tactnet 89 % are known as round, rectangular or finger-like (five folds). On clean images of
//! `shapes.npz` 36 of 37 errors are rectangles: 25 are taken for fingers, 11 for discs.

use super::features::Features;
use super::knn::{Base, Class, Prototype};
use crate::format::name;
use heapless::Vec;

/// Prototypes of the built-in base.
pub const BUILT_IN: usize = 48;

const RECTANGLE: [Features; 16] = [
    [1499, 798, 172, 175],
    [1422, 889, 192, 269],
    [1519, 819, 329, 289],
    [1579, 832, 118, 291],
    [1539, 925, 216, 341],
    [1664, 855, 390, 342],
    [1748, 933, 478, 402],
    [1611, 905, 322, 409],
    [1587, 870, 157, 416],
    [1634, 871, 78, 457],
    [1757, 952, 476, 499],
    [1609, 1077, 82, 545],
    [2068, 1638, 281, 615],
    [2617, 2086, 502, 629],
    [2878, 2399, 699, 639],
    [2545, 1874, 600, 667],
];

const ROUND: [Features; 16] = [
    [3145, 2024, 654, 29],
    [1695, 932, 255, 202],
    [1354, 791, 47, 230],
    [1542, 942, 103, 257],
    [1485, 838, 15, 314],
    [1819, 1010, 336, 358],
    [1501, 919, 30, 377],
    [1639, 1066, 74, 393],
    [1547, 856, -18, 463],
    [2848, 1788, 565, 474],
    [2562, 1589, 422, 490],
    [2778, 2024, 234, 537],
    [3201, 2645, 192, 542],
    [2922, 2246, 294, 552],
    [2943, 2312, 119, 552],
    [2749, 1361, 813, 601],
];

const FINGER: [Features; 16] = [
    [1381, 841, 492, 142],
    [1614, 1049, 368, 259],
    [1617, 1001, 557, 322],
    [1773, 1048, 676, 384],
    [2554, 1879, 662, 391],
    [2908, 2301, 515, 442],
    [1646, 962, 600, 451],
    [3082, 2268, 912, 463],
    [3370, 2003, 968, 470],
    [3473, 2724, 797, 501],
    [3227, 2306, 920, 507],
    [2155, 1476, 851, 513],
    [2749, 1927, 862, 513],
    [4486, 3329, 1001, 521],
    [3868, 3110, 909, 524],
    [3078, 2592, 503, 540],
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
