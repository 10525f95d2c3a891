//! Transport of the player: position, speed, range, loop.

use crate::view::lines::PlayerLine;
use crate::view::order::Order;
use std::time::Duration;
use taxel::time::Instant;

/// Slowest and fastest speed.
pub const SPEEDS: [f64; 2] = [0.01, 64.0];
/// Shortest range, us; a shorter one is a slip of the pointer.
const SHORTEST: u64 = 10_000;

/// State of the transport; times are microseconds since the recording began.
#[derive(Debug, Clone)]
pub struct Deck {
    duration: u64,
    range: [u64; 2],
    speed: f64,
    repeats: bool,
    playing: bool,
    /// The position, and when it was set.
    at: u64,
    since: Instant,
    seeks: u32,
}

/// Order to the reader of the recording.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Go {
    /// Play up to this time.
    On(u64),
    /// Jump to this time.
    To(u64),
    /// Step by this many images.
    By(i32),
    /// Nothing.
    Stay,
}

impl Deck {
    /// Paused at the beginning of a recording.
    pub fn new(duration: u64, speed: f64, now: Instant) -> Deck {
        Deck {
            duration,
            range: [0, duration],
            speed: speed.clamp(SPEEDS[0], SPEEDS[1]),
            repeats: false,
            playing: false,
            at: 0,
            since: now,
            seeks: 0,
        }
    }

    /// Beginning and end of the range, us.
    pub fn range(&self) -> [u64; 2] {
        self.range
    }

    /// Number of jumps in time.
    pub fn seeks(&self) -> u32 {
        self.seeks
    }

    /// True while playing.
    pub fn is_playing(&self) -> bool {
        self.playing
    }

    /// Obeys an order of a page.
    pub fn obey(&mut self, order: &Order, now: Instant) -> Go {
        self.settle(now);
        match *order {
            Order::Play(playing) => return self.play(playing),
            Order::Seek(seconds) => return self.go_to(micros(seconds).min(self.duration)),
            Order::Step(images) => {
                self.playing = false;
                return Go::By(images);
            }
            Order::Speed(speed) => self.speed = speed.clamp(SPEEDS[0], SPEEDS[1]),
            Order::Loop(repeats) => self.repeats = repeats,
            Order::Range(None) => self.range = [0, self.duration],
            Order::Range(Some(ends)) => {
                let [a, b] = ends.map(|end| micros(end).min(self.duration));
                let (from, to) = (a.min(b), a.max(b));
                if to - from >= SHORTEST.min(self.duration) {
                    self.range = [from, to];
                }
            }
        }
        Go::Stay
    }

    /// Starts or stops; at the end of the range it restarts.
    fn play(&mut self, playing: bool) -> Go {
        self.playing = playing;
        let [from, to] = self.range;
        if playing && self.at >= to { self.go_to(from) } else { Go::Stay }
    }

    fn go_to(&mut self, at: u64) -> Go {
        self.at = at;
        self.seeks = self.seeks.wrapping_add(1);
        Go::To(at)
    }

    /// Sets the position to the current time.
    fn settle(&mut self, now: Instant) {
        self.at = self.position(now);
        self.since = now;
    }

    /// Current position, us.
    pub fn position(&self, now: Instant) -> u64 {
        if !self.playing {
            return self.at;
        }
        let passed = now.saturating_duration_since(self.since).mul_f64(self.speed).as_micros() as u64;
        // Beyond the range, it plays to the end of the recording.
        let end = if self.at < self.range[1] { self.range[1] } else { self.duration };
        (self.at + passed).min(end)
    }

    /// Returns what is to be done now.
    pub fn tick(&mut self, now: Instant) -> Go {
        if !self.playing {
            return Go::Stay;
        }
        let position = self.position(now);
        if position < self.range[1] || (self.at >= self.range[1] && position < self.duration) {
            return Go::On(position);
        }
        self.settle(now);
        if self.repeats {
            return self.go_to(self.range[0]);
        }
        self.playing = false;
        Go::On(position)
    }

    /// The reader is late: continue from its position.
    pub fn hold_back(&mut self, at: u64, now: Instant) {
        self.settle(now);
        self.at = self.at.min(at);
    }

    /// An image of this time is shown while paused.
    pub fn stand(&mut self, at: u64) {
        self.at = at.min(self.duration);
        self.seeks = self.seeks.wrapping_add(1);
    }

    /// Time until there is something to do, if the next image has the time `due`; at most a moment.
    pub fn rest(&self, due: Option<u64>, now: Instant) -> Duration {
        let longest = Duration::from_millis(if self.playing { 20 } else { 200 });
        let Some(due) = due.filter(|_| self.playing) else { return longest };
        let wait = Duration::from_micros(due.saturating_sub(self.position(now)));
        wait.div_f64(self.speed).clamp(Duration::from_millis(1), longest)
    }

    /// The message `player`, with times in seconds.
    pub fn message(&self, now: Instant) -> PlayerLine {
        let seconds = |us: u64| us as f64 / 1e6;
        PlayerLine {
            at: seconds(self.position(now)),
            duration: seconds(self.duration),
            range: self.range.map(seconds),
            speed: self.speed,
            repeats: self.repeats,
            playing: self.playing,
            seeks: self.seeks,
        }
    }
}

/// Converts seconds, not negative, to microseconds.
fn micros(seconds: f64) -> u64 {
    (seconds.max(0.0) * 1e6).round() as u64
}

#[cfg(test)]
mod tests {
    use super::*;

    const S: u64 = 1_000_000;

    fn after(start: Instant, ms: u64) -> Instant {
        start + Duration::from_millis(ms)
    }

    #[test]
    fn time_stands_while_nothing_is_played_and_passes_at_the_speed() {
        let start = Instant::now();
        let mut deck = Deck::new(10 * S, 1.0, start);
        assert_eq!((deck.position(after(start, 900)), deck.tick(after(start, 900))), (0, Go::Stay));
        assert_eq!(deck.obey(&Order::Play(true), after(start, 1000)), Go::Stay);
        assert_eq!(deck.tick(after(start, 1500)), Go::On(500_000));
        deck.obey(&Order::Speed(4.0), after(start, 2000));
        assert_eq!(deck.tick(after(start, 2500)), Go::On(3 * S));
        deck.obey(&Order::Play(false), after(start, 2500));
        assert_eq!(deck.position(after(start, 60_000)), 3 * S);
    }

    #[test]
    fn the_range_is_played_once_or_again_and_again() {
        let start = Instant::now();
        let mut deck = Deck::new(10 * S, 1.0, start);
        deck.obey(&Order::Range(Some([5.0, 3.0])), start);
        assert_eq!(deck.range(), [3 * S, 5 * S]);
        assert_eq!(deck.obey(&Order::Seek(4.0), start), Go::To(4 * S));
        deck.obey(&Order::Play(true), start);
        assert_eq!(deck.tick(after(start, 1500)), Go::On(5 * S));
        assert!(!deck.is_playing());
        assert_eq!(deck.obey(&Order::Play(true), after(start, 2000)), Go::To(3 * S));
        deck.obey(&Order::Loop(true), after(start, 2000));
        assert_eq!(deck.tick(after(start, 4000)), Go::To(3 * S));
        assert!(deck.is_playing());
        // Beyond the range, it plays to the end of the recording.
        deck.obey(&Order::Seek(9.0), after(start, 4000));
        assert_eq!(deck.tick(after(start, 4500)), Go::On(9_500_000));
    }

    #[test]
    fn nothing_leads_out_of_the_recording() {
        let start = Instant::now();
        let mut deck = Deck::new(10 * S, 1.0, start);
        assert_eq!(deck.obey(&Order::Seek(1e300), start), Go::To(10 * S));
        assert_eq!(deck.obey(&Order::Seek(-5.0), start), Go::To(0));
        deck.obey(&Order::Range(Some([4.0, 4.0])), start);
        assert_eq!(deck.range(), [0, 10 * S]);
        deck.obey(&Order::Range(Some([4.0, 400.0])), start);
        assert_eq!(deck.range(), [4 * S, 10 * S]);
        deck.obey(&Order::Range(None), start);
        assert_eq!(deck.range(), [0, 10 * S]);
        deck.obey(&Order::Speed(1e9), start);
        assert_eq!(deck.message(start).speed, 64.0);
    }
}
