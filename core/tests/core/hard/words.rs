//! Limits between words, and levels of reactions: at each, and one off.

use crate::hard::rig::ContactRig;
use taxel_core::body::Placed;
use taxel_core::format::{Micros, name};
use taxel_core::garment::{Garment, Layout};
use taxel_core::react::{Cause, ReactState, ReactionConfig, Reactions};
use taxel_core::shape::Shape;
use taxel_core::symbol::{Extent, RegionState, Span, Strength, SymbolConfig, SymbolState, Words};

/// The first words that are said of a contact.
fn said(peak_total: u32, area: u16, duration_ms: u32) -> (Strength, Extent, Span) {
    let mut rig = ContactRig::mat();
    let contact = rig.set(0, 3, 3, 500).only();
    let contact = taxel_core::contact::Contact { peak_total, area, duration_ms, ..contact };
    let placed = [Placed::new(&rig.layout, contact, Shape::default())];
    let mut state: SymbolState<4> = SymbolState::default();
    SymbolConfig::default().build().unwrap().process(&mut state, &rig.layout, &placed, &[], Micros(0));
    let Words { strength, extent, span, .. } = state.events(&placed, &[]).next().unwrap().words;
    (strength, extent, span)
}

/// How large a contact of one taxel is said to be, while it has these pressures in turn.
fn sharp(peaks: &[u16]) -> Vec<Extent> {
    let mut rig = ContactRig::mat();
    let mut state: SymbolState<4> = SymbolState::default();
    let stage = SymbolConfig::default().build().unwrap();
    let mut said = Vec::new();
    for (peak, ms) in peaks.iter().zip(0..) {
        let contact = rig.set(0, 3, 3, *peak).only();
        let placed = [Placed::new(&rig.layout, contact, Shape::default())];
        stage.process(&mut state, &rig.layout, &placed, &[], Micros(1_000 * ms));
        said.extend(state.events(&placed, &[]).map(|event| event.words.extent));
    }
    said.dedup();
    said
}

#[test]
fn words() {
    let faint = (Strength::Faint, Extent::Point, Span::Brief);
    assert_eq!(said(999, 8, 149), faint);
    for (limit, strength) in [(1000, Strength::Light), (5000, Strength::Firm), (20_000, Strength::Hard)] {
        assert_eq!(said(limit, 0, 0).0, strength);
        assert!(said(limit - 1, 0, 0).0 < strength);
    }
    for (limit, extent) in [(9, Extent::Patch), (40, Extent::Wide)] {
        assert_eq!((said(0, limit, 0).1, said(0, limit - 1, 0).1 == extent), (extent, false));
    }
    assert_eq!(sharp(&[2_999, 3_000, 500]), [Extent::Point, Extent::Sharp]);
    for (limit, span) in [(150, Span::Short), (800, Span::Long)] {
        assert_eq!((said(0, 0, limit).2, said(0, 0, limit - 1).2 < span), (span, true));
    }
    assert_eq!(said(u32::MAX, u16::MAX, u32::MAX), (Strength::Hard, Extent::Wide, Span::Long));
}

#[test]
fn reactions() {
    let layout = Layout::build(&Garment::mat(), 2048, u16::MAX).unwrap();
    let row = ReactionConfig {
        name: name("ouch"),
        cause: Cause::Force,
        region: name(""),
        level: 3000,
        hysteresis: 100,
        hold_ms: 20,
        output: None,
    };
    let reactions = Reactions::build(&[row], &layout, None).unwrap();
    let mut state = ReactState::default();
    let mut at = |total: u32, ms: u64| {
        let regions = [RegionState { total, ..RegionState::default() }];
        reactions.process(&mut state, &regions, None, Micros(1000 * ms));
        state.changes().first().map(|change| (change.active, change.value))
    };
    assert_eq!([at(2999, 0), at(3000, 1), at(2900, 30)], [None, Some((true, 3000)), None]);
    // Below the hysteresis it ends, once 20 ms have gone by since it last was not.
    assert_eq!([at(2899, 49), at(2899, 50)], [None, Some((false, 2899))]);
    // What does not fit in 31 bits is as much as there is.
    assert_eq!([at(2999, 60), at(u32::MAX, 61)], [None, Some((true, i32::MAX))]);
}
