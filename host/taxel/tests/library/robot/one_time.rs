//! Boards of a robot on one time: stamps by round trips over an hour, against a truth that the host does not see.
//!
//! Each board has a clock of its own (up to 50 ppm off, with a wander of 5 ppm) and a link of its own.

use crate::delays::{Delays, Link};
use crate::timed_line::{DriftingClock, EPOCH, TimedLine};
use std::time::Duration;
use taxel::client::Stamp;
use taxel::robot::{BoardContact, RobotMoments};
use taxel_core::garment::Rect;

const SECOND: f64 = 1e6;
/// Time from the start of a scan until its frame is read, us.
const LATE: f64 = 9_000.0;
/// Time for which clocks are looked at, s: the ordinary test, and a campaign.
const LONG_S: [f64; 2] = [1_200.0, 7_200.0];
/// Rate, wander, its period, time of the start, time between scans (us), link.
const BOARDS: [(f64, f64, f64, f64, f64, Link); 6] = [
    (50.0, 5.0, 600.0, -3.0, 5_120.0, Link::Serial),
    (-50.0, 5.0, 431.0, -900.0, 5_120.0, Link::Serial),
    (-50.0, 5.0, 333.0, -1.0, 2_500.0, Link::Usb),
    (12.0, -5.0, 600.0, -86_400.0, 20_000.0, Link::Usb),
    (50.0, -5.0, 517.0, -7.0, 5_120.0, Link::Network),
    (0.0, 5.0, 360.0, -3_000.0, 10_000.0, Link::Network),
];
/// Speed of the contacts, taxels/s.
const SPEED: f64 = 40.0;

fn seed() -> u64 {
    std::env::var("TAXEL_SEED").map_or(1, |seed| seed.parse().unwrap())
}

fn lines() -> Vec<TimedLine> {
    let line = |(number, (ppm, wander_ppm, period_s, boot_s, _, link)): (u64, _)| {
        let clock = DriftingClock { ppm, wander_ppm, period_s, booted: boot_s * SECOND };
        TimedLine::new(clock, Delays::of(link, 100 * seed() + number))
    };
    (0..).zip(BOARDS).map(line).collect()
}

/// Where the contact of a board is at a time: `x`, taxels. It goes to and fro.
fn place(now: f64) -> f64 {
    let way = now / SECOND * SPEED % 60.0;
    1.0 + if way < 30.0 { way } else { 60.0 - way }
}

fn contact(now: f64) -> BoardContact {
    BoardContact {
        id: 1,
        panel: 0,
        total: 1000,
        peak: 100,
        area: 10,
        bounds: Rect { panel: 0, top: 0, bottom: 3, left: 0, right: 3 },
        centroid: [place(now), 2.0],
        velocity: [SPEED, 0.0],
        newtons_per_count: None,
    }
}

fn quantile(values: &mut [f64], part: f64) -> f64 {
    values.sort_by(f64::total_cmp);
    values[((values.len() - 1) as f64 * part) as usize]
}

#[test]
fn boards_are_on_one_time_within_what_they_state() {
    let long_s = LONG_S[usize::from(std::env::var_os("TAXEL_CAMPAIGN").is_some())];
    let mut lines = lines();
    let mut next = BOARDS.map(|(.., period, _)| period);
    let mut moments = RobotMoments::new(BOARDS.len(), Duration::from_millis(500));
    let (mut skews, mut stated, mut places) = (Vec::new(), Vec::new(), Vec::new());
    // What each board is off, and states, in its last scan.
    let mut off = BOARDS.map(|_| None);
    loop {
        let (board, started) =
            next.iter().copied().enumerate().min_by(|(_, a), (_, b)| a.total_cmp(b)).unwrap();
        if started > long_s * SECOND {
            break;
        }
        next[board] += BOARDS[board].4;
        let line = &mut lines[board];
        line.poll(started + LATE);
        let board_time = line.clock.at(started);
        let Some(time) = line.client.host_time(board_time) else {
            assert!(started < SECOND, "board {board} has no host time yet after a second");
            continue;
        };
        let error = time.us as f64 - (EPOCH + started);
        let bound = time.uncertainty_us as f64;
        assert!(error.abs() <= bound, "board {board}, {started} us: {error} us off, stated {bound}");
        stated.push(bound);
        off[board] = Some((error, bound));
        for (other, bound_of_other) in
            off.iter().enumerate().filter(|(at, _)| *at != board).filter_map(|(_, off)| *off)
        {
            let skew = (error - other).abs();
            assert!(skew <= bound + bound_of_other);
            // Until the quick round trips of the first second are over, the bounds are those of a single one.
            if started > 2.0 * SECOND {
                skews.push(skew);
            }
        }
        let stamp =
            Stamp { board_us: board_time.0, host_us: time.us, uncertainty_us: Some(time.uncertainty_us) };
        moments.take(board, stamp, vec![contact(started)]);
        // All boards as they were 100 ms ago, on one time.
        if board == 0 && started > 2.0 * SECOND {
            let then = started - 100_000.0;
            for (number, (.., period_us, _)) in BOARDS.iter().enumerate() {
                let at = moments.contacts(number, (EPOCH + then) as u64).unwrap();
                let bound_us = at.stamp.uncertainty_us.unwrap() as f64;
                let error = (at.what[0].centroid[0] - place(then)).abs();
                // At the turning points half of the way between two scans is left out.
                let turns = period_us / SECOND * SPEED;
                assert!(error <= bound_us / SECOND * SPEED + turns, "board {number}: {error} taxels off");
                places.push(error);
            }
        }
    }
    let [p50, p99, worst] = [0.5, 0.99, 1.0].map(|part| quantile(&mut skews, part));
    let [width, widest] = [0.5, 0.99].map(|part| quantile(&mut stated, part));
    let [place, farthest] = [0.5, 0.99].map(|part| quantile(&mut places, part));
    println!(
        "{} boards, {long_s} s, {} pairs of scans: skew median {p50:.0} us, p99 {p99:.0}, largest {worst:.0}; stated by \
         a board: median {width:.0} us, p99 {widest:.0}; contacts at {SPEED} taxels/s: median {place:.3} taxels off, \
         p99 {farthest:.3}",
        BOARDS.len(),
        skews.len()
    );
    assert!(p99 <= 1_000.0, "p99 {p99} us");
}
