//! Use of the time from scan to scan. The board has no clock of its own: work between two calls is charged by
//! the times of the calls.

use super::pace::Pace;
use crate::format::Micros;
use crate::wire::{Budget, Health};

/// Reports per second until the host asks for another rate.
const RATE_HZ: u16 = 1;

/// The board's activity since its last call.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Activity {
    /// Turns the codes of a scan into a percept.
    Process,
    /// Encodes a message and hands it to the link.
    Encode,
    /// Anything else, mostly waiting for the next scan.
    Else,
}

/// Account of the time of each frame.
pub(super) struct FrameBudget {
    pace: Pace,
    activity: Activity,
    since: Micros,
    /// Time since which a message has been waiting for room on the link.
    waiting: Option<Micros>,
    /// Frame being processed.
    frame: FrameCost,
    /// Largest times of the frames since the last report, and their number.
    dearest: FrameCost,
    frames: u16,
    /// Number of consecutive frames that began late.
    late: u8,
}

/// One of this many consecutive late frames gets its image all the same.
const SPARED: u8 = 16;

/// Times of a frame, us.
#[derive(Debug, Default, Clone, Copy)]
struct FrameCost {
    number: u32,
    time: Micros,
    scan: u32,
    process: u32,
    encode: u32,
    send: u32,
}

impl FrameBudget {
    /// An account without any frame.
    pub fn new() -> FrameBudget {
        let none = FrameCost::default();
        FrameBudget {
            pace: Pace::new(RATE_HZ),
            activity: Activity::Else,
            since: Micros(0),
            waiting: None,
            frame: none,
            dearest: none,
            frames: 0,
            late: 0,
        }
    }

    /// Sets the number of reports per second; 0: never, `u16::MAX`: for each frame.
    pub fn report(&mut self, hz: u16) {
        self.pace = Pace::new(hz);
        self.frames = 0;
    }

    /// Number and start of the last scan.
    pub fn last(&self) -> (u32, Micros) {
        (self.frame.number, self.frame.time)
    }

    /// End of the last scan.
    pub fn scanned(&self) -> Micros {
        Micros(self.frame.time.0.saturating_add(self.frame.scan.into()))
    }

    /// Charges the time until `now` to the present activity, and begins another. `rest`: the link has not
    /// taken all of the message in transmission.
    pub fn turn(&mut self, now: Micros, activity: Activity, rest: bool) {
        let passed = us(now, self.since);
        match self.activity {
            Activity::Process => self.frame.process = self.frame.process.saturating_add(passed),
            Activity::Encode => self.frame.encode = self.frame.encode.saturating_add(passed),
            Activity::Else => {}
        }
        (self.activity, self.since) = (activity, now);
        match (self.waiting, rest) {
            (None, true) => self.waiting = Some(now),
            (Some(since), false) => {
                self.frame.send = self.frame.send.saturating_add(us(now, since));
                self.waiting = None;
            }
            _ => {}
        }
    }

    /// Ends encoding: there was no message, and the time from here on is not charged.
    pub fn rest(&mut self) {
        self.activity = Activity::Else;
    }

    /// Begins the account of another frame and closes the previous one.
    pub fn begin(&mut self, now: Micros, number: u32, time: Micros, scan_us: u32) {
        if let Some(since) = &mut self.waiting {
            self.frame.send = self.frame.send.saturating_add(us(now, *since));
            *since = now;
        }
        let FrameCost { scan, process, encode, send, .. } = self.frame;
        let most = if self.frames == 0 { FrameCost::default() } else { self.dearest };
        self.dearest = FrameCost {
            scan: scan.max(most.scan),
            process: process.max(most.process),
            encode: encode.max(most.encode),
            send: send.max(most.send),
            ..self.frame
        };
        // The first call has no previous frame.
        self.frames = self.frames.saturating_add(u16::from(self.frame.number != 0));
        self.frame = FrameCost { number, time, scan: scan_us, ..FrameCost::default() };
        let late = us(now, self.scanned()) > scan_us / 2;
        self.late = if late { self.late.wrapping_add(1) } else { 0 };
    }

    /// True if processing of the present frame began more than half a scan after its scan had ended: with any
    /// more delay scans will be lost.
    pub fn is_late(&self) -> bool {
        !self.late.is_multiple_of(SPARED)
    }

    /// Returns the report on the frames since the last one, if it is due.
    pub fn due(&mut self, now: Micros, health: &Health) -> Option<Budget> {
        if self.frames == 0 || !self.pace.due(now) {
            return None;
        }
        let FrameCost { number, time, scan, process, encode, send } = self.dearest;
        Some(Budget {
            frame: number,
            time,
            frames: core::mem::take(&mut self.frames),
            scan_us: scan,
            process_us: process,
            encode_us: encode,
            send_us: send,
            overruns: health.overruns,
            thinned_frames: health.thinned_frames,
        })
    }

    /// Processing time of the last frame, us.
    pub fn process_us(&self) -> u32 {
        self.frame.process
    }
}

fn us(now: Micros, since: Micros) -> u32 {
    now.since(since).min(u32::MAX.into()) as u32
}

#[cfg(test)]
mod tests {
    use super::*;
    use heapless::Vec;

    #[test]
    fn each_time_is_charged_to_its_frame() {
        let mut ledger = FrameBudget::new();
        ledger.report(u16::MAX);
        let health = Health { overruns: 4, thinned_frames: 5, ..Health::default() };
        let mut budgets = Vec::<Budget, 4>::new();
        for (number, slow) in [(1, 0), (2, 900), (3, 0), (4, 0)] {
            let start = u64::from(number) * 5_120;
            let at = |us: u64| Micros(start + us);
            ledger.turn(at(0), Activity::Process, false);
            ledger.begin(at(0), number, Micros(start - 5_120), 5_100);
            budgets.extend(ledger.due(at(0), &health));
            ledger.turn(at(2_000 + slow), Activity::Encode, false);
            ledger.turn(at(2_300 + slow), Activity::Else, true);
            ledger.turn(at(2_800 + slow), Activity::Encode, false);
            ledger.turn(at(2_850 + slow), Activity::Else, number == 3);
        }
        let reported: Vec<_, 4> =
            budgets.iter().map(|b| (b.frame, b.frames, b.process_us, b.encode_us, b.send_us)).collect();
        assert_eq!(
            reported,
            [(1, 1, 2_000, 350, 500), (2, 1, 2_900, 350, 500), (3, 1, 2_000, 350, 500 + 2_270)]
        );
        assert_eq!((budgets[1].scan_us, budgets[1].overruns, budgets[1].thinned_frames), (5_100, 4, 5));
        assert_eq!((budgets[1].time, ledger.process_us()), (Micros(5_120), 2_000));
    }

    #[test]
    fn a_frame_is_late_by_half_a_scan() {
        let mut ledger = FrameBudget::new();
        let mut late = |number, by| {
            let start = Micros(u64::from(number) * 5_120);
            ledger.begin(Micros(start.0 + 5_120 + by), number, start, 5_120);
            ledger.is_late()
        };
        assert_eq!([0, 2_560, 2_561, 5_000, 0].map(|by| late(1, by)), [false, false, true, true, false]);
        let reported = (0..800).filter(|number| !late(*number, 4_000)).count();
        assert_eq!(reported, 50, "an image now and then");
    }

    #[test]
    fn a_report_of_many_frames_gives_the_dearest() {
        let mut ledger = FrameBudget::new();
        let mut budgets = Vec::<Budget, 4>::new();
        for number in 1..=400u32 {
            let start = Micros(u64::from(number) * 5_000);
            ledger.turn(start, Activity::Process, false);
            ledger.begin(start, number, start, 5_000);
            budgets.extend(ledger.due(start, &Health::default()));
            ledger.turn(Micros(start.0 + 1_000 + u64::from(number % 100)), Activity::Else, false);
        }
        let reported: Vec<_, 4> = budgets.iter().map(|b| (b.frames, b.process_us)).collect();
        assert_eq!(reported, [(1, 1_001), (198, 1_099), (200, 1_099)]);
    }
}
