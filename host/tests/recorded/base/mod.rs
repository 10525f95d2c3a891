//! Learns the base of shapes that is built in, and tells what it is worth on what it has not seen.
//!
//! It is learned from three generators of shapes and from tactnet; `shapes.npz` has no part in it.

mod examples;
mod glvq;

use crate::kinds::KINDS;
use examples::{Cell, drawn, tactnet};
use glvq::{Learned, learn};
use taxel_core::shape::{BUILT_IN, Base};

/// Examples of tactnet count as so many cells of drawn ones.
const TACTNET: f64 = 3.0;
/// Parts that tactnet is divided into: each is told by what was learned from the others.
const FOLDS: usize = 5;

/// What is learned from some cells, weighed so that each counts once, and from a part of tactnet.
fn learned(cells: &[&Cell], objects: &Cell) -> Learned {
    let mut examples = Vec::new();
    for (cell, weight) in cells.iter().map(|cell| (*cell, 1.0)).chain([(objects, TACTNET)]) {
        let each = weight / cell.examples.len() as f64;
        examples.extend(cell.examples.iter().map(|(features, class)| (*features, *class, each)));
    }
    learn(&examples)
}

#[test]
fn the_built_in_base_is_what_these_examples_give() {
    let objects = tactnet();
    let cells = drawn(600, 1);
    let all: Vec<&Cell> = cells.iter().collect();
    let base = learned(&all, &objects);
    base.print();
    let held: Vec<_> =
        Base::<BUILT_IN>::built_in().prototypes.iter().map(|known| (known.class, known.features)).collect();
    assert_eq!(base.prototypes(), held);
}

#[test]
fn a_generator_that_was_left_out_is_known() {
    let (objects, cells, others) = (tactnet(), drawn(600, 1), drawn(600, 2));
    for kind in KINDS {
        let rest: Vec<&Cell> = cells.iter().filter(|cell| cell.kind != kind).collect();
        let base = learned(&rest, &objects);
        for cell in others.iter().filter(|cell| cell.kind == kind) {
            let [rows, columns] = cell.grid;
            let percent = base.percent(&cell.examples);
            println!("left out: {kind:?} {:?}, {rows} x {columns}: {percent:.1} %", cell.view);
            assert!(percent >= cell.least(), "{kind:?} {:?}: {percent:.1} %", cell.view);
        }
    }
}

#[test]
fn objects_that_were_left_out_are_known() {
    let (objects, cells) = (tactnet(), drawn(600, 1));
    let all: Vec<&Cell> = cells.iter().collect();
    let part = |fold: usize, inside: bool| -> Cell {
        let examples = objects.examples.iter().enumerate();
        let chosen = examples.filter(|(at, _)| (at % FOLDS == fold) == inside).map(|(_, example)| *example);
        Cell { examples: chosen.collect(), ..objects }
    };
    let percents = (0..FOLDS).map(|fold| {
        let base = learned(&all, &part(fold, false));
        base.percent(&part(fold, true).examples)
    });
    let percent = percents.sum::<f64>() / FOLDS as f64;
    println!("tactnet, round, rectangular or finger-like, {FOLDS} folds: {percent:.1} %");
    assert!(percent >= 89.0);
}
