//! Place of a fold's joints between its knots.

use super::lanes::WHOLE;
use super::record::{FoldRecord, NO_JOINT};

/// Share of the way to the next knot within which a posture counts as at a knot.
const NEAR: u16 = WHOLE / 4;
/// Margin by which another knot must count more than the one whose doubts are in force: an arm that trembles
/// midway between two knots then does not change them with each posture.
const NEARER: u16 = WHOLE / 8;

/// A knot beside the present posture, and how much it counts, of [`WHOLE`].
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub(super) struct Corner {
    pub knot: u16,
    pub weight: u16,
}

/// The bend of a fold.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub(super) struct Bend {
    /// Angles of the joints, hundredths of a degree.
    angles: [Option<i16>; 2],
    /// Angles that the sleeve has followed to, hundredths of a degree.
    played: [Option<i16>; 2],
    /// The knots around the present posture.
    pub corners: [Corner; 4],
    /// True if both joints are known.
    pub is_known: bool,
    /// The knot whose doubts are in force: the nearest, or one that counts almost as much.
    pub doubted_at: u16,
    /// True if some taxel may be in no doubt, of those that are doubted as near this knot.
    pub has_certain: bool,
    /// The knot that the posture was at last.
    pub knot: Option<u16>,
    /// Taxels yet to be compared there, in fours.
    pub left: u16,
    /// Taxels that were compared there.
    pub compared: u16,
    /// Fours, of those whose turn was last, that are expected as at these knots; at most all. Counted from 0
    /// up: an image does not hold a state of zeros.
    found: u16,
    /// Fours that are doubted as near this knot.
    doubted: u16,
    /// Fours that are expected as here between the knots.
    placed: u16,
    /// Fours whose levels are set, while nothing has touched them.
    set: u16,
}

/// Work due on the taxels of a fold whose turn it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Due {
    /// The knots around are others, or they have other corrections.
    pub knots: bool,
    /// The nearest knot is another.
    pub doubt: bool,
    /// The posture is another between the knots.
    pub posture: bool,
    /// True if what touches them is another.
    pub touch: bool,
}

impl Due {
    /// True if all is as it was in their last turn.
    pub fn is_nothing(self) -> bool {
        !(self.knots || self.doubt || self.posture || self.touch)
    }
}

impl Bend {
    /// Nowhere.
    pub const NONE: Bend = Bend {
        angles: [None; 2],
        played: [None; 2],
        corners: [Corner { knot: 0, weight: 0 }; 4],
        is_known: false,
        doubted_at: 0,
        has_certain: false,
        knot: None,
        left: 0,
        compared: 0,
        found: 0,
        doubted: 0,
        placed: 0,
        set: 0,
    };

    /// Number of the nearest knot.
    #[inline(never)] // M0+: once, for size
    pub fn nearest(&self) -> u16 {
        let [first, rest @ ..] = self.corners;
        rest.into_iter().fold(first, |most, next| if next.weight > most.weight { next } else { most }).knot
    }

    /// Returns how much a knot counts.
    fn weight(&self, knot: u16) -> u16 {
        self.corners.iter().filter(|corner| corner.knot == knot).map(|corner| corner.weight).sum()
    }

    /// The taxels are to be expected anew, each in its turn.
    pub fn renew(&mut self) {
        self.found = 0;
        self.doubt();
    }

    /// The taxels are to be doubted anew, each in its turn.
    fn doubt(&mut self) {
        (self.doubted, self.has_certain) = (0, false);
    }

    /// The levels of the taxels are to be set, each in its turn.
    pub fn set(&mut self) {
        self.set = 0;
    }

    /// Returns what is due with the next `count` fours, which then is done; `touched`: something touches
    /// taxels.
    pub fn due(&mut self, fold: &FoldRecord, count: usize, touched: bool) -> Due {
        let (all, count) = (fold.quads() as u16, count as u16);
        let was_due = |done: &mut u16| {
            let was_due = *done < all;
            *done = all.min(*done + count);
            was_due
        };
        let due = Due {
            knots: was_due(&mut self.found),
            doubt: was_due(&mut self.doubted),
            posture: was_due(&mut self.placed),
            touch: was_due(&mut self.set) || touched,
        };
        if touched {
            // What is touched now may be let go of by its next turn.
            self.set = 0;
        }
        due
    }

    /// Moves to these angles (hundredths of a degree) of the fold's joints, if they are known. When it
    /// comes to another knot than the last one, its taxels are to be compared.
    pub fn turn(&mut self, fold: &FoldRecord, angles: [Option<i16>; 2]) {
        if angles == self.angles {
            return;
        }
        let before = *self;
        self.angles = angles;
        self.follow(fold, angles);
        if before.is_known == self.is_known && before.corners == self.corners {
            return;
        }
        self.placed = 0;
        let corners = self.corners;
        let around = || before.corners.iter().zip(&corners);
        if before.is_known != self.is_known || around().any(|(was, is)| was.knot != is.knot) {
            self.renew();
        }
        let is_other = around().any(|(was, is)| (was.weight > 0) != (is.weight > 0));
        let (nearest, weight) = (self.nearest(), self.weight(self.doubted_at));
        if is_other || weight == 0 || self.weight(nearest) > weight + NEARER {
            self.doubted_at = nearest;
            self.doubt();
        }
    }

    #[inline(never)] // seldom
    fn follow(&mut self, fold: &FoldRecord, angles: [Option<i16>; 2]) {
        let FoldRecord { joints, knots: [_, inner], play, .. } = *fold;
        let [mut first, mut second] = [(0, 0); 2];
        self.is_known = false;
        for (axis, at) in [&mut first, &mut second].into_iter().enumerate() {
            let (Some(joint), Some(angle), Some(play), Some(played)) =
                (joints.get(axis), angles.get(axis), play.get(axis), self.played.get_mut(axis))
            else {
                return;
            };
            if *joint == NO_JOINT {
                continue;
            }
            let Some(angle) = angle.map(i32::from) else { return };
            let play = i32::from(*play);
            let followed = played.map_or(angle, |played| i32::from(played).clamp(angle - play, angle + play));
            *played = Some(followed as i16);
            *at = between(fold, axis, followed);
        }
        self.is_known = true;
        let ((row, down), (column, right)) = (first, second);
        let both = (down * right + WHOLE / 2) / WHOLE;
        let weights = [WHOLE + both - down - right, right - both, down - both, both];
        let start = row * u16::from(inner) + column;
        let below = start + u16::from(inner);
        for ((corner, knot), weight) in
            self.corners.iter_mut().zip([start, start + 1, below, below + 1]).zip(weights)
        {
            *corner = Corner { knot, weight };
        }
        let is_at_knot = [down, right].iter().all(|share| *share <= NEAR || *share >= WHOLE - NEAR);
        if !is_at_knot {
            self.left = 0;
        } else if self.knot != Some(self.nearest()) {
            (self.knot, self.left, self.compared) = (Some(self.nearest()), fold.quads() as u16, 0);
        }
    }
}

/// The knot at or below an angle, and the share of the way to the next one, of [`WHOLE`].
fn between(fold: &FoldRecord, axis: usize, angle: i32) -> (u16, u16) {
    let (Some(first), Some(step), Some(knots)) =
        (fold.first.get(axis), fold.step.get(axis), fold.knots.get(axis))
    else {
        return (0, 0);
    };
    let step = u32::from(*step).max(1);
    let last = u32::from(knots.saturating_sub(1));
    let along = (angle - i32::from(*first)).max(0).unsigned_abs().min(last * step);
    let knot = along / step;
    (knot as u16, ((along - knot * step) * u32::from(WHOLE) / step) as u16)
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use std::vec::Vec;

    fn pair() -> FoldRecord {
        FoldRecord {
            joints: [0, 1],
            knots: [3, 4],
            first: [-1000, 0],
            step: [1000, 500],
            play: [0, 0],
            taxels: 7,
            zero: 0,
        }
    }

    #[test]
    fn corners_are_those_of_bilinear_interpolation() {
        let fold = pair();
        for (a, b) in (-20..=20).flat_map(|a| (-4..=20).map(move |b| (a * 97, b * 83))) {
            let mut bend = Bend::NONE;
            bend.turn(&fold, [Some(a), Some(b)]);
            let there: Vec<Corner> = bend.corners.into_iter().filter(|corner| corner.weight > 0).collect();
            assert!(there.iter().all(|corner| corner.knot < 12), "{there:?}");
            assert_eq!(there.iter().map(|corner| corner.weight).sum::<u16>(), WHOLE);
            // The mean of the knots' places is the posture, within the table.
            let mean = |of: &dyn Fn(u16) -> f64| -> f64 {
                there.iter().map(|corner| of(corner.knot) * f64::from(corner.weight) / f64::from(WHOLE)).sum()
            };
            let down = mean(&|knot| f64::from(knot / 4) * 1000.0 - 1000.0);
            let right = mean(&|knot| f64::from(knot % 4) * 500.0);
            assert!((down - f64::from(a.clamp(-1000, 1000))).abs() <= 16.0, "{a}: {down}");
            assert!((right - f64::from(b.clamp(0, 1500))).abs() <= 8.0, "{b}: {right}");
        }
    }

    #[test]
    fn doubts_are_those_of_a_knot_nearby_and_change_seldom() {
        let fold = pair();
        let mut noise = 1u32;
        let mut next = |end: i16| {
            noise = noise.wrapping_mul(1664525).wrapping_add(1013904223);
            ((noise >> 16) % end.unsigned_abs() as u32) as i16
        };
        let mut bend = Bend::NONE;
        for _ in 0..20_000 {
            bend.turn(&fold, [Some(next(2400) - 1200), Some(next(1800) - 200)]);
            let most = bend.corners.iter().map(|corner| corner.weight).max().unwrap();
            let weight = bend.weight(bend.doubted_at);
            assert!(weight > 0 && weight + NEARER >= most, "{bend:?}");
        }
        // It trembles midway between two knots.
        let mut changes = |angle: i16| {
            bend.doubted = u16::MAX;
            bend.turn(&fold, [Some(angle), Some(0)]);
            bend.doubted == 0
        };
        assert_eq!([-1000, -450, -550, -450, -550].map(&mut changes), [true, true, false, false, false]);
        assert_eq!([-300, -700, -500, -300].map(&mut changes), [false, true, false, true]);
    }

    #[test]
    fn a_sleeve_follows_once_the_play_is_used_up() {
        let mut fold = pair();
        (fold.joints[1], fold.knots, fold.first, fold.step) = (NO_JOINT, [19, 1], [0, 0], [1000, 0]);
        fold.play = [900, 0];
        let mut bend = Bend::NONE;
        let mut knot = |angle: i16| {
            bend.turn(&fold, [Some(angle), None]);
            bend.corners
                .iter()
                .map(|c| f64::from(c.knot) * f64::from(c.weight) / f64::from(WHOLE))
                .sum::<f64>()
        };
        let near = |a: f64, b: f64| assert!((a - b).abs() < 0.01, "{a} {b}");
        near(knot(5000), 5.0);
        near(knot(5800), 5.0);
        near(knot(7000), 6.1);
        near(knot(6000), 6.1);
        near(knot(5000), 5.9);
        near(knot(18_000), 17.1);
        assert!(!{
            bend.turn(&fold, [None, None]);
            bend.is_known
        });
    }

    #[test]
    fn each_arrival_at_another_knot_asks_for_a_comparison() {
        let mut fold = pair();
        (fold.joints[1], fold.knots, fold.first, fold.step) = (NO_JOINT, [4, 1], [0, 0], [1000, 0]);
        let mut bend = Bend::NONE;
        let mut asks = |angle: i16| {
            bend.left = 0;
            bend.turn(&fold, [Some(angle), None]);
            bend.left > 0
        };
        assert_eq!(
            [100, 200, 600, 240, 1240, 1300, 800].map(&mut asks),
            [true, false, false, false, true, false, false]
        );
        assert_eq!([100, 900, 1200].map(&mut asks), [true, true, false]);
    }
}
