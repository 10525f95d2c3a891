//! Examples of shapes: their features as the board computes them, and what they are.

use crate::shape::drawn::CLASSES;
use crate::shape::kinds::{GENERATORS, Generator, QUALITIES, Quality};
use crate::shape::rig::{greatest, recorded};
use fastrand::Rng;
use taxel_core::condition::{Image, Rows};
use taxel_core::shape::{Class, ShapeFeatures, features, nmi};

/// Rows and columns.
const GRIDS: [[u16; 2]; 3] = [[4, 16], [16, 16], [32, 64]];

/// Examples of one kind.
pub struct ExampleSet {
    pub kind: Generator,
    pub quality: Quality,
    pub grid: [u16; 2],
    pub examples: Vec<(ShapeFeatures, Class)>,
}

/// So many of each of these generators, and of each grid and quality; what no contact is left of is drawn
/// anew.
pub fn drawn(kinds: &[Generator], count: usize, seed: u64) -> Vec<ExampleSet> {
    let mut sets = Vec::new();
    for (number, kind) in (0..).zip(GENERATORS).filter(|(_, kind)| kinds.contains(kind)) {
        for grid in GRIDS {
            for quality in QUALITIES {
                let rng =
                    Rng::with_seed(seed * 1000 + number * 100 + u64::from(grid[0]) * 3 + quality as u64);
                sets.push(set(kind, quality, grid, count, rng));
            }
        }
    }
    sets
}

fn set(kind: Generator, quality: Quality, grid: [u16; 2], count: usize, mut rng: Rng) -> ExampleSet {
    let layout = recorded(grid[0], grid[1]);
    let mut example = |class| loop {
        let values = kind.image(class, grid, quality, &mut rng);
        let image = Image { values: &values, rows: &Rows::ALL };
        let seen = greatest(&layout, &image, |moments, quartic, contact| {
            features(&nmi(moments, contact.peak), quartic, contact)
        });
        if let Some(seen) = seen {
            return (seen, class);
        }
    };
    let examples = CLASSES.into_iter().cycle().take(count).map(&mut example).collect();
    ExampleSet { kind, quality, grid, examples }
}
