//! The same contacts with the same sums as imageproc finds, which `tests/reference/contacts.json` holds;
//! `cargo xtask campaign --only peers` compares that with imageproc itself.

#[path = "../../../tests/peers/ours.rs"]
mod ours;
#[path = "../../../tests/peers/scenes.rs"]
mod scenes;

use ours::{Ours, Sums};
use taxel_core::format::Code;

fn codes(values: &[u8]) -> Vec<Code> {
    values.iter().map(|value| Code(u16::from(*value))).collect()
}

#[test]
fn the_same_contacts_with_the_same_sums() {
    let found = include_str!("../../../tests/reference/contacts.json");
    let found: Vec<Vec<Sums>> = serde_json::from_str(found).unwrap();
    let panels = scenes::panels();
    assert_eq!(found.len(), panels.len());
    for (at, (values, theirs)) in panels.iter().zip(found).enumerate() {
        let mut ours: Vec<Sums> = Ours::default().segment(&codes(values)).collect();
        ours.sort_unstable();
        assert_eq!(ours, theirs, "panel {at}");
    }
}

#[test]
fn contacts_that_are_followed_are_as_many() {
    for scene in scenes::all() {
        assert_eq!(Ours::default().follow(&codes(&scene.values)), scene.contacts, "{}", scene.name);
        assert_eq!(Ours::default().segment(&codes(&scene.values)).count(), scene.contacts, "{}", scene.name);
    }
}
