//! Evidence that a touch is well meant: it gives way, strokes, or holds from two sides.
//!
//! | | |
//! |---|---|
//! | input | the touch that counts, the sums of the garment, the time |
//! | output | [`Warmth`]: pats and beats, the way stroked, the time of an embrace |
//! | saturation | at the ends of their types |
//! | latency | none |
//! | RAM | `Warmth`: part of that of [`Evidence`](super::Evidence) |
//!
//! A force **gives way** if it falls by a sixth of its height soon after it came, as a pat and a tap do, or if
//! it comes again after that, as in a shaken hand and in kneading. What lies does neither, and who grips lets
//! go. It **strokes** if a contact moves at the speed of a caress while its force stays; the way counts from 20
//! mm on, so that the unrest of a still contact does not. It **embraces** while breast and arms hold it, from
//! two sides.
//!
//! What has threatened or attacked must show it anew: [`Warmth::forget`].

use super::felt::Felt;
use super::input::Touch;
use crate::format::Micros;

/// Time within which the force of a pat gives way, us: a grip lets go later.
const BRIEF_US: u64 = 270_000;
/// Time within which a force that gives way comes again, if a hand shakes or kneads, us.
const BEAT_US: u64 = 1_000_000;
/// Part of its height by which a force gives way, per cent: a grip that presses too far at first yields less.
const GIVES: u32 = 17;
/// Part of the greatest force that may be left when a touch has gone.
const REST: u32 = 16;
/// Way of a stroke that counts, 0.1 mm.
const STROKE: u32 = 200;
/// Times in which a hand strokes that way, us: 13 to 200 mm/s.
const STROKE_US: [u64; 2] = [100_000, 1_500_000];
/// Area of an embrace, mm2: breast and arms cover more than most things that are carried.
const EMBRACE_MM2: u32 = 33_000;
/// Part of the force that the second side of an embrace has at least.
const SECOND: u32 = 6;

/// ForceCourse of the force of a touch.
#[derive(Debug, Default, Clone)]
struct ForceCourse {
    /// Greatest force since it came; then least since it gave way, counts.
    high: u32,
    low: u32,
    falls: bool,
    /// Time at which it came; none if what fell then was no friend's.
    came: Option<Micros>,
}

/// A contact on its way.
#[derive(Debug, Default, Clone)]
struct Path {
    /// Displacement and duration of the contact in the last frame.
    last: [i32; 2],
    duration_ms: u32,
    /// Way since `since`, 0.1 mm, and the force at that time, counts.
    way: [i32; 2],
    force: u32,
    since: Micros,
}

/// State of the measures.
#[derive(Debug, Default, Clone)]
pub(super) struct Warmth {
    course: ForceCourse,
    path: Path,
    /// Greatest force, and force that gave way last, counts.
    most: u32,
    given: u32,
    /// See [`Touch::gives`].
    pub gives: u32,
    /// See [`Touch::stroked`].
    pub stroked: u32,
    embraced_us: u64,
    before: Micros,
}

impl Warmth {
    /// Takes a frame in which a touch counts; `touch` is the strongest contact, if there is one.
    pub fn take(&mut self, touch: Option<&Touch>, felt: &Felt, now: Micros) {
        self.give(felt.load, now);
        if let Some(touch) = touch {
            self.stroke(touch, felt.load, now);
        }
        if felt.cover_mm2 >= EMBRACE_MM2 && felt.second() > felt.load / SECOND {
            self.embraced_us = self.embraced_us.saturating_add(now.since(self.before));
        }
        self.before = now;
    }

    /// A new touch: nothing is known of it.
    pub fn begin(&mut self, now: Micros) {
        *self = Warmth { before: now, ..Warmth::default() };
        self.course.came = Some(now);
    }

    /// Forgets what it has shown so far.
    pub fn forget(&mut self) {
        (self.gives, self.stroked, self.embraced_us) = (0, 0, 0);
        self.course.came = None;
    }

    /// See [`Touch::embraced_ms`].
    pub fn embraced_ms(&self) -> u32 {
        Micros(self.embraced_us).millis_since(Micros(0))
    }

    fn give(&mut self, force: u32, now: Micros) {
        let ForceCourse { high, low, falls, came } = self.course;
        let by_a_part = |change: u32, of: u32| change.saturating_mul(100) > of.saturating_mul(GIVES);
        let within = |time: u64| came.is_some_and(|came| now.since(came) <= time);
        // What is left of a touch when it has gone flickers, and fades as the fabric recovers.
        self.most = self.most.max(force);
        let least = self.most / REST;
        if falls {
            let low = low.min(force);
            self.course.low = low;
            if by_a_part(force - low, force) && force - low > least {
                if within(BEAT_US) && !within(BRIEF_US) {
                    (self.gives, self.given) = (self.gives.saturating_add(1), high);
                }
                self.course = ForceCourse { high: force, low: force, falls: false, came: Some(now) };
            }
        } else {
            let high = high.max(force);
            self.course.high = high;
            if by_a_part(high - force, high) {
                (self.course.falls, self.course.low) = (true, force);
                if high > least && within(BRIEF_US) {
                    (self.gives, self.given) = (self.gives.saturating_add(1), high);
                }
            }
        }
        // What has grown since was only coming.
        if force / 2 > self.given {
            self.gives = 0;
        }
    }

    fn stroke(&mut self, touch: &Touch, force: u32, now: Micros) {
        let path = &mut self.path;
        if touch.duration_ms >= path.duration_ms {
            for ((way, here), last) in path.way.iter_mut().zip(touch.way).zip(path.last) {
                *way = way.saturating_add(here.saturating_sub(last));
            }
        }
        (path.last, path.duration_ms) = (touch.way, touch.duration_ms);
        let [x, y] = path.way.map(i32::unsigned_abs);
        // The larger leg plus three eighths of the smaller: the hypotenuse to 7 %.
        let way = x.max(y).saturating_add(x.min(y) / 8 * 3);
        let passed = now.since(path.since);
        let grows = force / 5 > path.force / 4;
        if way < STROKE && passed < STROKE_US[1] && !grows {
            return;
        }
        let stays = !grows && force > path.force / 3 * 2;
        if way >= STROKE && (STROKE_US[0]..=STROKE_US[1]).contains(&passed) && stays {
            self.stroked = self.stroked.saturating_add(way);
        }
        (path.way, path.force, path.since) = ([0; 2], force, now);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Evidence after a touch of one contact with this force and way (0.1 mm) by milliseconds.
    fn warmth(ms: u64, course: impl Fn(u64) -> (u32, i32)) -> Warmth {
        let mut warmth = Warmth::default();
        warmth.begin(Micros(0));
        for ms in (0..ms).step_by(5) {
            let (force, way) = course(ms);
            let mut felt = Felt::default();
            felt.add(0, force, 100, 60, 100, 40);
            let touch = Touch { duration_ms: ms as u32, way: [way, 0], ..Touch::default() };
            warmth.take((force > 0).then_some(&touch), &felt, Micros(1_000 * ms));
        }
        warmth
    }

    #[test]
    fn a_pat_and_a_shaken_hand_give_way_and_what_lies_does_not() {
        assert_eq!(warmth(400, |ms| (if ms < 120 { 5_000 } else { 0 }, 0)).gives, 1);
        assert!(warmth(2_000, |ms| (if ms % 500 < 250 { 20_000 } else { 14_000 }, 0)).gives >= 4);
        assert_eq!(warmth(2_000, |ms| (if ms < 1_500 { 5_000 } else { 0 }, 0)).gives, 0);
        assert_eq!(warmth(2_000, |ms| (20_000 + 500 * (ms % 2) as u32, 0)).gives, 0);
        assert_eq!(warmth(1_000, |ms| (if ms < 400 { 30_000 } else { 0 }, 0)).gives, 0, "a grip lets go");
        assert_eq!(warmth(900, |ms| (if ms % 800 < 400 { 30_000 } else { 10_000 }, 0)).gives, 1, "it kneads");
        // A flicker while it comes is forgotten.
        assert_eq!(warmth(2_000, |ms| ([100, 70, 9_000][(ms as usize / 100).min(2)], 0)).gives, 0);
    }

    #[test]
    fn a_caress_strokes_and_what_rests_comes_or_darts_does_not() {
        let stroked = |speed: u64, force: fn(u64) -> u32| {
            warmth(1_000, move |ms| (force(ms), (speed * ms / 100) as i32)).stroked
        };
        assert!((550..=650).contains(&stroked(80, |_| 3_000)));
        assert_eq!(stroked(5, |_| 3_000), 0, "a still contact wanders");
        assert_eq!(stroked(400, |_| 3_000), 0, "a blow glances off");
        assert_eq!(stroked(60, |ms| 1_000 + 200 * ms as u32), 0, "a strap that is laid on");
    }

    #[test]
    fn what_holds_from_two_sides_embraces() {
        let embraced = |parts: [u32; 2], area: u16| {
            let mut warmth = Warmth::default();
            warmth.begin(Micros(0));
            for ms in 0..=500 {
                let mut felt = Felt::default();
                felt.add(0, 40_000, 300, area, 100, 40);
                felt.parts[..2].copy_from_slice(&parts);
                warmth.take(None, &felt, Micros(1_000 * ms));
            }
            warmth.embraced_ms()
        };
        assert_eq!(embraced([32_000, 8_000], 400), 500);
        assert_eq!((embraced([40_000, 0], 400), embraced([32_000, 8_000], 100)), (0, 0));
    }

    #[test]
    fn what_has_threatened_must_show_it_anew() {
        let mut warmth = warmth(100, |_| (60_000, 0));
        warmth.forget();
        let mut take = |force: u32, ms: u64| {
            let mut felt = Felt::default();
            felt.add(0, force, 100, 60, 100, 40);
            warmth.take(None, &felt, Micros(1_000 * ms));
            warmth.gives
        };
        assert_eq!([take(20_000, 200), take(0, 300), take(6_000, 400), take(0, 500)], [0, 0, 0, 1]);
    }

    #[test]
    fn nothing_overflows() {
        let mut warmth = Warmth::default();
        for (at, now) in [0, u64::MAX, 0, 5].into_iter().enumerate() {
            let far = if at % 2 == 0 { i32::MIN } else { i32::MAX };
            let touch = Touch { duration_ms: at as u32, way: [far; 2], ..Touch::default() };
            let mut felt = Felt::default();
            felt.add(0, u32::MAX, u16::MAX, u16::MAX, u32::MAX, 0);
            warmth.take(Some(&touch), &felt, Micros(now));
        }
    }
}
