//! Who stays who: through motion, across seams, merging and splitting.

use crate::tracking::rig::{FoundContacts, TrackingRig};
use taxel_core::contact::{Contact, ContactConfig};
use taxel_core::garment::{Garment, Place};

/// Rows and columns, last included, and the pressure there, on panel 0.
type PressedPatch = ([u16; 2], [u16; 2], u16);

fn show(rig: &mut TrackingRig, patches: &[PressedPatch]) -> FoundContacts {
    rig.values.fill(0);
    for ([top, bottom], [left, right], value) in patches {
        for (row, column) in (*top..=*bottom).flat_map(|row| (*left..=*right).map(move |c| (row, c))) {
            let taxel = rig.layout.taxel(Place { panel: 0, row, column }).expect("on the panel");
            rig.values[taxel] = *value;
        }
    }
    rig.frame()
}

fn ids(contacts: &[Contact]) -> Vec<u32> {
    contacts.iter().map(|c| c.id).collect()
}

/// A patch of 4 x 4 at the right, one of 3 x 3 whose left column is given.
fn large_and_small(left: u16) -> [PressedPatch; 2] {
    [([10, 13], [20, 23], 900), ([10, 12], [left, left + 2], 800)]
}

#[test]
fn of_two_that_merge_the_greater_goes_on() {
    for small_first in [true, false] {
        let mut rig = TrackingRig::mat();
        let [large, small] = large_and_small(2);
        show(&mut rig, &[if small_first { small } else { large }]);
        let (large_id, small_id) = if small_first { (2, 1) } else { (1, 2) };
        for left in 2..=16 {
            let frame = show(&mut rig, &large_and_small(left));
            assert_eq!(ids(&frame.present), [1, 2], "{left}");
        }
        let frame = show(&mut rig, &large_and_small(17));
        assert_eq!((ids(&frame.present), ids(&frame.released)), (vec![large_id], vec![small_id]));
        // Its centroid leaps, and that is no motion.
        let contact = &frame.present[0];
        assert!(contact.x.to_f64() < 21.0);
        assert_eq!((contact.dx.0, contact.vx.0, contact.slip), (0, 0, false));
    }
}

#[test]
fn of_two_equals_that_merge_one_goes_on() {
    let mut rig = TrackingRig::mat();
    for gap in (1..=6).rev() {
        let frame = show(&mut rig, &[([10, 12], [10 - gap, 12 - gap], 800), ([10, 12], [13, 15], 800)]);
        assert_eq!(ids(&frame.present), [1, 2]);
    }
    let frame = show(&mut rig, &[([10, 12], [10, 12], 800), ([10, 12], [13, 15], 800)]);
    assert_eq!((frame.present.len(), frame.released.len()), (1, 1));
}

#[test]
fn one_that_covers_another_goes_on_as_it() {
    // A palm lands on a resting finger, in one frame and with its middle far away: the touch there has not
    // ended.
    let mut rig = TrackingRig::mat();
    show(&mut rig, &[([10, 11], [2, 3], 900)]);
    let frame = show(&mut rig, &[([8, 40], [2, 20], 900)]);
    assert_eq!((ids(&frame.present), frame.released.len()), (vec![1], 0));
    assert_eq!((frame.present[0].dx.0, frame.present[0].dy.0), (0, 0));
}

#[test]
fn of_one_that_splits_the_greater_part_goes_on() {
    let mut rig = TrackingRig::mat();
    let whole = show(&mut rig, &[([10, 13], [8, 19], 900)]);
    assert_eq!(ids(&whole.present), [1]);
    // The sixth of it at the right comes away.
    let frame = show(&mut rig, &[([10, 13], [8, 15], 900), ([10, 13], [18, 19], 900)]);
    assert_eq!((ids(&frame.present), frame.released.len()), (vec![1, 2], 0));
    assert_eq!(frame.present[0].x.to_f64(), 11.5);
    assert_eq!((frame.present[0].dx.0, frame.present[0].vx.0), (0, 0), "no motion");
    // And both go their ways.
    for step in 1..10 {
        let frame = show(&mut rig, &[([10, 13], [8, 15], 900), ([10 + step, 13 + step], [18, 19], 900)]);
        assert_eq!(ids(&frame.present), [1, 2]);
        assert_eq!(frame.present[1].dy.to_f64(), f64::from(step));
    }
}

#[test]
fn a_gap_of_a_taxel_parts_nothing() {
    let mut rig = TrackingRig::mat();
    let halves = |gap: u16| [([10, 13], [8, 13], 900), ([10, 13], [14 + gap, 19 + gap], 800)];
    show(&mut rig, &halves(0));
    let whole = show(&mut rig, &halves(1)).present;
    assert_eq!(ids(&whole), [1]);
    // All of it is measured, its contour too.
    let contact = &whole[0];
    assert_eq!((contact.total, contact.area, contact.perimeter), (24 * 1_700, 48, 32));
    assert_eq!((contact.bounds.left, contact.bounds.right), (8, 20));
    assert_eq!((contact.y.to_f64(), contact.peak_at.column), (11.5, 8));
    // What began apart stays apart, and so does what has come apart.
    assert_eq!(ids(&show(&mut rig, &halves(2)).present), [1, 2]);
    assert_eq!(ids(&show(&mut rig, &halves(1)).present), [1, 2]);
    assert_eq!(ids(&show(&mut rig, &halves(0)).present), [1]);
    assert_eq!(ids(&show(&mut rig, &halves(1)).present), [1]);
}

#[test]
fn fingers_beside_each_other_that_do_not_touch_stay_two() {
    let mut rig = TrackingRig::mat();
    for frame in 0..20u16 {
        let pressed = 800 + 20 * (frame % 3);
        let frame = show(&mut rig, &[([10, 12], [8, 10], pressed), ([10, 12], [12, 14], 900)]);
        assert_eq!(ids(&frame.present), [1, 2]);
    }
}

#[test]
fn a_merge_and_a_split_leave_the_greater_its_id() {
    let mut rig = TrackingRig::mat();
    show(&mut rig, &large_and_small(10)[..1]);
    for left in (10..=17).chain((10..=16).rev()) {
        let frame = show(&mut rig, &large_and_small(left));
        assert_eq!(frame.present[0].id, 1);
        let back = frame.present.get(1).map(|contact| contact.id);
        assert!(back.is_none_or(|id| id == 2 || id == 3), "the smaller begins anew");
    }
}

#[test]
fn paths_that_cross_are_kept_apart() {
    // Past each other with one free row between them, two taxels a frame each.
    let mut rig = TrackingRig::mat();
    for step in 0..13u16 {
        let (a, b) = (2 * step, 26 - 2 * step);
        let frame = show(&mut rig, &[([10, 12], [a, a + 2], 900), ([14, 16], [b, b + 2], 900)]);
        assert_eq!(ids(&frame.present), [1, 2], "step {step}");
        assert_eq!(frame.present[0].y.to_f64(), 11.0, "the first is still the upper one");
        assert_eq!(frame.present[1].dx.to_f64(), -2.0 * f64::from(step));
    }
}

/// The second contact yields the component between them to the first, and takes the one above instead; what
/// the first has taken stays its own, although a third component would be near enough.
#[test]
fn a_contact_that_yields_takes_nothing_from_the_other() {
    let mut rig = TrackingRig::mat();
    let square = |top: u16, left: u16| ([top, top + 1], [left, left + 1], 900);
    show(&mut rig, &[square(10, 10), square(10, 15)]);
    let frame = show(&mut rig, &[square(6, 15), square(10, 12), square(14, 10)]);
    let places = frame.present.iter().map(|c| (c.id, c.x.to_f64(), c.y.to_f64()));
    assert_eq!(places.collect::<Vec<_>>(), [(1, 12.5, 10.5), (2, 15.5, 6.5), (3, 10.5, 14.5)]);
}

#[test]
fn a_contact_keeps_its_id_over_a_seam() {
    // From the chest over its right side to the back, one column a frame, and on.
    let mut rig = TrackingRig::new(&Garment::reference(), ContactConfig::default());
    for step in 0..28u16 {
        rig.values.fill(0);
        for (row, column) in (10..13).flat_map(|row| (step..step + 3).map(move |column| (row, column))) {
            let place = Place { panel: (column / 16) as u8, row, column: column % 16 };
            let taxel = rig.layout.taxel(place).expect("on the garment");
            rig.values[taxel] = 900;
        }
        let contact = rig.only();
        assert_eq!((contact.id, contact.dx.to_f64(), contact.dy.to_f64()), (1, f64::from(step), 0.0));
        assert_eq!(contact.panel, u8::from(step >= 15));
    }
}

#[test]
fn the_gate_is_the_farthest_leap() {
    // Four cm and half the size of one taxel.
    for (mm, leap, same) in
        [(10, 4, true), (10, 5, false), (5, 8, true), (5, 9, false), (20, 2, true), (20, 3, false)]
    {
        let mut garment = Garment::mat();
        garment.panels[0].pitch_um = [1_000 * mm; 2];
        let mut rig = TrackingRig::new(&garment, ContactConfig::default());
        show(&mut rig, &[([10, 10], [5, 5], 900)]);
        let frame = show(&mut rig, &[([10, 10], [5 + leap, 5 + leap], 900)]);
        let expected: (&[u32], &[u32]) = if same { (&[1], &[]) } else { (&[2], &[1]) };
        assert_eq!((&ids(&frame.present)[..], &ids(&frame.released)[..]), expected, "{leap} at {mm} mm");
    }
    // One that gets faster is looked for where it is going: six taxels a frame in the end.
    let mut rig = TrackingRig::mat();
    let mut row = 0;
    for step in [1, 2, 3, 4, 4, 4, 5, 5, 6, 6, 6] {
        row += step;
        let contact = show(&mut rig, &[([row, row], [5, 5], 900)]).present[0].clone();
        assert_eq!(contact.id, 1, "a step of {step}");
    }
}
