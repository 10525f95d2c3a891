//! The garment folds at an elbow, and presses on itself: the board expects it, and feels what is more.

use super::{BoardAndHost, TAXELS};
use crate::random::Noise;
use taxel_core::board::TableKind;
use taxel_core::fold::{
    FoldCell, FoldRecord, FoldTable, FoldTableParts, JointAngle, NO_JOINT, NO_TAXEL, Posture,
    fold_table_length, write_fold_table,
};
use taxel_core::garment::{Garment, Layout};
use taxel_core::scene::Scene;
use taxel_core::wire::{FoldsReport, Report, Request, TABLE_PIECE};

/// Taxels that fold: the middle of two rows.
const FOLDED: [u16; 12] = [20, 21, 22, 23, 24, 25, 36, 37, 38, 39, 40, 41];
/// Counts of a unit of the table.
const UNIT: u16 = 4;
/// What each feels at 0, 30, 60 and 90 degrees, units: a ridge that appears and grows.
const FELT: [u8; 4] = [0, 40, 120, 200];

fn layout() -> Layout {
    Layout::build(&Garment::block(), TAXELS, 4095).unwrap()
}

/// What the elbow was learned to press.
fn elbow(spread: u8, days: u8) -> Vec<u8> {
    let fold = FoldRecord {
        joints: [0, NO_JOINT],
        knots: [4, 1],
        first: [0, 0],
        step: [3000, 0],
        play: [0, 0],
        taxels: FOLDED.len() as u16,
        zero: 0,
    };
    let cell = |mean: u8| FoldCell { mean, spread: spread.min(mean), days: days.min(mean) };
    let cells = vec![FELT.map(cell); FOLDED.len()].concat();
    let parts = FoldTableParts {
        joints: &["left_elbow"],
        folds: &[fold],
        taxels: &FOLDED,
        cells: &cells,
        unit: UNIT,
    };
    let mut bytes = vec![0; fold_table_length(&[fold])];
    write_fold_table(&parts, &layout(), &mut bytes).unwrap();
    bytes
}

/// What the fold presses at an angle, counts.
fn pressed(degrees: f64) -> f64 {
    let at = (degrees / 30.0).clamp(0.0, 3.0);
    let (low, share) = (at.floor() as usize, at.fract());
    let next = FELT[(low + 1).min(3)];
    f64::from(UNIT) * (f64::from(FELT[low]) * (1.0 - share) + f64::from(next) * share)
}

impl BoardAndHost {
    fn bend(&mut self, degrees: f64) {
        let joint = JointAngle { joint: 0, centidegrees: (degrees * 100.0) as i16 };
        let posture = Posture { joints: [joint].into_iter().collect() };
        assert_eq!(self.answer(&Request::Posture(posture)), None);
    }

    /// Scans with these pressures besides the fold's; returns contacts as (id, total), and what is reported of
    /// the folds.
    fn feel(&mut self, fold: f64, touch: &[(u16, f64)]) -> (Vec<(u32, u32)>, Option<FoldsReport>) {
        for taxel in 0..TAXELS as u16 {
            let more: f64 = touch.iter().filter(|(at, _)| *at == taxel).map(|(_, counts)| counts).sum();
            let fold = if FOLDED.contains(&taxel) { fold } else { 0.0 };
            self.press(&[usize::from(taxel)], (100.0 + fold + more) as u16);
        }
        self.scan();
        let (mut contacts, mut reported) = (None, None);
        self.drain(usize::MAX, |report| match report {
            Report::Contacts(list) => {
                contacts = Some(
                    list.contacts
                        .iter()
                        .map(|reported| (reported.contact.id, reported.contact.total))
                        .collect(),
                )
            }
            Report::Folds(report) => reported = Some(report.clone()),
            _ => {}
        });
        (contacts.unwrap_or_default(), reported)
    }

    /// Bends to and fro between 0 and 90 degrees for so many seconds, sent at 50 Hz; the fold presses
    /// `share` of what was learned. Returns the frames with contacts.
    fn sway(&mut self, seconds: f64, share: f64) -> usize {
        let mut touched = 0;
        for frame in 0..(seconds * 200.0) as usize {
            let degrees = 45.0 - 45.0 * (frame as f64 / 200.0 * 2.0).cos();
            if frame % 4 == 0 {
                self.bend(degrees);
            }
            touched += usize::from(!self.feel(share * pressed(degrees), &[]).0.is_empty());
        }
        touched
    }
}

/// A tared board with a table in force, unless it is empty.
fn with_folds(table: &[u8]) -> BoardAndHost {
    let mut bench = BoardAndHost::new(Scene::shipped());
    bench.press(&std::array::from_fn::<_, TAXELS, _>(|taxel| taxel), 100);
    bench.ask(&Request::Start);
    bench.ask(&Request::Tare { frames: 4 });
    (0..8).for_each(|_| drop(bench.feel(0.0, &[])));
    if !table.is_empty() {
        let want = vec![None; table.len().div_ceil(TABLE_PIECE)];
        assert_eq!(bench.send_table(TableKind::Folds, table), want);
    }
    bench
}

#[test]
fn a_fold_is_no_touch_once_it_is_known() {
    assert!(with_folds(&[]).sway(3.2, 1.0) > 300, "unknown, it is one");
    // 20 ms of posture and of turn are 1.8 degrees: at most 40 counts.
    assert_eq!(with_folds(&elbow(12, 0)).sway(20.0, 1.0), 0);
}

#[test]
fn a_touch_inside_a_fold_has_its_own_force() {
    let mut bench = with_folds(&elbow(5, 0));
    bench.bend(60.0);
    let touch = [(21, 500.0), (22, 500.0), (37, 500.0), (38, 500.0)];
    for _ in 0..40 {
        bench.bend(60.0);
        assert_eq!(bench.feel(480.0, &[]).0, []);
    }
    let felt: Vec<_> = (0..30).map(|_| bench.feel(480.0, &touch)).collect();
    let last = &felt.iter().rev().find(|(contacts, _)| !contacts.is_empty()).unwrap().0;
    let [(id, total)] = last[..] else { panic!("{last:?}") };
    assert!((1990..=2010).contains(&total), "{total}");
    // Its doubt is that of its four taxels.
    let reported = felt.iter().rev().find_map(|(_, reported)| reported.clone()).unwrap();
    assert_eq!((reported.taxels, reported.total, reported.doubt), (12, 12 * 480, 12 * 20));
    assert!(reported.followed);
    assert_eq!(reported.contacts.iter().map(|doubt| (doubt.id, doubt.doubt)).collect::<Vec<_>>(), [(id, 80)]);
}

#[test]
fn the_doubt_of_a_touch_is_that_of_the_taxels_under_it_that_fold() {
    // From the left beside the fold to within it, across it, from within it to the right, and beside it.
    for (columns, folding) in [(2..6, 2), (5..8, 3), (7..12, 3), (3..11, 6), (10..13, 0)] {
        let mut bench = with_folds(&elbow(5, 0));
        for _ in 0..40 {
            bench.bend(60.0);
            bench.feel(480.0, &[]);
        }
        let touch: Vec<_> =
            (0..3).flat_map(|row| columns.clone().map(move |column| (16 * row + column, 500.0))).collect();
        let felt: Vec<_> = (0..60).map(|_| bench.feel(480.0, &touch)).collect();
        let reported = felt.iter().rev().find_map(|(_, reported)| reported.clone()).unwrap();
        let doubts: Vec<_> = reported.contacts.iter().map(|doubt| doubt.doubt).collect();
        let want = 2 * folding * 20;
        assert_eq!(doubts, if want > 0 { vec![want] } else { vec![] }, "{columns:?}");
    }
}

#[test]
fn without_a_fresh_posture_only_what_no_fold_presses_is_a_touch() {
    let mut bench = with_folds(&elbow(5, 0));
    bench.bend(60.0);
    let (mut touched, mut last) = (0, None);
    for frame in 0..200 {
        // The arm goes on without a word.
        let (contacts, reported) = bench.feel(if frame < 60 { 480.0 } else { 800.0 }, &[]);
        touched += usize::from(!contacts.is_empty() && frame > 110);
        last = reported.or(last);
    }
    let last = last.unwrap();
    assert_eq!((touched, last.followed, last.total), (0, false, 0));
    assert_eq!(last.doubt, 12 * 205 * 4);
    let touch = [(21, 900.0), (22, 900.0), (37, 900.0), (38, 900.0)];
    let felt = (0..10).map(|_| bench.feel(800.0, &touch).0).collect::<Vec<_>>();
    assert!(felt.last().is_some_and(|contacts| contacts.len() == 1), "{felt:?}");
    // Elsewhere nothing is different.
    let beside = [(1, 300.0), (2, 300.0)];
    let felt = (0..10).map(|_| bench.feel(0.0, &beside).0).collect::<Vec<_>>();
    assert!(felt.last().is_some_and(|contacts| contacts.len() == 1), "{felt:?}");
}

#[test]
fn a_day_is_learned_while_nothing_touches() {
    // It sits otherwise today: 25 % more than was learned, within what days may differ by.
    let mut bench = with_folds(&elbow(12, 90));
    assert_eq!(bench.sway(30.0, 1.25), 0);
    bench.bend(90.0);
    let before = (0..60).filter_map(|_| bench.feel(1.25 * 800.0, &[]).1).last().unwrap();
    let off = f64::from(before.total) / (12.0 * 1.25 * 800.0) - 1.0;
    assert!(off.abs() < 0.04, "{before:?}");
    // The doubt of days has gone down to an eighth.
    assert!(before.doubt <= 12 * 4 * (12 + 90 / 8 + 1), "{before:?}");

    // A fingertip rests on the fold for a while: that is no fold.
    let mut bench = with_folds(&elbow(12, 0));
    let rest: Vec<_> = FOLDED.map(|taxel| (taxel, 300.0)).to_vec();
    for degrees in [0.0, 30.0, 60.0, 90.0, 60.0, 30.0, 60.0] {
        for _ in 0..40 {
            bench.bend(degrees);
            bench.feel(pressed(degrees), &rest);
        }
    }
    let (contacts, _) = bench.feel(480.0, &rest);
    let [(_, total)] = contacts[..] else { panic!("{contacts:?}") };
    assert!((12 * 280..=12 * 320).contains(&total), "{total}");
}

#[test]
fn a_gain_that_is_set_makes_no_touch_of_a_fold() {
    let mut bench = with_folds(&elbow(60, 0));
    // 480 counts are expected, 240 more or less.
    for _ in 0..40 {
        bench.bend(60.0);
        assert_eq!(bench.feel(680.0, &[]).0, []);
    }
    let gains = [4096; FOLDED.len()].into_iter().collect();
    bench.ask(&Request::SetGain { first: FOLDED[0], gains });
    assert_eq!(bench.feel(680.0, &[]).0, []);
}

#[test]
fn a_held_bend_is_no_drift() {
    let mut bench = with_folds(&elbow(12, 0));
    for _ in 0..12_000 {
        bench.bend(90.0);
        assert_eq!(bench.feel(830.0, &[]).0, []);
    }
    // Had the baseline followed, straight would now be far below it, and the next bend too weak.
    for _ in 0..40 {
        bench.bend(0.0);
        bench.feel(0.0, &[]);
    }
    let touch = [(21, 200.0), (22, 200.0), (37, 200.0), (38, 200.0)];
    let felt = (0..10).map(|_| bench.feel(0.0, &touch).0).collect::<Vec<_>>();
    let [(_, total)] = felt.last().unwrap()[..] else { panic!("{felt:?}") };
    assert!((790..=810).contains(&total), "{total}");
}

#[test]
fn a_tare_of_a_bent_arm_is_that_of_a_straight_one() {
    let mut bench = with_folds(&elbow(5, 0));
    for _ in 0..20 {
        bench.bend(60.0);
        bench.feel(480.0, &[]);
    }
    bench.ask(&Request::Tare { frames: 20 });
    for _ in 0..40 {
        bench.bend(60.0);
        bench.feel(480.0, &[]);
    }
    assert_eq!(bench.sway(10.0, 1.0), 0);
    let rest = bench.board.state().condition.baseline().unwrap();
    assert!(rest.iter().all(|rest| (95..=105).contains(rest)), "{rest:?}");
}

#[test]
fn a_tare_holds_no_baseline_for_what_was_expected_before() {
    let mut bench = with_folds(&elbow(0, 0));
    for _ in 0..40 {
        bench.bend(60.0);
        bench.feel(pressed(60.0), &[]);
    }
    bench.bend(0.0);
    bench.ask(&Request::Tare { frames: 4 });
    // Nothing is expected of a straight arm: the baselines follow drift, one by one.
    let taxel = FOLDED[0];
    for frame in 0..2_000 {
        bench.bend(0.0);
        bench.feel(0.0, &[(taxel, if frame < 20 { 0.0 } else { 3.0 })]);
    }
    assert_eq!(bench.board.state().condition.baseline().unwrap()[usize::from(taxel)], 103);
}

#[test]
fn a_table_that_is_wrong_is_refused_by_name() {
    let good = elbow(5, 5);
    let refusal = |change: &dyn Fn(&mut Vec<u8>)| {
        let mut table = good.clone();
        change(&mut table);
        let crc = taxel_core::format::crc32(&table[8..]);
        table[4..8].copy_from_slice(&crc.to_le_bytes());
        FoldTable::check(&table, &layout()).unwrap_err().to_string()
    };
    let first = 280;
    let taxels = first + 20;
    assert_eq!(refusal(&|table| table[8] = 1), "folds must be a table of folds, version 2");
    assert_eq!(refusal(&|table| table.truncate(400)), "folds must be a table of folds, version 2");
    assert_eq!(refusal(&|table| table[20] ^= 1), "folds must be made for this garment");
    assert_eq!(refusal(&|table| table[24] = 0), "folds must name its joints");
    assert_eq!(refusal(&|table| table[16] = 0), "folds must have a unit of 1 to 128 counts");
    assert_eq!(refusal(&|table| table[first] = 1), "folds must name one or two joints of the table");
    assert_eq!(refusal(&|table| table[first + 1] = 0), "folds must name one or two joints of the table");
    assert_eq!(refusal(&|table| table[first + 3] = 2), "folds must leave out what belongs to a second joint");
    assert_eq!(refusal(&|table| table[first + 2] = 0), "folds must have knots, and angles between them");
    assert_eq!(refusal(&|table| table[first + 13] = 100), "folds must have a play of at most 90 degrees");
    let order = "folds must list the taxels of each fold once, in ascending order";
    assert_eq!(refusal(&|table| table[taxels] = 21), order);
    assert_eq!(refusal(&|table| table[first + 16] = 13), order);
    assert_eq!(
        refusal(&|table| table[taxels + 22] = 64),
        "folds must list taxels of the garment, each in one fold"
    );
    assert_eq!(
        refusal(&|table| table[first + 2] = 3),
        "folds must have as many taxels and cells as its folds, and at most 256 knots"
    );
    let most = good.len() - 12;
    assert_eq!(refusal(&|table| table[most] += 1), "folds must state the most that each taxel may feel");
    let mut bench = with_folds(&[]);
    let undamaged = Some("folds must arrive undamaged".to_string());
    let damaged = [&good[..300], &[1], &good[301..]].concat();
    assert_eq!(bench.send_table(TableKind::Folds, &damaged).last(), Some(&undamaged));
    assert!(bench.send_table(TableKind::Folds, &good).iter().all(Option::is_none));
}

#[test]
fn a_table_holds_what_was_written() {
    let mut noise = Noise(7);
    let single = FoldRecord {
        joints: [1, NO_JOINT],
        knots: [5, 1],
        first: [-9000, 0],
        step: [4500, 0],
        play: [300, 0],
        taxels: 5,
        zero: 0,
    };
    let pair = FoldRecord {
        joints: [0, 1],
        knots: [3, 2],
        first: [0; 2],
        step: [10; 2],
        play: [0; 2],
        taxels: 3,
        ..single
    };
    let (taxels, folds) = ([3, 9, 10, 41, 63, 0, 4, 62], [single, pair]);
    let felt: Vec<FoldCell> = (0..5 * 5 + 3 * 6)
        .map(|_| {
            let [mean, spread, days] = [100, 50, 200].map(|most| noise.below(most) as u8);
            FoldCell { mean, spread, days }
        })
        .collect();
    let parts = FoldTableParts {
        joints: &["left_elbow", "left_shoulder"],
        folds: &folds,
        taxels: &taxels,
        cells: &felt,
        unit: UNIT,
    };
    let mut bytes = vec![0; fold_table_length(&folds)];
    write_fold_table(&parts, &layout(), &mut bytes).unwrap();
    let table = FoldTable::check(&bytes, &layout()).unwrap();
    assert_eq!(table.taxels(), [[3, 9, 10, 41], [63, NO_TAXEL, NO_TAXEL, NO_TAXEL], [0, 4, 62, NO_TAXEL]]);
    assert_eq!(table.folded().map(|(_, its)| its).collect::<Vec<_>>(), [&taxels[..5], &taxels[5..]]);
    let mut cells = felt.iter();
    for (at, taxel) in taxels.into_iter().enumerate() {
        let knots = if at < 5 { 5 } else { 6 };
        for knot in 0..knots {
            assert_eq!(table.cell(taxel, knot).as_ref(), cells.next(), "{taxel} {knot}");
        }
        assert_eq!(table.cell(taxel, knots), None);
    }
    assert_eq!((table.cell(5, 0), table.cell(NO_TAXEL, 0)), (None, None));
    // Of another number of taxels than the folds say.
    let fewer = FoldTableParts { taxels: &taxels[1..], ..parts };
    assert!(write_fold_table(&fewer, &layout(), &mut bytes).is_err());
    let at = 280 + 2 * 20 + 2 * 5;
    let crc = |bytes: &mut [u8]| taxel_core::format::crc32(&bytes[8..]).to_le_bytes();
    bytes[at..at + 2].copy_from_slice(&7u16.to_le_bytes());
    let sum = crc(&mut bytes);
    bytes[4..8].copy_from_slice(&sum);
    assert_eq!(
        FoldTable::check(&bytes, &layout()).unwrap_err().must,
        "must fill the list of a fold's taxels up to a multiple of four with 65535"
    );
}

#[test]
fn any_bytes_are_a_table_or_none_and_nothing_panics() {
    let mut noise = Noise(5);
    let (good, layout) = (elbow(20, 60), layout());
    let mut accepted = 0;
    for _ in 0..4_000 {
        let mut table = good.clone();
        for _ in 0..1 + noise.below(4) {
            // Mostly where the structure is.
            let end = if noise.below(3) > 0 { 324 } else { table.len() as u64 };
            table[noise.below(end) as usize] = noise.below(256) as u8;
        }
        if noise.below(8) == 0 {
            table.truncate(noise.below(good.len() as u64) as usize);
        }
        if let Some(rest) = table.get(8..) {
            let crc = taxel_core::format::crc32(rest);
            table[4..8].copy_from_slice(&crc.to_le_bytes());
        }
        if FoldTable::check(&table, &layout).is_err() {
            continue;
        }
        accepted += 1;
        if accepted % 20 > 0 {
            continue;
        }
        let mut bench = BoardAndHost::new(Scene::shipped());
        bench.board.recall_table(TableKind::Folds, Some(Box::leak(table.into_boxed_slice())));
        bench.ask(&Request::Start);
        bench.ask(&Request::Tare { frames: 4 });
        for _ in 0..60 {
            let angle = JointAngle { joint: 0, centidegrees: noise.range(-180e2, 180e2) as i16 };
            bench.ask(&Request::Posture(Posture { joints: [angle].into_iter().collect() }));
            bench.feel(noise.range(0.0, 3900.0), &[]);
        }
    }
    assert!(accepted > 200, "{accepted}");
}

#[test]
fn without_its_table_a_taxel_feels_as_before() {
    let mut bench = with_folds(&elbow(12, 0));
    bench.bend(90.0);
    (0..40).for_each(|_| drop(bench.feel(800.0, &[])));
    bench.board.recall_table(TableKind::Folds, None);
    let touch = [(21, 200.0), (22, 200.0), (37, 200.0), (38, 200.0)];
    let felt = (0..10).map(|_| bench.feel(0.0, &touch).0).collect::<Vec<_>>();
    let [(_, total)] = felt.last().unwrap()[..] else { panic!("{felt:?}") };
    assert!((790..=810).contains(&total), "{total}");
}
