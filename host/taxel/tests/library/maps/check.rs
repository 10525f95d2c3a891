//! Results of `taxel fcm check`.

use crate::maps::files::map;
use taxel::fcm::check::check;
use taxel::fcm::load;
use taxel::fcm::map::{ConceptFile, EdgeFile, MapFile};
use taxel::fcm::weight::Weight;

fn edge(from: usize, to: usize, weight: f64) -> EdgeFile {
    let name = |at: usize| format!("c{at}");
    EdgeFile {
        from: name(from),
        to: name(to),
        weight: Weight::Number(weight),
        fixed: false,
        note: String::new(),
    }
}

/// A map of `n` concepts named c0, c1 and so on.
fn numbered(n: usize, edges: impl IntoIterator<Item = (usize, usize, f64)>) -> MapFile {
    let concept = |at| ConceptFile { name: format!("c{at}"), ..ConceptFile::default() };
    let edge = edges.into_iter().map(|(from, to, weight)| edge(from, to, weight)).collect();
    MapFile { concept: (0..n).map(concept).collect(), edge, ..MapFile::empty("numbered") }
}

#[test]
fn the_shipped_map_has_no_fault() {
    let found = check(&load::map("tactile").unwrap()).unwrap();
    assert!(found.faults.is_empty(), "{:?}", found.faults);
    assert!(found.warnings.is_empty(), "{:?}", found.warnings);
    assert_eq!((found.sweep.starts, found.sweep.cycles.0, found.sweep.unsettled.0), (4096, 0, 0));
    assert!((2..=6).contains(&found.sweep.steps), "{}", found.sweep.steps);
}

#[test]
fn what_nothing_reaches_is_named() {
    let text = "name = \"m\"\n[[concept]]\nname = \"press\"\n[[concept]]\nname = \"lonely\"\n[[concept]]\nname = \"kindness\"\n\
                [[concept]]\nname = \"attack\"\n[[input]]\nconcept = \"press\"\nsource = \"press\"\nrise = [0, 9]\n\
                [[edge]]\nfrom = \"press\"\nto = \"kindness\"\nweight = -1\n\
                [[edge]]\nfrom = \"lonely\"\nto = \"attack\"\nweight = 1\n";
    let found = check(&map(text)).unwrap();
    assert_eq!(
        found.warnings,
        [
            "concept lonely has neither an input nor a cause: it keeps its initial value",
            "no input reaches the intention attack"
        ]
    );
}

#[test]
fn a_map_that_cycles_or_never_settles_is_named_with_its_inputs() {
    // Two that inhibit each other, one step apart: from 0 with a push they alternate for ever.
    let mut map = numbered(3, [(0, 1, 1.0), (1, 2, -1.0), (2, 1, 1.0)]);
    map.transfer = taxel_core::intent::Transfer::Trivalent;
    let found = check(&map).unwrap();
    let cycles = found.warnings.iter().find(|w| w.starts_with("cycles from ")).unwrap();
    assert!(cycles.contains("of 9 inputs, with period 4 from c0="), "{cycles}");
    assert!(found.warnings.contains(&"causes go round: c1 -> c2 -> c1".to_string()), "{:?}", found.warnings);
    // Just beyond the limit of rest, a feedback grows by a ten-thousandth per step.
    map = numbered(2, [(0, 1, 0.0001), (1, 1, 1.0)]);
    map.concept[1].threshold = Some(0.0);
    map.transfer = taxel_core::intent::Transfer::Tanh;
    let slow = check(&map).unwrap();
    let said = slow.warnings.iter().any(|w| w.contains("does not settle") || w.contains("steps to settle"));
    assert!(said, "{:?}", slow.warnings);
}

#[test]
fn what_the_board_cannot_hold_is_a_fault() {
    let full = |n: usize, edges: usize| {
        let found = check(&numbered(n, (0..edges).map(|k| (k % n, (k + k / n) % n, 0.1)))).unwrap();
        found.faults.join(" ")
    };
    assert_eq!(full(65, 10), "map numbered: 65 concepts, and there is room for 64");
    assert_eq!(full(64, 257), "map numbered: 257 edges, and there is room for 256");
    assert_eq!(full(64, 256), "");
    let huge = numbered(129, []);
    assert_eq!(
        check(&huge).unwrap_err().to_string(),
        "map numbered: 129 concepts, and there is room for 128"
    );
}
