//! Thin fingers on one coarse block of 4 x 16: which filter keeps them, from the code of a taxel to the
//! contact.

use crate::tracking::rig::FRAME_US;
use taxel_core::condition::{ConditionConfig, ConditionState, Feedback, Filter, Sampled};
use taxel_core::contact::{Contact, ContactConfig, ContactState};
use taxel_core::format::{Code, Micros};
use taxel_core::garment::{Garment, Layout};

/// A finger of `rows` x `columns` taxels slides along the block from its second column to the last but one, a
/// column in four frames: what is reported of it in each frame.
fn slide(filter: Filter, rows: usize, columns: usize) -> Vec<Option<Contact>> {
    let layout = Layout::build(&Garment::block(), 64, 4095).unwrap();
    let config = ConditionConfig { filter, track_baseline: false, ..ConditionConfig::default() };
    let (condition, contacts) = (config.build().unwrap(), ContactConfig::default().build().unwrap());
    let mut image = ConditionState::<64>::new();
    image.reset(&layout, Code(0));
    let mut state = ContactState::<4, 32>::new();
    let reported = |frame: usize| {
        let mut codes = [Code(0); 64];
        for (row, column) in (1..=rows).flat_map(|row| (0..columns).map(move |column| (row, column))) {
            codes[row * 16 + 1 + frame / 4 + column] = Code(900);
        }
        let sampled = Sampled { codes: &codes, falling: false, panels: 1, now: Micros(0) };
        let image = condition.process(&mut image, &layout, &sampled, state.feedback());
        let touches = contacts.process(&mut state, &layout, &image, Micros(frame as u64 * FRAME_US));
        assert!(touches.present.len() < 2);
        touches.present.first().cloned()
    };
    (0..4 * (15 - columns)).map(reported).collect()
}

/// It is one contact from the first frame to the last, and has gone all the way.
fn survives(filter: Filter, rows: usize, columns: usize) -> bool {
    let reported = slide(filter, rows, columns);
    let way = (14 - columns) as f64;
    reported.iter().all(|contact| contact.as_ref().is_some_and(|contact| contact.id == 1))
        && reported.last().unwrap().as_ref().is_some_and(|contact| contact.dx.to_f64() == way)
}

fn is_gone(filter: Filter, rows: usize, columns: usize) -> bool {
    slide(filter, rows, columns).iter().all(Option::is_none)
}

#[test]
fn fingers_one_taxel_wide_survive_conservative_and_off_and_die_under_the_median() {
    for (rows, columns) in [(1, 2), (1, 3), (1, 6), (2, 1), (3, 1)] {
        for filter in [Filter::Conservative, Filter::Persistent, Filter::Off] {
            assert!(survives(filter, rows, columns), "{filter:?} {rows} x {columns}");
        }
        assert!(is_gone(Filter::Median, rows, columns), "{rows} x {columns}");
    }
}

#[test]
fn fingers_two_taxels_wide_survive_conservative_and_off_and_die_under_the_median() {
    assert!(is_gone(Filter::Median, 2, 2));
    for filter in [Filter::Conservative, Filter::Persistent, Filter::Off, Filter::Square] {
        assert!(survives(filter, 2, 2), "{filter:?}");
    }
    for filter in [Filter::Conservative, Filter::Off] {
        assert!(survives(filter, 2, 4), "{filter:?}");
    }
    // Of a longer one the median leaves the inner taxels: two of four columns.
    let whole = slide(Filter::Conservative, 2, 4).remove(20).unwrap();
    let rest = slide(Filter::Median, 2, 4).remove(20).unwrap();
    assert_eq!((whole.area, rest.area), (8, 4));
}

/// Counts of a taxel with a course of codes, after the filter; nothing else is pressed.
fn course(garment: &Garment, taxel: usize, codes: &[u16]) -> Vec<u16> {
    let layout = Layout::build(garment, 64, 4095).unwrap();
    let config = ConditionConfig { filter: Filter::Persistent, ..ConditionConfig::default() };
    let condition = config.build().unwrap();
    let mut image = ConditionState::<64>::new();
    image.reset(&layout, Code(0));
    let none = Feedback::<1>::new();
    let mut frame = |code: &u16| {
        let mut codes = [Code(0); 64];
        codes[taxel] = Code(*code);
        let sampled = Sampled { codes: &codes, falling: false, panels: 1, now: Micros(0) };
        condition.process(&mut image, &layout, &sampled, &none).values[taxel]
    };
    codes.iter().map(&mut frame).collect()
}

#[test]
fn a_point_that_stays_passes_from_its_second_frame_on_and_an_impulse_never() {
    // Of sixteen columns and of others, in the middle, at the border and in a corner.
    for garment in [Garment::block(), Garment::recorded(5, 7), Garment::recorded(1, 20)] {
        for taxel in [0, 3, 6, 17] {
            let passed = course(&garment, taxel, &[0, 900, 900, 4000, 0, 0, 700, 0, 300, 500, 400, 0]);
            assert_eq!(passed, [0, 0, 900, 900, 0, 0, 0, 0, 0, 300, 400, 0], "{} {taxel}", garment.name);
        }
    }
}

/// What hardly stands out may be noise: it is smoothed, as by the conservative filter.
#[test]
fn a_point_stands_out_by_more_than_the_margin() {
    assert_eq!(course(&Garment::block(), 20, &[64, 64, 65, 65]), [0, 0, 0, 65]);
}

#[test]
fn a_finger_of_a_single_taxel_is_an_impulse_to_the_filters_without_memory() {
    assert!(survives(Filter::Off, 1, 1));
    assert!(is_gone(Filter::Conservative, 1, 1) && is_gone(Filter::Median, 1, 1));
}
