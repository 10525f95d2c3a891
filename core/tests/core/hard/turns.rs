//! Whose form is looked at: that of the new ones, and of one of the others in turn.

use crate::hard::rig::ContactRig;
use taxel_core::contact::{Contact, ContactConfig};

/// Bars along the rows (1 x 4) or the columns (4 x 1), 12 columns apart.
fn bars(rig: &mut ContactRig, upright: &[bool]) {
    rig.clear();
    for (left, upright) in (0..).step_by(12).zip(upright) {
        match upright {
            true => rig.fill([10, 13], [left, left], 400),
            false => rig.fill([10, 10], [left, left + 3], 400),
        };
    }
}

fn degrees(contact: &Contact) -> i32 {
    contact.azimuth.expect("a bar has a direction").to_radians().to_degrees().round() as i32
}

#[test]
fn a_form_is_as_old_as_there_are_contacts_at_most() {
    let mut rig = ContactRig::mat();
    bars(&mut rig, &[false; 3]);
    assert_eq!(rig.frame().looked, [true; 3], "all are new");
    bars(&mut rig, &[true; 3]);
    let mut seen = [false; 3];
    for round in 0..3 {
        let frame = rig.frame();
        assert_eq!(frame.looked.iter().filter(|looked| **looked).count(), 1, "{round}");
        for (seen, looked) in seen.iter_mut().zip(&frame.looked) {
            *seen |= *looked;
        }
        // What was looked at is as it is, the rest as it was; pressure, area and place are always those of
        // the frame.
        for ((contact, seen), left) in frame.present.iter().zip(seen).zip([0, 12, 24]) {
            assert_eq!(degrees(contact), if seen { 90 } else { 0 }, "{round}");
            assert_eq!((contact.area, contact.total, contact.x.0), (4, 1600, left << 16), "{round}");
        }
    }
    assert_eq!(seen, [true; 3]);
}

#[test]
fn as_many_forms_are_looked_at_as_are_asked_for() {
    for (in_frame, oldest) in [(0, 0), (1, 4), (2, 2), (3, 1), (5, 0), (200, 0)] {
        let mut rig = ContactRig::mat();
        rig.stage = ContactConfig { forms_in_frame: in_frame, ..*rig.stage.config() }.build().unwrap();
        for row in [4, 14, 24, 34, 44] {
            rig.fill([row, row], [4, 7], 400);
        }
        assert_eq!(rig.frame().ages, [0; 5], "all are new");
        let frames: Vec<_> = (0..20).map(|_| rig.frame().ages).collect();
        let count = |ages: &Vec<u8>| ages.iter().filter(|age| **age == 0).count();
        let most = if in_frame == 0 { 5 } else { in_frame.min(5).into() };
        assert_eq!(frames.iter().map(count).max(), Some(most), "{in_frame} in a frame");
        assert_eq!(frames.iter().flatten().max(), Some(&oldest), "{in_frame} in a frame");
    }
}

#[test]
fn what_is_new_takes_nobodys_turn() {
    let mut rig = ContactRig::mat();
    bars(&mut rig, &[false; 2]);
    rig.frame();
    // Something flickers beside them all the time, and begins anew in every other frame.
    let mut turns = [0; 2];
    for round in 0..8 {
        bars(&mut rig, &[false; 2]);
        if round % 2 == 0 {
            rig.set(0, 40, 20, 1000);
        }
        let frame = rig.frame();
        assert_eq!(frame.looked.get(2), (round % 2 == 0).then_some(&true));
        turns.iter_mut().zip(&frame.looked).for_each(|(turns, looked)| *turns += usize::from(*looked));
    }
    assert_eq!(turns, [4; 2]);
}

#[test]
fn the_only_contact_is_looked_at_in_every_frame() {
    let mut rig = ContactRig::mat();
    for upright in [false, true, false, false, true] {
        bars(&mut rig, &[upright]);
        let frame = rig.frame();
        assert_eq!((frame.looked[0], degrees(&frame.present[0])), (true, if upright { 90 } else { 0 }));
    }
}

#[test]
fn the_breadth_at_the_peak_is_one_that_was_seen() {
    let mut rig = ContactRig::mat();
    let mut breadths = Vec::new();
    for value in [200, 300, 900, 500, 400] {
        // Broader the harder it is pressed.
        let last = 10 + value / 100;
        rig.clear().fill([10, last], [0, 10], value).fill([30, 30], [0, 3], 400);
        let frame = rig.frame();
        let contact = &frame.present[0];
        if frame.looked[0] {
            breadths.push((contact.total, contact.breadth));
        }
        let (_, widest) = *breadths.iter().max_by_key(|(total, _)| *total).unwrap();
        assert_eq!(contact.peak_breadth, widest);
    }
    assert!(breadths.len() > 1);
}
