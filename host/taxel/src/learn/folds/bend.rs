//! Place of a fold's joints between its knots, frame by frame: as `taxel_core::fold` has it.

use super::sweep::FoldSweep;
use taxel_core::fold::{FoldRecord, NO_JOINT};

/// Knots of a joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Axis {
    /// Angle of the first knot, degrees.
    pub first: f32,
    /// Angle between knots, degrees.
    pub step: f32,
    /// Number of knots.
    pub knots: usize,
    /// Turn back before the sleeve follows, degrees.
    pub play: f32,
}

impl Axis {
    /// Knots about `step` degrees apart over the angles that a joint's sleeve had in most sweeps, in whole
    /// hundredths of a degree. Each is the middle of the angles next to it, the first and the last, too: a knot
    /// to which a sleeve seldom comes would seldom be compared on a day.
    pub fn over(sweeps: &[FoldSweep], joint: &str, step: f32, play: f32) -> Axis {
        let ends = sweeps.iter().filter_map(|sweep| {
            let played = played(sweep.angles(joint)?, play);
            Some(played.fold((f32::MAX, f32::MIN), |(a, b), angle| (a.min(angle), b.max(angle))))
        });
        let (mut least, mut most): (Vec<f32>, Vec<f32>) = ends.unzip();
        let [least, most] = [&mut least, &mut most].map(|all| {
            all.sort_by(f32::total_cmp);
            all.get(all.len() / 2).copied().unwrap_or(0.0)
        });
        let knots = ((most - least) / step).ceil().max(2.0);
        let step = (((most - least) / knots * 100.0).ceil() / 100.0).max(0.01);
        let first = ((least + step / 2.0) * 100.0).round() / 100.0;
        Axis { first, step, knots: knots as usize, play }
    }

    /// Knots of the joints before this one, each split into those around an angle of this one.
    fn split(&self, knots: [KnotWeight; 4], angle: f32) -> [KnotWeight; 4] {
        let (knot, share) = self.at(angle);
        let [first, second, ..] = knots;
        let of = |(outer, weight): KnotWeight, more: usize, share: f32| {
            (outer * self.knots + (knot + more).min(self.knots - 1), weight * share)
        };
        [of(first, 0, 1.0 - share), of(first, 1, share), of(second, 0, 1.0 - share), of(second, 1, share)]
    }

    /// Knot below an angle, and the share of the way to the next.
    fn at(&self, angle: f32) -> (usize, f32) {
        let along = ((angle - self.first) / self.step).clamp(0.0, (self.knots - 1) as f32);
        let knot = (along as usize).min(self.knots.saturating_sub(2));
        (knot, along - knot as f32)
    }
}

/// Angles of a sleeve that follows its joint's only after so much of a turn back.
fn played(angles: impl Iterator<Item = f32>, play: f32) -> impl Iterator<Item = f32> {
    angles.scan(None, move |played: &mut Option<f32>, angle| {
        *played = Some(played.map_or(angle, |played| played.clamp(angle - play, angle + play)));
        *played
    })
}

/// A knot, and how much it counts.
pub(super) type KnotWeight = (usize, f32);

/// The knot of no joint.
const START: [KnotWeight; 4] = [(0, 1.0), (0, 0.0), (0, 0.0), (0, 0.0)];

/// The joints of a fold, and their knots.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Knots {
    /// Names of one or two joints.
    pub joints: Vec<String>,
    /// Their knots.
    pub axes: Vec<Axis>,
}

impl Knots {
    /// Number of knots.
    pub fn count(&self) -> usize {
        self.axes.iter().map(|axis| axis.knots).product()
    }

    /// The knots around each frame's posture, four at most; none if a joint did not take part in the sweep.
    pub fn weights(&self, sweep: &FoldSweep) -> Option<Vec<[KnotWeight; 4]>> {
        let mut all = vec![START; sweep.frames()];
        for (joint, axis) in self.joints.iter().zip(&self.axes) {
            for (frame, at) in all.iter_mut().zip(played(sweep.angles(joint)?, axis.play)) {
                *frame = axis.split(*frame, at);
            }
        }
        Some(all)
    }

    /// The knots around a posture: the angle of each joint's sleeve, degrees.
    pub fn around(&self, degrees: &[f32]) -> [KnotWeight; 4] {
        self.axes.iter().zip(degrees).fold(START, |knots, (axis, at)| axis.split(knots, *at))
    }

    /// The knots whose folds may come to one within so many degrees, itself among them: it stands for postures
    /// almost a step away.
    pub fn beside(&self, knot: usize, degrees: f32) -> Vec<usize> {
        let inner = self.axes.get(1).map_or(1, |axis| axis.knots);
        let is_near = |other: &usize| {
            let apart = [(other / inner).abs_diff(knot / inner), (other % inner).abs_diff(knot % inner)];
            self.axes.iter().zip(apart).all(|(axis, apart)| apart as f32 * axis.step <= degrees + axis.step)
        };
        (0..self.count()).filter(is_near).collect()
    }

    /// Makes its record, for the numbers of its joints in the table.
    pub fn record(&self, number: impl Fn(&str) -> u8, taxels: usize) -> FoldRecord {
        let mut record = FoldRecord {
            joints: [NO_JOINT; 2],
            knots: [1; 2],
            first: [0; 2],
            step: [0; 2],
            play: [0; 2],
            taxels: taxels as u16,
            zero: 0,
        };
        for (at, (joint, axis)) in self.joints.iter().zip(&self.axes).enumerate().take(2) {
            record.joints[at] = number(joint);
            record.knots[at] = axis.knots as u8;
            record.first[at] = (axis.first * 100.0).round() as i16;
            record.step[at] = (axis.step * 100.0).round() as u16;
            record.play[at] = (axis.play * 100.0).round() as u16;
        }
        record
    }
}
