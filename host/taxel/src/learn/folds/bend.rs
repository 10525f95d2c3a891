//! Where a fold's joints stood between its knots, frame by frame: as `taxel_core::fold` has it.

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
    /// Knots about `step` degrees apart over all angles that a joint had, in whole hundredths of a degree.
    pub fn over(angles: impl Iterator<Item = f32>, step: f32, play: f32) -> Axis {
        let (least, most) = angles.fold((f32::MAX, f32::MIN), |(a, b), angle| (a.min(angle), b.max(angle)));
        let least = least.min(most).max(-180.0).floor();
        let steps = ((most - least) / step).ceil().max(1.0);
        let step = (((most - least) / steps * 100.0).ceil() / 100.0).max(0.01);
        Axis { first: least, step, knots: steps as usize + 1, play }
    }

    /// Knot below an angle, and the share of the way to the next.
    fn at(&self, angle: f32) -> (usize, f32) {
        let along = ((angle - self.first) / self.step).clamp(0.0, (self.knots - 1) as f32);
        let knot = (along as usize).min(self.knots.saturating_sub(2));
        (knot, along - knot as f32)
    }
}

/// A knot, and how much it counts.
pub(super) type KnotWeight = (usize, f32);

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
        let mut all = vec![[(0, 1.0), (0, 0.0), (0, 0.0), (0, 0.0)]; sweep.frames()];
        for (joint, axis) in self.joints.iter().zip(&self.axes) {
            let mut played: Option<f32> = None;
            for (frame, angle) in all.iter_mut().zip(sweep.angles(joint)?) {
                let at = played.map_or(angle, |played| played.clamp(angle - axis.play, angle + axis.play));
                played = Some(at);
                let (knot, share) = axis.at(at);
                let [first, second, ..] = *frame;
                let of = |(outer, weight): KnotWeight, more: usize, share: f32| {
                    (outer * axis.knots + (knot + more).min(axis.knots - 1), weight * share)
                };
                *frame = [
                    of(first, 0, 1.0 - share),
                    of(first, 1, share),
                    of(second, 0, 1.0 - share),
                    of(second, 1, share),
                ];
            }
        }
        Some(all)
    }

    /// The knots within so many degrees of one, itself among them.
    pub fn beside(&self, knot: usize, degrees: f32) -> Vec<usize> {
        let inner = self.axes.get(1).map_or(1, |axis| axis.knots);
        let is_near = |other: &usize| {
            let apart = [(other / inner).abs_diff(knot / inner), (other % inner).abs_diff(knot % inner)];
            self.axes
                .iter()
                .zip(apart)
                .all(|(axis, apart)| apart as f32 * axis.step <= degrees.max(axis.step))
        };
        (0..self.count()).filter(is_near).collect()
    }

    /// Its record, for the numbers of its joints in the table.
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
