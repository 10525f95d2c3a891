//! What must not change when a touch moves, turns, is mirrored or pressed harder.

use crate::rig::Rig;
use taxel_core::contact::{Contact, ContactState};

#[test]
fn translation_is_exact() {
    let shape = [[300u16, 900, 0], [4095, 4095, 700], [0, 61, 60]];
    let mut rig = Rig::mat();
    let mut first: Option<Contact> = None;
    for (top, left) in [(0, 0), (7, 3), (61, 29), (30, 29), (61, 0)] {
        rig.clear();
        for (row, values) in (top..).zip(shape) {
            for (column, value) in (left..).zip(values) {
                rig.set(0, row, column, value);
            }
        }
        *rig.state = ContactState::default();
        let contact = rig.only();
        let Some(first) = &first else {
            first = Some(contact);
            continue;
        };
        let moved = (contact.x.0 - first.x.0, contact.y.0 - first.y.0);
        assert_eq!(moved, (i32::from(left) << 16, i32::from(top) << 16));
        assert_eq!((contact.azimuth, contact.anisotropy), (first.azimuth, first.anisotropy));
        assert_eq!((contact.breadth, contact.total, contact.area), (first.breadth, first.total, first.area));
    }
}
