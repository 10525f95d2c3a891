//! Learns the built-in base of shapes from three generators, and judges each generator by a base that was
//! learned without it. `cargo test -p taxel-core --test core shape::base -- --nocapture` prints the tables of
//! `core/src/shape/base.rs` and the figures of `docs/shapes.md`.

mod examples;
mod glvq;

use crate::shape::kinds::{GENERATORS, Quality};
use examples::{ExampleSet, GRIDS, drawn};
use glvq::{Learned, learn};
use std::sync::LazyLock;
use taxel_core::shape::Base;

/// Images of each generator, grid and quality.
const EACH: usize = 900;

/// What the base is learned from, and that base: for all tests.
static DRAWN: LazyLock<Vec<ExampleSet>> = LazyLock::new(|| drawn(EACH, 1));
static ALL: LazyLock<Learned> = LazyLock::new(|| learned(DRAWN.iter()));

/// What is learned from some sets, each of which counts as much.
fn learned<'a>(sets: impl Iterator<Item = &'a ExampleSet>) -> Learned {
    let mut examples = Vec::new();
    for set in sets {
        let each = 1.0 / set.examples.len() as f64;
        examples.extend(set.examples.iter().map(|(features, class)| (*features, *class, each)));
    }
    learn(&examples)
}

#[test]
fn the_built_in_base_is_what_three_generators_give() {
    ALL.print();
    let built_in = Base::BUILT_IN;
    let held: Vec<_> = built_in.prototypes.iter().map(|known| (known.class, known.features)).collect();
    assert_eq!(ALL.prototypes(), held);
}

#[test]
fn a_generator_that_was_left_out_is_known() {
    let others = drawn(600, 2);
    let left_out = GENERATORS.map(|kind| learned(DRAWN.iter().filter(|set| set.kind != kind)));
    println!("grid, quality: all generators learned, each left out");
    for grid in GRIDS {
        for (quality, least) in [Quality::Clean, Quality::Noisy, Quality::Hard].into_iter().zip(least(grid)) {
            let own = |kind| {
                let set =
                    others.iter().find(|set| (set.kind, set.quality, set.grid) == (kind, quality, grid));
                &set.expect("there is one of each").examples
            };
            let known = GENERATORS.map(|kind| ALL.percent(own(kind)));
            let unknown = [0, 1, 2].map(|i| left_out[i].percent(own(GENERATORS[i])));
            println!("{} x {} {quality:?}: {known:.1?}, {unknown:.1?}", grid[0], grid[1]);
            for (known, unknown) in known.into_iter().zip(unknown) {
                assert!(
                    unknown >= least && unknown >= known - 3.0,
                    "{grid:?} {quality:?}: {known} {unknown}"
                );
            }
        }
    }
}

/// Least share of a generator that a base learned without it must recognise, in percent, by quality.
fn least(grid: [u16; 2]) -> [f64; 3] {
    match grid {
        [4, _] => [83.0, 78.0, 64.0],
        [16, _] => [95.0, 95.0, 78.0],
        _ => [98.0, 98.0, 91.0],
    }
}
