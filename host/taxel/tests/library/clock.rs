//! The host's time of a board's frames over an hour, against a simulated truth that the client does not see.
//!
//! The board's clock runs 50 ppm fast, and wanders by 5 ppm with a period of ten minutes, as with the
//! temperature of a room (0.052 ppm/s at most), on a serial link.

use super::delays::{Delays, Link};
use super::timed_line::{DriftingClock, EPOCH, TimedLine};
use taxel_core::format::Micros;

const SECOND: f64 = 1e6;
/// Time between two frames, us.
const FRAME: f64 = 5_120.0;
/// Time from the start of a scan until its frame is read, us.
const LATE: f64 = 9_000.0;

fn line() -> TimedLine {
    let clock = DriftingClock { ppm: 50.0, wander_ppm: 5.0, period_s: 600.0, booted: -3.0 * SECOND };
    TimedLine::new(clock, Delays::of(Link::Serial, 8))
}

fn quantile(values: &mut [f64], part: f64) -> f64 {
    values.sort_by(f64::total_cmp);
    values[((values.len() - 1) as f64 * part) as usize]
}

#[test]
fn an_hour_of_frames_has_the_right_host_time() {
    let mut line = line();
    let (mut errors, mut stated) = (Vec::new(), Vec::new());
    for frame in 0..(3_600.0 * SECOND / FRAME) as u32 {
        let started = f64::from(frame) * FRAME;
        line.poll(started + LATE);
        let Some(time) = line.client.host_time(line.clock.at(started)) else {
            assert!(started < SECOND, "no host time yet after a second");
            continue;
        };
        let error = (time.us as f64 - (EPOCH + started)).abs();
        assert!(error <= time.uncertainty_us as f64, "frame {frame}: {error} us off, stated {time:?}");
        errors.push(error);
        stated.push(time.uncertainty_us as f64);
    }
    let (p50, p99) = (quantile(&mut errors, 0.5), quantile(&mut errors, 0.99));
    let (width, widest) = (quantile(&mut stated, 0.5), quantile(&mut stated, 0.99));
    println!("{} frames: {p50:.0} us off, p99 {p99:.0}; stated {width:.0}, p99 {widest:.0}", errors.len());
    assert!(p99 <= 1_000.0, "p99 {p99} us");
    assert!(width <= 1_000.0, "stated {width} us");
}

#[test]
fn after_a_restart_of_the_board_its_time_is_learnt_anew() {
    let mut line = line();
    for step in 0..2_000 {
        line.poll(f64::from(step) * FRAME);
    }
    let now = 2_000.0 * FRAME;
    line.restart(now);
    line.poll(now + 2_500.0);
    assert_eq!(line.client.counts().restarts, 1);
    assert_eq!(line.client.host_time(Micros(1_000)), None, "the old clock holds no more");
    for step in 1..400 {
        line.poll(now + f64::from(step) * FRAME);
    }
    let then = now + 300.0 * FRAME;
    let time = line.client.host_time(line.clock.at(then)).unwrap();
    let error = (time.us as f64 - (EPOCH + then)).abs();
    assert!(error <= time.uncertainty_us as f64 && time.uncertainty_us < 5_000, "{error} us off, {time:?}");
}
