//! Learns the built-in base of shapes from three generators, and judges each generator by a base that was
//! learned without it: all of them with `TAXEL_CAMPAIGN=1`, else the one that differs most from the others.
//! `cargo test -p taxel-core --test core shape::base -- --nocapture` prints the tables of
//! `core/src/shape/base.rs` and the figures of `docs/evidence/shapes.md`.

mod examples;
mod glvq;

use crate::shape::kinds::{GENERATORS, Generator};
use examples::{ExampleSet, drawn};
use glvq::{Learned, learn};
use std::sync::LazyLock;
use taxel_core::shape::Base;

/// Images of each generator, grid and quality.
const EACH: usize = 900;

/// What the base is learned from, and that base: for all tests.
static DRAWN: LazyLock<Vec<ExampleSet>> = LazyLock::new(|| drawn(&GENERATORS, EACH, 1));
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
    let judged = if crate::is_campaign() { &GENERATORS[..] } else { &[Generator::Depth] };
    println!("generator, grid, quality: all generators learned, this one left out");
    for kind in judged {
        let left_out = learned(DRAWN.iter().filter(|set| set.kind != *kind));
        for ExampleSet { grid, quality, examples, .. } in drawn(&[*kind], 600, 2) {
            let (known, unknown) = (ALL.percent(&examples), left_out.percent(&examples));
            println!("{kind:?} {} x {} {quality:?}: {known:.1}, {unknown:.1}", grid[0], grid[1]);
            let least = least(grid)[quality as usize];
            assert!(
                unknown >= least && unknown >= known - 3.0,
                "{kind:?} {grid:?} {quality:?}: {known} {unknown}"
            );
        }
    }
}

/// Least share of a generator that a base learned without it must recognise, in percent: clean, noisy, hard.
fn least(grid: [u16; 2]) -> [f64; 3] {
    match grid {
        [4, _] => [83.0, 78.0, 64.0],
        [16, _] => [95.0, 95.0, 78.0],
        _ => [98.0, 98.0, 91.0],
    }
}
