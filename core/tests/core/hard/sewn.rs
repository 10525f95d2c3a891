//! Contacts over a seam of any two sides, in either direction: as if the cloth lay flat.

use crate::hard::rig::ContactRig;
use crate::plain::Plain;
use proptest::prelude::*;
use taxel_core::format::name;
use taxel_core::garment::{Garment, Seam, SeamEdge, Side};

/// Both panels are squares of this side, sewn along the whole of it.
const N: i64 = 9;
const SIDES: [Side; 4] = [Side::Left, Side::Right, Side::Top, Side::Bottom];

/// The place `along` a side and `deep` behind it, x and y; a negative depth lies beyond.
fn behind(side: Side, along: i64, deep: i64) -> (i64, i64) {
    match side {
        Side::Left => (deep, along),
        Side::Right => (N - 1 - deep, along),
        Side::Top => (along, deep),
        Side::Bottom => (along, N - 1 - deep),
    }
}

fn sewn(a: Side, b: Side, reversed: bool) -> Garment {
    sewn_in_part([a, b], [0, 0], N as u16, reversed)
}

/// A garment sewn from these taxels of the two sides on.
fn sewn_in_part([a, b]: [Side; 2], starts: [u16; 2], length: u16, reversed: bool) -> Garment {
    let mut garment = Garment::recorded(N as u16, N as u16);
    let other = taxel_core::garment::Panel { name: name("other"), ..garment.panels[0].clone() };
    garment.panels.push(other).unwrap();
    let edge = |panel, side, start| SeamEdge { panel, side, start };
    let seam = Seam { a: edge(0, a, starts[0]), b: edge(1, b, starts[1]), length, reversed };
    garment.seams.push(seam).unwrap();
    garment
}

/// How many parts hang together, of which `beside` says which two are neighbours.
fn parts<T: Copy>(taxels: &[T], beside: impl Fn(T, T) -> bool) -> usize {
    let mut left: Vec<T> = taxels.to_vec();
    let mut count = 0;
    while let Some(first) = left.pop() {
        count += 1;
        let mut edge = vec![first];
        while let Some(taxel) = edge.pop() {
            let (near, far) = left.into_iter().partition(|other| beside(taxel, *other));
            left = far;
            edge.extend::<Vec<T>>(near);
        }
    }
    count
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn a_contact_over_any_seam_is_that_of_the_flat_cloth(
        sides in (0usize..4, 0usize..4),
        reversed: bool,
        start in 0..N,
        here in prop::collection::vec(60u16.., 9),
        there in prop::collection::vec(60u16.., 9),
    ) {
        let (a, b) = (SIDES[sides.0], SIDES[sides.1]);
        let mut rig = ContactRig::new(&sewn(a, b, reversed));
        let (mut flat_a, mut flat_b) = (Vec::new(), Vec::new());
        // A strip of up to three taxels along the seam and three deep on both sides of it.
        for (index, (near, far)) in here.iter().zip(&there).enumerate() {
            let (along, deep) = (start + index as i64 % 3, index as i64 / 3);
            if along >= N {
                continue;
            }
            let beside = if reversed { N - 1 - along } else { along };
            let ((x, y), (u, v)) = (behind(a, along, deep), behind(b, beside, deep));
            rig.set(0, y as u16, x as u16, *near).set(1, v as u16, u as u16, *far);
            // The same in the frame of the one panel and in that of the other.
            let (beyond_a, beyond_b) = (behind(a, along, -1 - deep), behind(b, beside, -1 - deep));
            flat_a.extend([(x, y, *near), (beyond_a.0, beyond_a.1, *far)]);
            flat_b.extend([(u, v, *far), (beyond_b.0, beyond_b.1, *near)]);
        }
        prop_assume!(rig.values.iter().any(|value| *value >= 120));
        let frame = rig.frame();
        prop_assert_eq!(frame.present.len(), 1);
        let home = if frame.present[0].panel == 0 { Plain::of(&flat_a) } else { Plain::of(&flat_b) };
        prop_assert!(home.agrees(&frame.moments[0]));
        prop_assert_eq!((u32::from(frame.present[0].area), frame.present[0].peak), (home.area, home.peak));
        // Home is where most of it is, and the first panel in a tie.
        let mass = |panel: usize| rig.values[panel * 81..][..81].iter().map(|f| u32::from(*f)).sum::<u32>();
        prop_assert_eq!(frame.present[0].panel, u8::from(mass(1) > mass(0)));
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    /// Taxels here and there along both sides of a seam, which may be as long as the sides or shorter.
    #[test]
    fn what_lies_apart_at_a_seam_stays_apart(
        sides in (0usize..4, 0usize..4),
        reversed: bool,
        [here, there] in prop::array::uniform2(prop::collection::vec(prop::bool::weighted(0.4), N as usize)),
        [start_a, start_b, length] in prop::array::uniform3(0..N),
    ) {
        let (a, b) = (SIDES[sides.0], SIDES[sides.1]);
        let length = (1 + length).min(N - start_a).min(N - start_b);
        let starts = [start_a, start_b].map(|start| start as u16);
        let mut rig = ContactRig::new(&sewn_in_part([a, b], starts, length as u16, reversed));
        let mut taxels = Vec::new();
        for (panel, side, row) in [(0u8, a, &here), (1, b, &there)] {
            for (along, _) in (0..N).zip(row).filter(|(_, pressed)| **pressed) {
                let (x, y) = behind(side, along, 0);
                rig.set(panel, y as u16, x as u16, 1000);
                taxels.push((panel, along));
            }
        }
        // Where a taxel lies along the seam, counted as on the first side.
        let at = |(panel, along): (u8, i64)| {
            let from_start = along - if panel == 0 { start_a } else { start_b };
            let turned = if panel == 1 && reversed { length - 1 - from_start } else { from_start };
            (0..length).contains(&turned).then_some(turned)
        };
        let beside = |one: (u8, i64), other: (u8, i64)| match (at(one), at(other)) {
            _ if one.0 == other.0 => (one.1 - other.1).abs() == 1,
            (Some(one), Some(other)) => (one - other).abs() <= 1,
            _ => false,
        };
        prop_assert_eq!(rig.frame().present.len(), parts(&taxels, beside));
    }
}

/// A touch at every place of a panel, its borders and corners included, is reported where it is.
#[test]
fn every_taxel_is_reported_where_it_is() {
    let mut rig = ContactRig::mat();
    for (row, column) in (0..64).flat_map(|row| (0..32).map(move |column| (row, column))) {
        rig.state.reset();
        let contact = rig.clear().set(0, row, column, 4095).only();
        assert_eq!((contact.x.0, contact.y.0), (i32::from(column) << 16, i32::from(row) << 16));
        assert_eq!((contact.peak_at.row, contact.peak_at.column), (row, column));
        let bounds = [contact.bounds.top, contact.bounds.bottom, contact.bounds.left, contact.bounds.right];
        assert_eq!((bounds, contact.perimeter, contact.azimuth), ([row, row, column, column], 1, None));
    }
}

/// A square of 3 x 3 pushed over every border, a taxel at a time, until only its corner is left.
#[test]
fn a_touch_is_cut_by_every_border() {
    let mut rig = ContactRig::mat();
    for (top, left) in (-2i32..64).flat_map(|top| (-2i32..32).map(move |left| (top, left))) {
        let on_border = !(0..=61).contains(&top) || !(0..=29).contains(&left);
        if !on_border {
            continue;
        }
        rig.state.reset();
        let inside = |x: i32, y: i32| (left..left + 3).contains(&x) && (top..top + 3).contains(&y);
        rig.clear().draw(inside, 500);
        let (width, height) = ((left + 3).min(32) - left.max(0), (top + 3).min(64) - top.max(0));
        let frame = rig.frame();
        let contact = &frame.present[0];
        assert_eq!((i32::from(contact.area), contact.total as i32), (width * height, 500 * width * height));
        // The mean of the first and the last column, and of the rows.
        let middle = |low: i32, size: i32| (2 * low.max(0) + size - 1) << 15;
        assert_eq!((contact.x.0, contact.y.0), (middle(left, width), middle(top, height)));
        let rim = if width.min(height) < 3 { width * height } else { 8 };
        assert_eq!(i32::from(contact.perimeter), rim, "{top} {left}");
    }
}
