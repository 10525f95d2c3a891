//! Absent, dead and stuck taxels inside a contact, from codes to sums.

use crate::plain::Plain;
use taxel_core::condition::{ConditionConfig, ConditionState, Feedback, Filter, Sampled, UNITY};
use taxel_core::contact::{Contact, ContactConfig, ContactState, Moments};
use taxel_core::format::{Code, Micros};
use taxel_core::garment::{Absent, Garment, Layout};

const SIZE: u16 = 16;

/// What the one contact of a frame of codes is, where some taxels are absent or silenced.
fn contact(filter: Filter, absent: Option<Absent>, dead: &[usize], codes: &[u16]) -> (Contact, Moments) {
    let mut garment = Garment::recorded(SIZE, SIZE);
    garment.absent.extend(absent);
    let layout = Layout::build(&garment, 256, u16::MAX).unwrap();
    let mut state: ConditionState<256> = ConditionState::new();
    state.reset(&layout, Code(0));
    dead.iter().for_each(|taxel| assert!(state.set_gain(*taxel, 0)));
    let stage = ConditionConfig { filter, ..ConditionConfig::default() }.build().unwrap();
    let codes: Vec<Code> = codes.iter().copied().map(Code).collect();
    let sampled = Sampled { codes: &codes, falling: false, panels: 1, now: Micros(0) };
    let image = stage.process(&mut state, &layout, &sampled, &Feedback::<4>::new());
    let mut contacts: ContactState<4, 128> = ContactState::new();
    let stage = ContactConfig::default().build().unwrap();
    let touches = stage.process(&mut contacts, &layout, &image, Micros(0));
    assert_eq!(touches.present.len(), 1);
    (touches.present[0].clone(), *touches.moments().next().unwrap())
}

/// A slope of 7 x 7 taxels from (4, 4); no two taxels are alike.
fn slope() -> Vec<u16> {
    let inside = |v: u16| (4..11).contains(&v);
    let value = |i: u16| if inside(i % SIZE) && inside(i / SIZE) { 1000 + 10 * i } else { 0 };
    (0..SIZE * SIZE).map(value).collect()
}

fn taxels(values: &[u16]) -> Vec<(u32, u32, u16)> {
    let at = |(i, f): (usize, &u16)| (i as u32 % 16, i as u32 / 16, *f);
    values.iter().enumerate().map(at).filter(|taxel| taxel.2 > 0).collect()
}

/// Whether a contact is that of these values, to the last bit.
fn is_of((contact, moments): &(Contact, Moments), values: &[u16]) -> bool {
    let plain = Plain::of(&taxels(values));
    plain.agrees(moments)
        && (contact.area.into(), contact.peak) == (plain.area, plain.peak)
        && i128::from(contact.total) == plain.m
}

#[test]
fn absent_taxels_are_no_pressure_and_have_a_contour() {
    let absent = Absent { panel: 0, row: 6, column: 6, rows: 3, columns: 2 };
    let mut want = slope();
    (6..9).for_each(|row| want[row * 16 + 6..row * 16 + 8].fill(0));
    let found = contact(Filter::Off, Some(absent), &[], &slope());
    assert!(is_of(&found, &want));
    assert_eq!((found.0.area, found.0.perimeter), (43, 24 + 10), "the rim, and what is beside the gap");
    // As if the codes had not been there at all.
    assert_eq!(contact(Filter::Off, None, &[], &want), found);
}

#[test]
fn a_dead_taxel_is_a_gap_that_the_filter_bridges() {
    let dead = 7 * 16 + 7;
    let mut want = slope();
    want[dead] = 0;
    assert!(is_of(&contact(Filter::Off, None, &[dead], &slope()), &want));
    // Conservative: the least of its eight neighbours. What is less than all its own neighbours is raised,
    // what is more is lowered.
    let clamped = |values: &[u16]| -> Vec<u16> {
        let at = |x: i32, y: i32| (0..16).contains(&x).then(|| values[(y * 16 + x) as usize]);
        let around = |x: i32, y: i32| {
            let nine = (-1..=1).flat_map(move |dy| (-1..=1).map(move |dx| (dx, dy)));
            let other = nine.filter(|d| *d != (0, 0) && (0..16).contains(&(y + d.1)));
            other.filter_map(|(dx, dy)| at(x + dx, y + dy)).collect::<Vec<_>>()
        };
        let one = |i: i32| {
            let near = around(i % 16, i / 16);
            values[i as usize].clamp(*near.iter().min().unwrap(), *near.iter().max().unwrap())
        };
        (0..256).map(one).collect()
    };
    let bridged = clamped(&want);
    assert_eq!(bridged[dead], slope()[dead - 17], "the least beside it");
    assert!(is_of(&contact(Filter::Conservative, None, &[dead], &slope()), &bridged));
    // So is an absent one alone; a gap of two is not.
    let absent = |columns| Absent { panel: 0, row: 7, column: 7, rows: 1, columns };
    assert!(is_of(&contact(Filter::Conservative, Some(absent(1)), &[], &slope()), &bridged));
    want[dead + 1] = 0;
    assert!(is_of(&contact(Filter::Conservative, Some(absent(2)), &[], &slope()), &clamped(&want)));
    assert_eq!(clamped(&want)[dead..=dead + 1], [0, 0]);
}

#[test]
fn a_stuck_taxel_is_an_impulse_that_the_filter_lowers() {
    let mut codes = slope();
    codes[7 * 16 + 7] = u16::MAX;
    assert_eq!(contact(Filter::Off, None, &[], &codes).0.peak, u16::MAX);
    let (lowered, _) = contact(Filter::Conservative, None, &[], &codes);
    // Its neighbours see it as one of theirs: the greatest code of the slope stays, but for the corner itself.
    assert_eq!(lowered.peak, 1000 + 10 * (10 * 16 + 9));
    assert_eq!(lowered.area, 49);
    // Silenced, it is as any dead one.
    let dead = contact(Filter::Off, None, &[7 * 16 + 7], &codes);
    assert_eq!(dead.0.area, 48);
    assert_eq!(UNITY, 4096);
}
