//! Taxels that fold are renewed only where something has changed: nothing differs from renewing all of them.

extern crate std;
use super::{ConditionConfig, ConditionState, Feedback, Pressed, Sampled};
use crate::fold::{
    FoldCell, FoldRecord, FoldTable, FoldTableParts, JointAngle, NO_JOINT, Posture, fold_table_length,
    write_fold_table,
};
use crate::format::{Code, Micros, name};
use crate::garment::{Garment, Layout, Rect};
use std::boxed::Box;
use std::vec;
use std::vec::Vec;

type FullState = ConditionState<2048>;

/// Numbers without a pattern.
struct Drawn(u32);

impl Drawn {
    fn below(&mut self, end: u32) -> u32 {
        self.0 = self.0.wrapping_mul(1664525).wrapping_add(1013904223);
        (self.0 >> 10) % end
    }
}

/// A fold of joint 0, whose knots begin at 0 and are 9 degrees apart, without play.
pub(super) fn single(knots: u8, taxels: u16) -> FoldRecord {
    FoldRecord {
        joints: [0, NO_JOINT],
        knots: [knots, 1],
        first: [0; 2],
        step: [900, 0],
        play: [0; 2],
        taxels,
        zero: 0,
    }
}

/// A table in memory that is never given back.
pub(super) fn stored(parts: &FoldTableParts<'_>, layout: &Layout) -> FoldTable<'static> {
    let length = fold_table_length(parts.folds);
    // Words: a table is aligned like them.
    let words: &'static mut [u32] = vec![0; length.div_ceil(4)].leak();
    let bytes: &'static mut [u8] = &mut bytemuck::cast_slice_mut(words)[..length];
    write_fold_table(parts, layout, bytes).unwrap();
    FoldTable::check(bytes, layout).unwrap()
}

/// A fold of one joint and one of two, on rows and parts of rows.
fn table(layout: &Layout, drawn: &mut Drawn) -> FoldTable<'static> {
    let single = FoldRecord { play: [100, 0], ..single(6, 70) };
    let pair = FoldRecord {
        joints: [1, 2],
        knots: [3, 4],
        first: [-1000, 0],
        step: [1000, 700],
        play: [0, 50],
        taxels: 37,
        zero: 0,
    };
    let taxels: Vec<u16> = (64..134).chain((512..586).step_by(2)).collect();
    let cells: Vec<FoldCell> = (0..70 * 6 + 37 * 12)
        .map(|_| {
            let mut byte =
                || [0, 0, 9, 60, 255].map(|end| drawn.below(end + 1) as u8)[drawn.below(5) as usize];
            FoldCell { mean: byte(), spread: byte(), days: byte() }
        })
        .collect();
    let folds = [single, pair];
    let joints = ["elbow", "roll", "pitch"];
    let parts = FoldTableParts { joints: &joints, folds: &folds, taxels: &taxels, cells: &cells, unit: 4 };
    stored(&parts, layout)
}

/// Turns each joint by at most so much, hundredths of a degree.
fn turned(angles: &mut [i32; 3], turn: u32, drawn: &mut Drawn) -> Posture {
    for angle in angles.iter_mut() {
        *angle = (*angle + drawn.below(2 * turn + 1) as i32 - turn as i32).clamp(-1500, 6000);
    }
    let joints = (0..).zip(angles);
    Posture {
        joints: joints.map(|(joint, angle)| JointAngle { joint, centidegrees: *angle as i16 }).collect(),
    }
}

/// Something touches the garment, or nothing does.
fn touch(feedback: &mut Feedback<4>, drawn: &mut Drawn) {
    feedback.home.clear();
    if drawn.below(2) == 0 {
        let (top, left) = (drawn.below(12) as u16, drawn.below(12) as u16);
        let rect = Rect { panel: drawn.below(2) as u8, top, bottom: top + 3, left, right: left + 3 };
        feedback.home.push(Pressed { rect, peak: 300, slow: false }).unwrap();
    }
}

#[test]
fn what_has_not_changed_need_not_be_renewed() {
    let layout = Layout::build(&Garment::reference(), 2048, u16::MAX).unwrap();
    let mut drawn = Drawn(1);
    let table = table(&layout, &mut drawn);
    let joints = ["elbow", "roll", "pitch"].map(name);
    for falling in [false, true] {
        let mut pair: [Box<FullState>; 2] = [(); 2].map(|()| Box::new(FullState::new()));
        let rest = if falling { 700 } else { 64_500 };
        for state in &mut pair {
            state.reset(&layout, Code(rest));
            state.use_folds(Some(table), &joints);
            (0..2048).for_each(|taxel| assert!(state.set_baseline(taxel, Code(rest))));
        }
        let mut feedback = Feedback::<4>::new();
        let (mut now, mut angles, mut drift) = (Micros(0), [0i32; 3], 0i32);
        let mut floor = 24;
        for frame in 0..6_000 {
            now = Micros(now.0 + if drawn.below(400) == 0 { 600_000 } else { 5_128 });
            // It moves, it stands still and is sent, it is not sent.
            let sent = match drawn.below(600) {
                0 => None,
                n => Some(if frame % 900 < 500 && n % 4 != 0 { 300 } else { 0 }),
            };
            if frame % 4 == 0
                && let Some(turn) = sent
            {
                let posture = turned(&mut angles, turn, &mut drawn);
                for state in &mut pair {
                    state.posture_mut().accept(&posture, &joints, now).unwrap();
                }
            }
            if drawn.below(40) == 0 {
                touch(&mut feedback, &mut drawn);
            }
            match drawn.below(900) {
                0 => pair.iter_mut().for_each(|state| state.tare(3)),
                1 => pair.iter_mut().for_each(|state| assert!(state.set_gain(70, 4000))),
                2 => pair.iter_mut().for_each(|state| assert!(state.set_gain(70, 4096))),
                3 => floor = 20 + drawn.below(10) as u16,
                _ => {}
            }
            drift = (drift + drawn.below(3) as i32 - 1).clamp(-900, 900);
            let codes: Vec<Code> = (0..2048)
                .map(|_| Code((i32::from(rest) + drift + drawn.below(30) as i32).clamp(0, 0xFFFF) as u16))
                .collect();
            let condition = ConditionConfig { floor, ..ConditionConfig::default() }.build().unwrap();
            let sampled = Sampled { codes: &codes, falling, panels: 0xFF, now };
            let [some, all] = &mut pair;
            all.folds.renew_all();
            let images = [some, all].map(|state| {
                condition.process(state, &layout, &sampled, &feedback);
                let of = |taxel| (state.folds.of(taxel), state.folds.level(taxel.into()));
                let folds: Vec<_> = (0..1024).map(of).collect();
                (state.images.calibrated.to_vec(), folds, state.calibration.baseline.to_vec())
            });
            let [some, all] = images;
            assert!(some == all, "frame {frame}");
            // Where a limit is at its end, drift may find its way back sooner than the fold's turn does.
            let [some, all] = &pair;
            let silent = if falling { 0 } else { u16::MAX };
            for taxel in 0..2048 {
                let [a, b] = [some, all].map(|state| state.calibration.limit[taxel]);
                assert!(a == b || b == silent, "frame {frame}, taxel {taxel}: {a} {b}");
            }
        }
    }
}
