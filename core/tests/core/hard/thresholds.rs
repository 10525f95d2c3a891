//! Values at each threshold, and one off.

use crate::hard::rig::ContactRig;
use taxel_core::condition::{ConditionConfig, ConditionState, Feedback, Filter, Sampled};
use taxel_core::contact::{Contact, ContactConfig, Moments, Quartic};
use taxel_core::format::{Code, Micros, Q15};
use taxel_core::garment::{Garment, Layout};
use taxel_core::shape::{Base, Class, FEATURES, Prototype, Shape, ShapeConfig, features, nmi};

fn rig(config: ContactConfig) -> ContactRig {
    ContactRig { stage: config.build().unwrap(), ..ContactRig::mat() }
}

#[test]
fn floor() {
    let layout = Layout::build(&Garment::recorded(1, 4), 4, u16::MAX).unwrap();
    for (floor, gain) in
        [(1, 4096), (24, 4096), (24, 8192), (24, 1000), (65_535, 4096), (24, 0), (24, u16::MAX)]
    {
        let config = ConditionConfig { floor, filter: Filter::Off, track_baseline: false };
        let stage = config.build().unwrap();
        let mut state: ConditionState<4> = ConditionState::new();
        state.reset(&layout, Code(100));
        (0..4).for_each(|taxel| assert!(state.set_gain(taxel, gain)));
        // The first difference whose rounded product reaches the floor.
        let value = |d: u16| ((u32::from(d) * u32::from(gain) + 2048) >> 12).min(65_535) as u16;
        let first = (0..=u16::MAX).find(|d| value(*d) >= floor);
        for d in [0, 1, 4, 5, first.map_or(9, |d| d - 1), first.unwrap_or(10), 65_435] {
            let Some(code) = d.checked_add(100) else { continue };
            let codes = [Code(code); 4];
            let sampled = Sampled { codes: &codes, falling: false, panels: 1, now: Micros(0) };
            let image = stage.process(&mut state, &layout, &sampled, &Feedback::<1>::new());
            let want = if first.is_some_and(|first| d >= first) { value(d) } else { 0 };
            assert_eq!(image.values, [want; 4], "floor {floor}, gain {gain}, difference {d}");
            assert_eq!(image.rows.is_empty(), want == 0);
        }
    }
}

/// The settings are those of a taxel of 120 mm2.
#[test]
fn low_and_high() {
    let mut garment = Garment::mat();
    garment.panels[0].pitch_um = [12_000, 10_000];
    for (low, high) in [(60, 120), (1, 1), (60, 60), (65_535, 65_535), (1, 65_535)] {
        let found = |peak: u16, beside: u16| -> Vec<u16> {
            let config = ContactConfig { low, high, ..ContactConfig::default() };
            let mut rig = ContactRig { stage: config.build().unwrap(), ..ContactRig::new(&garment) };
            let frame = rig.set(0, 9, 9, peak).set(0, 9, 10, beside).frame();
            frame.present.iter().map(|contact| contact.area).collect()
        };
        assert_eq!(found(high, low), [2], "{low} {high}");
        assert_eq!(found(high, low - 1), [1], "{low} {high}");
        assert!(found(high - 1, (low - 1).min(high - 1)).is_empty(), "{low} {high}");
    }
}

/// A contact goes on down to the low threshold, but only where it was: one taxel away it is another, and
/// begins nothing.
#[test]
fn a_faint_touch_goes_on_within_one_taxel() {
    for (shift, goes_on) in [(0, true), (1, true), (2, false)] {
        let mut rig = ContactRig::mat();
        rig.set(0, 9, 9, 120).only();
        let frame = rig.clear().set(0, 9, 9 + shift, 99).frame();
        assert_eq!(
            (frame.present.len(), frame.released.len()),
            (usize::from(goes_on), usize::from(!goes_on))
        );
    }
}

#[test]
fn smallest_area() {
    for (area, found) in [(4, 0), (5, 1), (6, 1)] {
        let mut rig = rig(ContactConfig { min_area: 5, ..ContactConfig::default() });
        rig.bar(0, 9, 3..3 + area, 500);
        assert_eq!(rig.frame().present.len(), found, "{area}");
    }
    let mut none = rig(ContactConfig { min_area: 0, ..ContactConfig::default() });
    assert!(none.frame().present.is_empty());
}

/// 4 taxels and half the box of one: 4.5 are within reach, a sixteenth more is not.
#[test]
fn gate() {
    for (weights, same) in [([100, 100], true), ([70, 90], false), ([90, 70], true)] {
        let mut rig = rig(ContactConfig { low: 1, high: 1, ..ContactConfig::default() });
        let first = rig.set(0, 9, 7, 160).only().id;
        let moved = rig.clear().set(0, 9, 11, weights[0]).set(0, 9, 12, weights[1]).only();
        assert_eq!(moved.id == first, same, "to {}", moved.x.to_f64());
    }
}

/// The shape of a contact by a base of one prototype that lies `apart` from it.
fn shape(
    contact: &Contact,
    moments: &Moments,
    quartic: &Quartic,
    apart: [i16; FEATURES],
    reject: u16,
) -> Shape {
    let mut features = features(&nmi(moments, contact.peak), quartic, contact);
    features.iter_mut().zip(apart).for_each(|(feature, apart)| *feature += apart);
    let prototypes = Box::leak(Box::new([Prototype { class: Class(1), features }]));
    let base = Base { names: &["it"], prototypes };
    ShapeConfig { k: 1, reject }.build(base).unwrap().process(moments, quartic, contact)
}

#[test]
fn reject() {
    let mut rig = ContactRig::mat();
    let frame = rig.fill([20, 24], [7, 13], 1000).frame();
    let at = |apart, reject| {
        let Shape { class, confidence, .. } =
            shape(&frame.present[0], &frame.moments[0], &frame.quartics[0], apart, reject);
        (class, confidence)
    };
    // 3-4-5 and its multiples: 50 away, exactly.
    assert_eq!(at([30, -40, 0, 0, 0, 0], 50), (Class(1), Q15::ONE));
    assert_eq!(at([30, -40, 0, 0, 0, 0], 51), (Class(1), Q15::ONE));
    assert_eq!(at([30, -40, 0, 0, 0, 0], 49), (Class::UNKNOWN, Q15::ratio(2500 - 2401, 2500)));
    assert_eq!(at([30, -40, 1, 0, 0, 0], 50), (Class::UNKNOWN, Q15::ratio(1, 2501)));
    assert_eq!(at([0; FEATURES], 1), (Class(1), Q15::ONE));
}
