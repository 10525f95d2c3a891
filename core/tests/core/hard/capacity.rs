//! More contacts than there is room for, images that are too short, memory.

use crate::hard::rig::{ContactRig, taxels};
use std::sync::Mutex;
use taxel_core::condition::{Image, Rows};
use taxel_core::contact::{Contact, ContactConfig, ContactState, Phase};
use taxel_core::format::Micros;
use taxel_core::garment::{Garment, Layout};

#[test]
fn checkerboard_of_dots() {
    let mut rig = ContactRig::mat();
    rig.draw(|x, y| x % 2 == 0 && y % 2 == 0, 1000).set(0, 62, 30, 2000);
    let frame = rig.frame();
    assert_eq!((frame.present.len(), frame.dropped, frame.overflow), (16, 496, 0));
    // The greatest is kept, and among equals the first.
    assert!(frame.present.iter().any(|c| c.total == 2000));
    assert_eq!((frame.present[0].x, frame.present[0].y), (taxels(0.0), taxels(0.0)));
    // Which ones are kept does not flicker.
    let ids: Vec<u32> = frame.present.iter().map(|c| c.id).collect();
    let again = rig.frame();
    assert_eq!(again.present.iter().map(|c| c.id).collect::<Vec<_>>(), ids);
    assert!(again.present.iter().all(|c| c.phase == Phase::Held));
    // A full checkerboard is one contact through its corners: as many runs as there can be.
    rig.clear().draw(|x, y| (x + y) % 2 == 0, 1000);
    let contact = rig.only();
    assert_eq!((contact.area, contact.total), (1024, 1_024_000));
}

/// With room for all of them, the 512 dots are 512 contacts, each itself, and in the next frame each is the
/// same again.
#[test]
fn every_label_of_a_checkerboard() {
    let layout = Layout::build(&Garment::mat(), 2048, u16::MAX).unwrap();
    let dot = |i: u16| ((i % 32) | (i / 32)) & 1 == 0;
    let values: Vec<u16> = (0..2048).map(|i| if dot(i) { 500 + i } else { 0 }).collect();
    // A megabyte, for the distances of each from each: not on the stack of a test.
    static STATE: Mutex<ContactState<512, 512>> = Mutex::new(ContactState::new());
    let mut state = STATE.lock().unwrap();
    let stage = ContactConfig::default().build().unwrap();
    let image = Image { values: &values, rows: &Rows::of(&layout, &values) };
    for (frame, phase) in [Phase::Onset, Phase::Held].into_iter().enumerate() {
        let touches = stage.process(&mut state, &layout, &image, Micros(5128 * frame as u64));
        assert_eq!((touches.present.len(), touches.dropped, touches.overflow), (512, 0, 0));
        for ((contact, id), i) in touches.present.iter().zip(1..).zip((0..2048).filter(|i| dot(*i))) {
            assert_eq!((contact.id, contact.phase), (id, phase));
            assert_eq!((contact.x.0, contact.y.0), (i32::from(i % 32) << 16, i32::from(i / 32) << 16));
            assert_eq!((contact.total, contact.area), (500 + u32::from(i), 1));
        }
    }
}

#[test]
fn too_many_runs_are_counted() {
    let layout = Layout::build(&Garment::mat(), 2048, u16::MAX).unwrap();
    let values: Vec<u16> = (0..2048).map(|i| if i % 2 == 0 && i / 32 % 2 == 0 { 500 } else { 0 }).collect();
    let mut state: ContactState<4, 100> = ContactState::new();
    let stage = ContactConfig::default().build().unwrap();
    let image = Image { values: &values, rows: &Rows::ALL };
    let touches = stage.process(&mut state, &layout, &image, Micros(0));
    assert_eq!((touches.present.len(), touches.dropped, touches.overflow), (4, 96, 412));
}

#[test]
fn more_than_fit() {
    let mut rig = ContactRig::mat();
    for i in 0..20u16 {
        rig.set(0, 3 * i, 5, 1000 + 10 * i);
    }
    let frame = rig.frame();
    assert_eq!((frame.present.len(), frame.dropped), (16, 4));
    assert!(frame.present.iter().all(|c| c.total >= 1040));
}

#[test]
fn a_drop_out_of_any_size_does_not_panic() {
    // An image shorter than the layout, and none at all.
    let mut rig = ContactRig::mat();
    rig.fill([0, 63], [0, 31], 900).frame();
    let stage = ContactConfig::default().build().unwrap();
    for length in [0, 1, 31, 33, 2047] {
        let image = Image { values: &rig.values[..length], rows: &Rows::ALL };
        let touches = stage.process(&mut rig.state, &rig.layout, &image, Micros(0));
        let total: u32 = touches.present.iter().map(|c| c.total).sum();
        assert_eq!(total, 900 * length as u32);
    }
}

/// What the table of the module says about memory (on a 64-bit host, where little is larger).
#[test]
fn memory_is_as_documented() {
    let size = size_of::<ContactState<16, 512>>();
    println!("ContactState<16, 512>: {size} bytes");
    assert!(size <= 16 * (4 * 16 + 940) + 56 * 512 + 4400, "{size}");
}

#[test]
fn a_contact_travels_whole_and_small() {
    let mut rig = ContactRig::new(&Garment::reference());
    rig.bar(0, 9, 12..16, 3000);
    rig.bar(1, 9, 0..3, 3000);
    let contact = rig.only();
    let bytes = postcard::to_allocvec(&contact).unwrap();
    assert_eq!(postcard::from_bytes::<Contact>(&bytes).unwrap(), contact);
    println!("a contact on the wire: {} bytes", bytes.len());
    assert!(bytes.len() <= 64, "{}", bytes.len());
}
