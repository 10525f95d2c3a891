//! Starts of the frames of the USB, as two boards notice them that are on one emulated host controller, each
//! by a clock of its own.

use super::{codes_of, streaming};
use crate::images::TAXELS;
use std::f64::consts::TAU;
use taxel_core::reflex::Agree;
use taxel_core::scene::Scene;
use taxel_core::wire::{Report, Request};
use taxel_suite::pattern::TouchPattern;

/// Number of the host's first frame.
const FIRST: u64 = 2_000;
/// Starts that are asked for, and scans between two of them.
const ASKED: usize = 60;
const SCANS: u32 = 7;

/// A board's clock beside the host's: fast by `ppm`, and by up to `wander` ppm more or less in the course of
/// `period` s; and what the board does meanwhile.
struct WanderingBoard {
    ppm: f64,
    wander: f64,
    period: f64,
    pattern: TouchPattern,
}

impl WanderingBoard {
    /// When a frame starts, us of the board, as the harness has it.
    fn start_of(&self, frame: u64) -> f64 {
        let host = frame as f64 * 1e3;
        let turn = self.wander * 1e-6 * self.period * 1e6 / TAU;
        host * (1.0 + self.ppm * 1e-6) + turn * (1.0 - (TAU * host / (self.period * 1e6)).cos())
    }

    /// How late it notices starts, us, and the most that it states of one.
    fn lateness(&self) -> (Vec<f64>, u16) {
        let WanderingBoard { ppm, wander, period, pattern } = self;
        let scene = Scene::shipped().interlaced(Agree::Two);
        let codes: Vec<u16> = (0..400).flat_map(|number| codes_of(*pattern, number)).collect();
        assert_eq!(codes.len() % TAXELS, 0);
        let frames = format!("{FIRST},{ppm},{wander},{period}");
        let (mut board, _) = streaming(&scene, &codes, &["--usb-frames", &frames, "--loop"], |_| {});
        let (mut due, mut token, mut late, mut stated) = (0, 0, Vec::new(), 0);
        while late.len() < ASKED {
            match board.receive().report() {
                Report::Frame(frame) if frame.frame >= due => {
                    board.ask(&Request::Sync { token });
                    (due, token) = (frame.frame + SCANS, token + 1);
                }
                Report::StartOfFrame(start) => {
                    let noticed = start.noticed.0 as f64;
                    // The last that began before it was noticed; the board's time has whole microseconds.
                    let frame = (noticed / 1e3) as u64 + 1;
                    let frame = (0..3).map(|back| frame - back).find(|it| self.start_of(*it) < noticed + 1.0);
                    let frame = frame.expect("one of the last three has begun");
                    assert_eq!(u64::from(start.number), (FIRST + frame) % 2_048);
                    let by = noticed - self.start_of(frame);
                    assert!(
                        (-1.0..=f64::from(start.late_us)).contains(&by),
                        "{by} us late, stated {}",
                        start.late_us
                    );
                    late.push(by);
                    stated = stated.max(start.late_us);
                }
                _ => {}
            }
        }
        board.end();
        assert!(token as usize <= ASKED + 3, "{token} questions for {ASKED} starts");
        (late, stated)
    }
}

#[test]
fn two_boards_notice_the_starts_of_frames_together() {
    let boards = [
        WanderingBoard { ppm: 50.0, wander: 5.0, period: 10.0, pattern: TouchPattern::Five },
        WanderingBoard { ppm: -50.0, wander: -5.0, period: 7.0, pattern: TouchPattern::Grid },
    ];
    let [(a, a_stated), (b, b_stated)] = boards.map(|board| board.lateness());
    let mut skews: Vec<f64> = a.iter().flat_map(|a| b.iter().map(move |b| (a - b).abs())).collect();
    skews.sort_by(f64::total_cmp);
    let [a, b] = [a, b].map(|late| late.into_iter().fold(0.0, f64::max));
    let (p99, stated) = (skews[skews.len() * 99 / 100], a_stated.max(b_stated));
    println!(
        "starts of frames: noticed {a:.1} and {b:.1} us late at most, stated {stated}; skew of two boards p99 {p99:.1} us"
    );
    assert!(p99 <= 100.0 && stated <= 10);
}
