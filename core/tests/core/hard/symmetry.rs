//! What must not change when a touch moves, turns, is mirrored or pressed harder.

use crate::hard::rig::ContactRig;
use crate::plain::Plain;
use proptest::prelude::*;
use taxel_core::condition::{Image, Rows};
use taxel_core::contact::{Contact, ContactConfig, ContactState, Moments};
use taxel_core::format::{Micros, Turn};
use taxel_core::garment::{Garment, Layout};
use taxel_core::shape::nmi;

#[test]
fn translation_is_exact() {
    let shape = [[300u16, 900, 0], [4095, 4095, 700], [0, 61, 60]];
    let mut rig = ContactRig::mat();
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

/// Side of a square panel.
const SIDE: i32 = 24;

/// The contact of a block of values, after its panel was turned or mirrored: `map` of a taxel's x and y.
fn mapped(
    left: i32,
    top: i32,
    width: usize,
    values: &[u16],
    map: impl Fn(i32, i32) -> (i32, i32),
) -> (Contact, Moments) {
    let mut rig = ContactRig::new(&Garment::recorded(SIDE as u16, SIDE as u16));
    for (index, value) in values.iter().enumerate() {
        let (x, y) = map(left + (index % width) as i32, top + (index / width) as i32);
        rig.set(0, y as u16, x as u16, *value);
    }
    let frame = rig.frame();
    assert_eq!(frame.present.len(), 1);
    (frame.present[0].clone(), frame.moments[0])
}

/// Distance of two axes in turns: modulo half a turn.
fn apart(a: Turn, b: i32) -> f64 {
    let half = f64::from(a.0.wrapping_sub(b).wrapping_mul(2)) / 2f64.powi(33);
    half.abs()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1500))]

    #[test]
    fn quarter_turns_and_reflections_are_exact(
        left in 0..18i32,
        top in 0..18i32,
        width in 1..=6usize,
        values in prop::collection::vec(prop_oneof![60u16..4096, 60u16..], 1..=36),
    ) {
        let values = &values[..values.len().min(6 * width)];
        prop_assume!(values.iter().any(|value| *value >= 120));
        let last = SIDE - 1;
        let (base, sums) = mapped(left, top, width, values, |x, y| (x, y));
        let (x, y) = (base.x.0, base.y.0);
        let end = last << 16;
        type Mirror = fn(i32, i32) -> (i32, i32);
        let moves: [(Mirror, (i32, i32), bool, i32); 5] = [
            (|x, y| (SIDE - 1 - y, x), (end - y, x), false, 1 << 30),
            (|x, y| (SIDE - 1 - x, SIDE - 1 - y), (end - x, end - y), false, 0),
            (|x, y| (y, SIDE - 1 - x), (y, end - x), false, 1 << 30),
            (|x, y| (SIDE - 1 - x, y), (end - x, y), true, 0),
            (|x, y| (y, x), (y, x), true, 1 << 30),
        ];
        for (map, place, mirrored, turn) in moves {
            let (moved, there) = mapped(left, top, width, values, map);
            // Exact: the mass and all that is of second order.
            prop_assert_eq!((there.m, there.s2, there.jm()), (sums.m, sums.s2, sums.jm()));
            prop_assert_eq!((moved.area, moved.perimeter, moved.peak), (base.area, base.perimeter, base.peak));
            prop_assert_eq!(nmi(&there, moved.peak), nmi(&sums, base.peak));
            // A centroid halfway between two steps is rounded upwards, wherever that is.
            let off = (moved.x.0 - place.0).abs().max((moved.y.0 - place.1).abs());
            prop_assert!(off <= 1, "{}", off);
            // Where more than 31 bits are cut, they are cut towards the same side.
            prop_assert!((moved.anisotropy.0 - base.anisotropy.0).abs() <= 1);
            prop_assert!(moved.breadth.abs_diff(base.breadth) <= 1);
            if let (Some(azimuth), Some(before)) = (moved.azimuth, base.azimuth) {
                let before = if mirrored { before.0.wrapping_neg() } else { before.0 };
                // Twice 1.3e-6 rad.
                let off = apart(azimuth, before.wrapping_add(turn)) * std::f64::consts::TAU;
                prop_assert!(off <= 2.6e-6, "{}", off);
            }
        }
    }

    #[test]
    fn contacts_and_background_are_the_whole(
        share in 1..100u32,
        full in prop_oneof![Just(300u32), Just(4096), Just(65536)],
        seed: u64,
    ) {
        let layout = Layout::build(&Garment::recorded(SIDE as u16, SIDE as u16), 576, u16::MAX).unwrap();
        let mut state = seed;
        let mut next = |below: u32| {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 33) as u32 % below
        };
        let values: Vec<u16> =
            (0..576).map(|_| if next(100) < share { next(full) as u16 } else { next(60) as u16 }).collect();
        let config = ContactConfig { high: 60, ..ContactConfig::default() };
        let mut state: Box<ContactState<150, 400>> = Box::default();
        let image = Image { values: &values, rows: &Rows::of(&layout, &values) };
        let stage = config.build().unwrap();
        let touches = stage.process(&mut state, &layout, &image, Micros(0));
        prop_assert_eq!((touches.dropped, touches.overflow), (0, 0));
        let mut whole = Moments::default();
        touches.moments().for_each(|moments| whole.add(moments));
        let rest: Vec<u16> = values.iter().map(|f| if *f < 60 { *f } else { 0 }).collect();
        whole.add(&Moments::of_image(&rest, SIDE as usize));
        let taxels: Vec<(i32, i32, u16)> =
            (0..SIDE * SIDE).map(|i| (i % SIDE, i / SIDE, values[i as usize])).collect();
        let plain = Plain::of(&taxels);
        prop_assert!(plain.agrees(&whole));
        let area: u32 = touches.present.iter().map(|contact| u32::from(contact.area)).sum();
        let faint = rest.iter().filter(|f| **f > 0).count() as u32;
        prop_assert_eq!(area + faint, plain.area);
        prop_assert_eq!(values.iter().max(), Some(&plain.peak));
    }
}
