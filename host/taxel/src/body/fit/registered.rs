//! Two sets of points in a plane, one turned and shifted: the turn and the shift, and how sure they are.

use glam::DVec2;

/// Pairs of points that suggest a turn and a shift, at most.
const GUESSES: usize = 2000;
/// Distance below which a pair says nothing of the turn, m.
const APART: f64 = 0.01;
/// Points that are farther off than this many standard deviations are left out.
const GATE: f64 = 3.0;
/// They are kept if they are nearer than this, m: as much as a finger's place is uncertain.
const NEAR: f64 = 0.003;
/// And never if they are farther, m: no finger is so far beside its mark.
const FAR: f64 = 0.02;
/// Medians below this are alike, m: the shorter shift counts then. Around a link, a whole turn leads to the
/// same place.
const ALIKE: f64 = 1e-4;
/// Rounds of keeping and leaving out.
const ROUNDS: usize = 30;
/// Least number of points that must agree.
pub(super) const LEAST: usize = 3;
/// Standard deviation from which on a turn is not known, rad.
const VAGUE: f64 = 0.087;
/// Median of the distances of points whose coordinates each have a standard deviation of 1.
const MEDIAN: f64 = 1.1774;

/// A point, and where it should come to lie: one of several places.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Pair {
    pub from: DVec2,
    pub to: Vec<DVec2>,
}

/// A turn about the origin, then a shift.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Motion2 {
    /// rad
    pub turn: f64,
    /// m
    pub shift: DVec2,
}

impl Motion2 {
    fn of(self, from: DVec2) -> DVec2 {
        DVec2::from_angle(self.turn).rotate(from) + self.shift
    }

    /// The way that is missing to the nearest of a pair's places; none if it has no place.
    fn missing(self, pair: &Pair) -> Option<DVec2> {
        let at = self.of(pair.from);
        let ways = pair.to.iter().map(|to| *to - at);
        ways.min_by(|a, b| a.length_squared().total_cmp(&b.length_squared()))
    }
}

/// Result of the registration.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Registered {
    pub motion: Motion2,
    /// Way that is missing for each pair, m; none for one without a place.
    pub missing: Vec<Option<DVec2>>,
    /// Pairs that count.
    pub kept: Vec<bool>,
    /// Standard deviation of the shift along each axis, m, and of the turn, rad: none if the pairs do not say
    /// it.
    pub shift_sd: DVec2,
    pub turn_sd: Option<f64>,
}

/// Finds the turn and the shift on which most pairs agree, whatever the others say: the guess of two pairs
/// with the least median (P. J. Rousseeuw, 1984), then least squares over those near it. `turn` (rad) is
/// taken where the pairs do not say it. None if fewer than [`LEAST`] pairs, or no more than half of them,
/// agree.
pub(super) fn registered(pairs: &[Pair], turn: f64) -> Option<Registered> {
    let price = |(motion, median): &(Motion2, f64)| median.max(ALIKE) + ALIKE * motion.shift.length();
    let (mut motion, median) = guesses(pairs, turn).min_by(|a, b| price(a).total_cmp(&price(b)))?;
    let count = pairs.len() as f64;
    // Few points always agree on something: their median is too small.
    let mut sd = median / MEDIAN * (1.0 + 5.0 / (count - 2.0).max(1.0));
    let mut kept: Vec<bool> = Vec::new();
    let mut last = None;
    for _ in 0..ROUNDS {
        let near = (GATE * sd).clamp(NEAR, FAR);
        let now: Vec<bool> =
            pairs.iter().map(|pair| motion.missing(pair).is_some_and(|way| way.length() <= near)).collect();
        let count = now.iter().filter(|is_kept| **is_kept).count();
        if count < LEAST || 2 * count <= pairs.len() {
            return None;
        }
        let solved = solved(pairs, &now, motion, turn);
        let is_settled = kept == now;
        (motion, sd, kept) = (solved.motion, solved.sd, now);
        last = Some(solved);
        if is_settled {
            break;
        }
    }
    let Solved { shift_sd, turn_sd, .. } = last?;
    let missing = pairs.iter().map(|pair| motion.missing(pair)).collect();
    Some(Registered { motion, missing, kept, shift_sd, turn_sd })
}

/// Motions by two pairs, and by one pair alone with the known turn, each with the median of what is missing.
fn guesses(pairs: &[Pair], turn: f64) -> impl Iterator<Item = (Motion2, f64)> {
    let alone = pairs.iter().flat_map(move |pair| {
        let motion =
            move |to: &DVec2| Motion2 { turn, shift: *to - DVec2::from_angle(turn).rotate(pair.from) };
        pair.to.iter().map(motion).collect::<Vec<_>>()
    });
    let all = pairs.len() * pairs.len().saturating_sub(1) / 2;
    let step = all.div_ceil(GUESSES).max(1);
    let both = (0..pairs.len()).flat_map(|one| (0..one).map(move |other| (one, other)));
    let two = both.step_by(step).flat_map(|(one, other)| by_two(&pairs[one], &pairs[other]));
    let alone: Vec<Motion2> = alone.collect();
    let step = alone.len().div_ceil(GUESSES).max(1);
    alone.into_iter().step_by(step).chain(two).filter_map(|motion| {
        let mut off: Vec<f64> =
            pairs.iter().map(|pair| motion.missing(pair).map_or(f64::INFINITY, DVec2::length)).collect();
        let middle = off.len() / 2;
        let (_, median, _) = off.select_nth_unstable_by(middle, f64::total_cmp);
        Some((motion, *median)).filter(|(_, median)| median.is_finite())
    })
}

/// Motions that bring two points to two of their places, if these are as far apart.
fn by_two(one: &Pair, other: &Pair) -> Vec<Motion2> {
    let way = other.from - one.from;
    if way.length() < APART {
        return Vec::new();
    }
    let both = one.to.iter().flat_map(|a| other.to.iter().map(move |b| (*a, *b)));
    let motion = |(a, b): (DVec2, DVec2)| {
        let turn = way.angle_to(b - a);
        let shift = (a + b) / 2.0 - DVec2::from_angle(turn).rotate((one.from + other.from) / 2.0);
        let is_as_far = ((b - a).length() - way.length()).abs() < APART + 0.1 * way.length();
        (is_as_far && turn.is_finite()).then_some(Motion2 { turn, shift })
    };
    both.filter_map(motion).collect()
}

struct Solved {
    motion: Motion2,
    /// Standard deviation of each coordinate, m.
    sd: f64,
    shift_sd: DVec2,
    turn_sd: Option<f64>,
}

/// Least squares over the pairs that are kept, each with the place that is nearest so far.
fn solved(pairs: &[Pair], kept: &[bool], near: Motion2, known: f64) -> Solved {
    let kept = || pairs.iter().zip(kept).filter(|(_, is_kept)| **is_kept).map(|(pair, _)| pair);
    let points: Vec<(DVec2, DVec2)> =
        kept().filter_map(|pair| Some((pair.from, near.of(pair.from) + near.missing(pair)?))).collect();
    let count = points.len() as f64;
    let mean = |of: &dyn Fn(&(DVec2, DVec2)) -> DVec2| points.iter().map(of).sum::<DVec2>() / count;
    let (from, to) = (mean(&|(from, _)| *from), mean(&|(_, to)| *to));
    let (mut along, mut across, mut spread) = (0.0, 0.0, 0.0);
    for (a, b) in &points {
        let (a, b) = (*a - from, *b - to);
        (along, across, spread) = (along + a.dot(b), across + a.perp_dot(b), spread + a.length_squared());
    }
    let with = |turn: f64, unknowns: f64| {
        let motion = Motion2 { turn, shift: to - DVec2::from_angle(turn).rotate(from) };
        let squares: f64 = points.iter().map(|(a, b)| (*b - motion.of(*a)).length_squared()).sum();
        (motion, (squares / (2.0 * count - unknowns)).sqrt())
    };
    let (motion, sd) = with(across.atan2(along), 3.0);
    let turn_sd = sd / spread.sqrt();
    // A few touches may agree by chance: the turn is as unsure as the place of a finger allows.
    if turn_sd.max(NEAR / 3.0 / spread.sqrt()) <= VAGUE {
        let arm = DVec2::from_angle(motion.turn).rotate(from).perp() * turn_sd;
        let of = |arm: f64| (sd * sd / count + arm * arm).sqrt();
        return Solved { motion, sd, shift_sd: DVec2::new(of(arm.x), of(arm.y)), turn_sd: Some(turn_sd) };
    }
    let (motion, sd) = with(known, 2.0);
    Solved { motion, sd, shift_sd: DVec2::splat(sd / count.sqrt()), turn_sd: None }
}
