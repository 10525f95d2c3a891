//! Contacts across seams and at every border.

use crate::hard::rig::{ContactRig, taxels};
use taxel_core::garment::{Garment, Seam, SeamEdge, Side};

#[test]
fn across_the_seam_it_is_one() {
    // The chest's right side is sewn to the back's left side. A bar of 8 x 2 slides over, half a column at a
    // time.
    let mut rig = ContactRig::new(&Garment::reference());
    let mut way = Vec::new();
    for step in 0..=24 {
        rig.clear();
        for column in step..step + 8 {
            for row in 10..12 {
                if column < 16 {
                    rig.set(0, row, column, 1000)
                } else {
                    rig.set(1, row, column - 16, 1000)
                };
            }
        }
        let contact = rig.only();
        assert_eq!((contact.id, contact.total, contact.area), (1, 16_000, 16), "step {step}");
        let across = 16 * i32::from(contact.panel == 1);
        assert_eq!(contact.x.0 + (across << 16), i32::from(step * 2 + 7) << 15, "step {step}");
        assert_eq!((contact.y, contact.breadth), (taxels(10.5), 200));
        assert_eq!(contact.dx.0, i32::from(step) << 16);
        way.push(contact.panel);
    }
    assert_eq!(way.iter().filter(|p| **p == 0).count(), 13, "home is where most of it is");
    // 1 column in 5.128 ms is 195 columns per second, and the smoothing knows it by now.
    let contact = rig.frame().present[0].clone();
    assert!(contact.vx.to_f64() > 150.0 && contact.slip);
}

#[test]
fn both_sides_of_the_seam_are_fed_back() {
    let mut rig = ContactRig::new(&Garment::reference());
    rig.set(0, 5, 15, 800).set(1, 6, 0, 700).only();
    let feedback = rig.state.feedback();
    assert!(feedback.holds(0, 4, 14) && feedback.holds(1, 7, 1));
    assert!(!feedback.holds(1, 5, 14) && !feedback.holds(2, 5, 15));
    // Not neighbours across the seam: two rows apart.
    rig.clear().set(0, 5, 15, 800).set(1, 7, 0, 700);
    assert_eq!(rig.frame().present.len(), 2);
}

#[test]
fn a_hug_and_a_belt() {
    // From the chest around both flanks: three parts, each carried over its own seam.
    let mut rig = ContactRig::new(&Garment::reference());
    for row in 3..5 {
        rig.bar(0, row, 0..16, 500);
        rig.set(1, row, 0, 500).set(1, row, 1, 500).set(1, row, 14, 500).set(1, row, 15, 500);
    }
    let contact = rig.only();
    assert_eq!((contact.panel, contact.total, contact.area), (0, 20_000, 40));
    assert_eq!((contact.x, contact.y), (taxels(7.5), taxels(3.5)), "-2 to 17");
    // Closed around the body: one contact, cut where the second seam would close it.
    for row in 3..5 {
        rig.bar(1, row, 0..16, 500);
    }
    let contact = rig.only();
    assert_eq!((contact.panel, contact.total, contact.id), (0, 32_000, 1));
    assert_eq!((contact.x, contact.y), (taxels(15.5), taxels(3.5)), "0 to 31");
}

#[test]
fn a_sleeve_closes_on_itself() {
    let mut garment = Garment::recorded(20, 12);
    let edge = |side| SeamEdge { panel: 0, side, start: 0 };
    let seam = Seam { a: edge(Side::Right), b: edge(Side::Left), length: 20, reversed: false };
    garment.seams.push(seam).unwrap();
    let mut rig = ContactRig::new(&garment);
    for step in 0..24u16 {
        rig.clear();
        for i in 0..4 {
            rig.set(0, 9, (step + i) % 12, 700);
        }
        let contact = rig.only();
        assert_eq!((contact.id, contact.total, contact.anisotropy.0), (1, 2800, 32768), "step {step}");
        assert_eq!(contact.dx.0, i32::from(step) << 16, "step {step}");
    }
}
