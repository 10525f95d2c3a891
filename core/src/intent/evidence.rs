//! Measures over the frames of a touch: how suddenly it came, its beats, how long it has been still.
//!
//! | | |
//! |---|---|
//! | input | [`Felt`] of each frame, the time |
//! | output | the measures of [`Evidence`] |
//! | saturation | at the ends of their types |
//! | latency | none |
//! | RAM | [`Evidence`]: 448 bytes |
//!
//! All times are those of the frames. **Rise** is the increase of certain pressure ([`Felt::certain`]) since
//! the latest earlier frame that is at least [`WINDOW_US`] older; if frames are further apart, since the
//! frame before. It is the greatest rise of a region, and at most that of the whole garment: a contact that
//! crosses a border moves its pressure from one region to another, and the garment's pressure does not rise.
//!
//! The **rising time** is the growth of the load since it last rested, `FOOT_US` before or earlier, over the
//! steepest rise: that of a blow is short, however much it presses on what was there.
//!
//! A touch **still comes** while its load, at the rate of that time, would double within 55 ms: what it will
//! be cannot be known yet.

use super::felt::Felt;
use super::warmth::Warmth;
use crate::format::{Inverse, Micros, wide};
use core::num::NonZeroU32;

/// Shortest time over which a rise is measured, us: two frames of the reference board, a quarter of the time
/// in which a hand closes.
pub const WINDOW_US: u64 = 9_000;
/// Time within which a load that still comes would double at its present rate, us. Pokes and pushes grow
/// faster until they are harder than a kind touch; what leans, holds or strokes grows more slowly.
const COMING_US: u32 = 55_000;
/// Time before which the load had rested when a rise began, us: a blow is over by then.
const FOOT_US: u64 = 60_000;
/// Time after the last rise from which a touch has settled, us.
const SETTLED_US: u64 = 200_000;
/// Shortest time between two beats of a hand, us.
const FASTEST_BEAT_US: u64 = 120_000;
/// Time without a beat after which the rhythm is over, us.
const SLOWEST_BEAT_US: u64 = 2_000_000;

/// Time with less than half of the pressure left after which the object counts as taken away, us: the rest
/// flickers while it goes.
const TAKEN_US: u64 = 200_000;

/// Certain pressure at some time.
#[derive(Debug, Default, Clone)]
struct Anchor {
    at: Micros,
    felt: Felt,
}

/// Greatest recent value.
#[derive(Debug, Default, Clone, Copy)]
struct RecentPeak {
    value: u32,
    at: Micros,
}

impl RecentPeak {
    /// Takes the value of this frame; a greatest value older than `memory_us` is forgotten.
    fn take(&mut self, value: u32, now: Micros, memory_us: u64) {
        if value >= self.value || now.since(self.at) >= memory_us {
            *self = RecentPeak { value, at: now };
        }
    }
}

/// Counter of falls and rises of the force.
#[derive(Debug, Default, Clone)]
struct Beats {
    count: u32,
    /// Greatest load since the last rise; then least load since the fall.
    high: u32,
    low: u32,
    falling: bool,
    last: Micros,
}

impl Beats {
    /// A fall by a fifth of the greatest load and a rise by the same amount are a beat.
    fn take(&mut self, load: u32, now: Micros) {
        // A product is cheaper than a fifth.
        let swings = |change: u32, high: u32| change.saturating_mul(5) > high;
        if !self.falling {
            self.high = self.high.max(load);
            (self.falling, self.low) = (swings(self.high - load, self.high), load);
        } else if swings(load.saturating_sub(self.low), self.high) {
            if now.since(self.last) >= FASTEST_BEAT_US {
                self.count = self.count.saturating_add(1);
                self.last = now;
            }
            (self.falling, self.high) = (false, load);
        } else {
            self.low = self.low.min(load);
        }
        if now.since(self.last) >= SLOWEST_BEAT_US {
            self.count = 0;
        }
    }
}

/// State of the measures.
#[derive(Debug, Default, Clone)]
pub struct Evidence {
    anchors: [Anchor; 2],
    begun: bool,
    /// Rise of this frame, counts/ms.
    pub(super) rise: u32,
    /// True while the touch still comes; see the [module](self).
    pub(super) comes: bool,
    blow: RecentPeak,
    load: RecentPeak,
    peak: RecentPeak,
    pressure: RecentPeak,
    /// Loads of some time ago, and the growth since then of the steepest recent rise, counts.
    feet: [(Micros, u32); 2],
    growth: u32,
    cover_mm2: u32,
    pub(super) warmth: Warmth,
    beats: Beats,
    /// Load when it began to be still, counts; and time of that.
    rest: u32,
    since: Micros,
    /// Last time at which at least half of that load was there.
    whole: Micros,
    still_ms: u32,
}

impl Evidence {
    /// Takes a frame. `counts` is true while a touch counts; otherwise the measures of the last one are
    /// forgotten. `memory_us` is the time for which a touch counts after its end.
    pub(super) fn take(&mut self, felt: &Felt, counts: bool, now: Micros, memory_us: u64) {
        if !self.begun {
            // How what touches in the first frame came was not seen.
            self.feet = [(now, felt.load); 2];
            self.warmth.begin(now);
            self.warmth.forget();
        }
        self.rise = self.rise_of(felt, now);
        if !counts {
            (self.blow, self.load, self.peak, self.pressure) = Default::default();
            // Nothing is left of the time before: the same touch means the same whenever it comes.
            (self.growth, self.feet) = (0, [(now, felt.load); 2]);
            self.warmth.begin(now);
            (self.beats, self.cover_mm2, self.rest, self.still_ms) = (Beats::default(), 0, 0, 0);
        }
        let growth = self.growth_of(felt.load, now);
        // A touch that has ended keeps its values as long as it counts.
        if felt.load > 0 {
            self.blow.take(self.rise, now, memory_us);
            self.load.take(felt.load, now, memory_us);
            self.peak.take(felt.peak.into(), now, memory_us);
            self.pressure.take(felt.pressure, now, memory_us);
            if self.blow.at == now {
                self.growth = growth;
            } else if now.since(self.blow.at) <= 2 * FOOT_US {
                self.growth = self.growth.max(growth);
            }
        }
        self.cover_mm2 = self.cover_mm2.max(felt.cover_mm2);
        if felt.load > 0 || counts {
            self.beats.take(felt.load, now);
        }
        self.rests(felt.load, now);
    }

    /// Returns the rise of this frame, counts/ms, and updates whether the touch still comes.
    fn rise_of(&mut self, felt: &Felt, now: Micros) -> u32 {
        if !self.begun {
            // The onset of what touches in the first frame was not seen.
            self.begun = true;
            self.anchors = [Anchor { at: now, felt: *felt }, Anchor { at: now, felt: *felt }];
        }
        let [older, newer] = &self.anchors;
        let anchor = if now.since(newer.at) >= WINDOW_US { newer } else { older };
        let regions = felt.certain.iter().zip(&anchor.felt.certain);
        let region = regions.map(|(here, then)| here.saturating_sub(*then)).max().unwrap_or(0);
        let gain = region.min(felt.whole().saturating_sub(anchor.felt.whole()));
        let passed = u32::try_from(now.since(anchor.at)).unwrap_or(u32::MAX);
        let growth = felt.load.saturating_sub(anchor.felt.load);
        // Of an exponential, the growth over the mean load says its rate however far apart the frames are.
        let mean = felt.load.saturating_sub(growth / 2);
        // What comes grows by a seventh within WINDOW_US; what grows by less needs no long product.
        self.comes = growth > felt.load / 8 && wide(growth, COMING_US) > wide(mean, passed);
        let rise = match NonZeroU32::new(passed) {
            Some(passed) if gain > 0 => Inverse::of(passed.get()).quotient(wide(gain, 1_000)),
            _ => 0,
        };
        if now.since(newer.at) >= WINDOW_US / 2 {
            self.anchors.swap(0, 1);
            self.anchors[1] = Anchor { at: now, felt: *felt };
        }
        rise
    }

    /// Returns the growth of the load since it rested.
    fn growth_of(&mut self, load: u32, now: Micros) -> u32 {
        let [older, newer] = self.feet;
        let foot = if now.since(newer.0) >= FOOT_US { newer } else { older };
        if now.since(newer.0) >= FOOT_US {
            self.feet = [newer, (now, load)];
        }
        load.saturating_sub(foot.1)
    }

    /// Updates the time of being still: a load is still as long as no more than a tenth is added. Removal of
    /// a part does not end it.
    fn rests(&mut self, load: u32, now: Micros) {
        if load.saturating_sub(self.rest).saturating_mul(10) > self.rest {
            (self.rest, self.since, self.whole) = (load, now, now);
        } else if load > self.rest / 2 {
            self.whole = now;
        } else if now.since(self.whole) >= TAKEN_US {
            self.rest = load;
        }
        if load > 0 {
            self.still_ms = now.millis_since(self.since);
        }
    }

    /// Steepest recent rise, counts/ms.
    pub fn blow(&self) -> u32 {
        self.blow.value
    }

    /// Greatest recent mean pressure of a contact, counts per cm2.
    pub fn pressure(&self) -> u32 {
        self.pressure.value
    }

    /// Time in which the load grew at its steepest recent rise, us; the largest number if it did not rise.
    pub fn rising_us(&self) -> u32 {
        match NonZeroU32::new(self.blow.value) {
            Some(rise) => Inverse::of(rise.get()).quotient(wide(self.growth, 1_000)),
            None => u32::MAX,
        }
    }

    /// True if the touch has not come nearer for some time, and can be known.
    pub(super) fn has_settled(&self, now: Micros) -> bool {
        now.since(self.since) >= SETTLED_US
    }

    /// Greatest recent total pressure, counts.
    pub fn load(&self) -> u32 {
        self.load.value
    }

    /// Greatest recent pressure of a taxel, counts.
    pub fn peak(&self) -> u32 {
        self.peak.value
    }

    /// Largest area touched at once, mm2.
    pub fn cover_mm2(&self) -> u32 {
        self.cover_mm2
    }

    /// Number of falls and rises of the force at the tempo of a hand.
    pub fn beats(&self) -> u32 {
        self.beats.count
    }

    /// Time since force was last added, ms.
    pub fn still_ms(&self) -> u32 {
        self.still_ms
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;

    const MEMORY_US: u64 = 600_000;

    /// A broad contact of `area` taxels on region 0.
    fn felt(total: u32, area: u16) -> Felt {
        let mut felt = Felt::default();
        felt.add(0, total, (total / u32::from(area.max(1))) as u16, area, 100, 40);
        felt
    }

    /// Steepest rise of a course of (total, area) over seconds, sampled that often.
    fn steepest(period_us: u64, course: impl Fn(f64) -> (u32, u16)) -> u32 {
        let mut evidence = Evidence::default();
        (0..1_000_000 / period_us).for_each(|frame| {
            let now = frame * period_us;
            let (total, area) = course(now as f64 / 1e6);
            evidence.take(&felt(total, area), true, Micros(now), MEMORY_US * 10);
        });
        evidence.blow()
    }

    #[test]
    fn what_has_its_whole_area_at_once_did_not_come_at_once() {
        // 30 N in 0.5 s on 300 taxels: it shows when each taxel has 40 counts, 12 N at once.
        let hug = |t: f64| {
            let total = (60_000.0 * (t - 0.2)).clamp(0.0, 30_000.0) as u32;
            if total >= 12_000 { (total, 300) } else { (0, 0) }
        };
        for period_us in [640, 5_128, 10_000, 40_000] {
            let rise = steepest(period_us, hug);
            assert!((30..=66).contains(&rise), "{rise} counts/ms at {period_us} us, 60 are true");
        }
    }

    #[test]
    fn a_blow_is_as_steep_at_any_rate_that_resolves_it() {
        let slap = |t: f64| ((3_000_000.0 * (t - 0.5)).clamp(0.0, 40_000.0) as u32, 60);
        for period_us in [640, 2_500, 5_128, 9_000] {
            let rise = steepest(period_us, slap);
            assert!((2_000..=3_000).contains(&rise), "{rise} at {period_us} us");
        }
        // Within a frame of 40 ms it may have come slowly.
        assert!(steepest(40_000, slap) <= 1_000);
    }

    #[test]
    fn what_would_double_soon_still_comes_at_any_rate() {
        // Grows e-fold in that many milliseconds, and rests from 0.2 s on.
        let comes = |period_us: u64, fold_ms: f64, until_ms: u64| {
            let mut evidence = Evidence::default();
            for now in (0..=until_ms * 1_000).step_by(period_us as usize) {
                let total = 100.0 * (now.min(200_000) as f64 / 1e3 / fold_ms).exp();
                evidence.take(&felt(total as u32, 60), true, Micros(now), MEMORY_US);
            }
            evidence.comes
        };
        for period_us in [640, 2_500, 5_128, 9_000, 20_000, 40_000] {
            for (fold_ms, wanted) in [(20.0, true), (40.0, true), (80.0, false), (270.0, false)] {
                assert_eq!(comes(period_us, fold_ms, 200), wanted, "{fold_ms} ms at {period_us} us");
                assert!(!comes(period_us, fold_ms, 240), "{fold_ms} ms at {period_us} us, at rest");
            }
        }
    }

    /// As after a change of the scene while somebody holds the robot.
    #[test]
    fn what_was_there_from_the_first_frame_on_has_embraced_nobody_yet() {
        let mut evidence = Evidence::default();
        let mut held = Felt::default();
        held.add(0, 40_000, 300, 400, 100, 40);
        held.parts[..2].copy_from_slice(&[32_000, 8_000]);
        for ms in [60_000, 60_005] {
            evidence.take(&held, true, Micros(1_000 * ms), MEMORY_US);
            evidence.warmth.take(None, &held, Micros(1_000 * ms));
        }
        assert_eq!(evidence.warmth.embraced_ms(), 5);
    }

    #[test]
    fn a_rise_takes_as_long_however_long_the_force_stays() {
        // 60 N in 0.2 s, and 1 N more at once 0.3 s later, which is the steepest rise of the last 0.6 s in the
        // end.
        let mut evidence = Evidence::default();
        let mut least = u32::MAX;
        for ms in (0..1_600u64).step_by(5) {
            let total = 300 * ms.min(200) as u32 + if ms >= 500 { 1_000 } else { 0 };
            evidence.take(&felt(total, 60), true, Micros(1_000 * ms), MEMORY_US);
            if (100..1_000).contains(&ms) {
                least = least.min(evidence.rising_us());
            }
        }
        assert!(least >= 50_000, "{least} us");
    }

    #[test]
    fn a_touch_rises_alike_whenever_it_comes() {
        let rising = |idle_us: u64| {
            let mut evidence = Evidence::default();
            let frames = (0..idle_us).step_by(5_000).chain([idle_us]).map(|now| (now, 0));
            // 60 N in 90 ms.
            let touch = (1..=40u64).map(|n| (idle_us + 5_000 * n, 3_333 * n.min(18) as u32));
            for (now, total) in frames.chain(touch) {
                evidence.take(&felt(total, 60), total > 0, Micros(now), MEMORY_US);
            }
            evidence.rising_us()
        };
        let first = rising(0);
        assert!((1..40).all(|n| rising(7_000 * n) == first), "{first} us");
    }

    #[test]
    fn a_contact_that_changes_its_region_has_not_come() {
        let mut evidence = Evidence::default();
        for frame in 0..100u64 {
            let mut felt = Felt::default();
            felt.add((frame / 50) as u8, 40_000, 900, 60, 100, 40);
            evidence.take(&felt, true, Micros(5_000 * frame), MEMORY_US);
            assert_eq!(evidence.rise, 0, "frame {frame}");
        }
    }

    #[test]
    fn beats_are_those_of_a_hand() {
        let count = |hz: f64, part: f64| {
            let mut evidence = Evidence::default();
            for ms in (0..1_500u64).step_by(5) {
                let wave = (std::f64::consts::TAU * hz * ms as f64 / 1e3).sin();
                let felt = felt((20_000.0 * (1.0 - part / 2.0 + part / 2.0 * wave)) as u32, 60);
                evidence.take(&felt, true, Micros(1_000 * ms), MEMORY_US);
            }
            evidence.beats()
        };
        assert!((3..=6).contains(&count(3.0, 0.5)), "a handshake");
        assert_eq!(count(9.0, 0.06), 0, "tremor");
        assert_eq!(count(1.0, 0.0), 0, "a grip");
        assert!(count(25.0, 0.8) < 13, "nothing that a hand does");
    }

    #[test]
    fn what_lies_is_still_though_it_is_taken_away_and_what_comes_to_it_is_not() {
        let mut evidence = Evidence::default();
        let mut take = |load: u32, ms: u64| {
            evidence.take(&felt(load, 30), true, Micros(1_000 * ms), MEMORY_US);
            evidence.still_ms()
        };
        assert_eq!(take(9_000, 0), 0);
        assert_eq!((take(9_400, 1_000), take(8_800, 2_000)), (1_000, 2_000));
        assert_eq!((take(4_000, 2_100), take(0, 2_200)), (2_100, 2_100));
        assert_eq!(take(9_000, 3_000), 0);
    }

    #[test]
    fn times_that_leap_or_stand_are_taken() {
        let mut evidence = Evidence::default();
        for (us, total) in [(0, 0), (0, u32::MAX), (u64::MAX, u32::MAX), (5, 0), (5, 90_000)] {
            evidence.take(&felt(total, u16::MAX), true, Micros(us), MEMORY_US);
        }
        assert_eq!(evidence.load(), u32::MAX);
    }
}
