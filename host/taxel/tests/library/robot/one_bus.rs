//! Boards on one USB host controller: on one time by the starts of its frames, against a truth that the host
//! does not see. Each board has a clock of its own, 50 ppm off at most with a wander of 5 ppm, and so has
//! each controller.

use crate::delays::{Delays, Link};
use crate::timed_line::{Controller, DriftingClock, EPOCH, TimedLine};
use taxel::client::Buses;
use taxel_core::format::Micros;
use taxel_core::wire::{Report, StartOfFrame, encode};

const SECOND: f64 = 1e6;
/// Time between two scans, and from the start of one until its frame is read, us.
const SCAN: f64 = 5_120.0;
const LATE: f64 = 9_000.0;
/// Time for which clocks are looked at, s: the ordinary test, and a campaign.
const LONG_S: [f64; 2] = [300.0, 7_200.0];
/// Rate and its wander in ppm, the wander's period and the time of the start in s.
const CLOCKS: [[f64; 4]; 6] = [
    [50.0, 5.0, 600.0, -3.0],
    [-50.0, 5.0, 431.0, -900.0],
    [12.0, -5.0, 333.0, -86_400.0],
    [-7.0, 5.0, 517.0, -1.0],
    [50.0, -5.0, 360.0, -7.0],
    [0.0, 5.0, 250.0, -3_000.0],
];

fn clock([ppm, wander_ppm, period_s, boot_s]: [f64; 4]) -> DriftingClock {
    DriftingClock { ppm, wander_ppm, period_s, booted: boot_s * SECOND }
}

/// A controller whose frame 0 began at this time, s. Boards state at most 10 us of its starts.
fn controller(ppm: f64, began_s: f64) -> Controller {
    Controller { clock: clock([ppm, 0.0, 600.0, began_s]), late_us: 10 }
}

/// A line for each of the clocks, on one of these controllers each.
fn lines(on: &[Option<Controller>]) -> Vec<TimedLine> {
    let buses = Buses::default();
    let line = |((number, clock_of), controller): ((u64, &[f64; 4]), &Option<Controller>)| {
        let mut line = TimedLine::new(clock(*clock_of), Delays::of(Link::Usb, 70 + number));
        line.controller = *controller;
        line.client.share(buses.clone());
        line
    };
    (0..).zip(&CLOCKS).zip(on).map(line).collect()
}

/// What the host's time of a scan is off, and states, us; none before it has one.
fn scan(line: &mut TimedLine, started: f64) -> Option<(f64, f64)> {
    line.poll(started + LATE);
    let time = line.client.host_time(line.clock.at(started))?;
    let (off, stated) = (time.us as f64 - (EPOCH + started), time.uncertainty_us as f64);
    assert!(off.abs() <= stated, "{started} us: {off} us off, stated {stated}");
    Some((off, stated))
}

fn quantile(values: &mut [f64], part: f64) -> f64 {
    values.sort_by(f64::total_cmp);
    values[((values.len() - 1) as f64 * part) as usize]
}

#[test]
fn boards_on_one_controller_are_on_one_time() {
    let long_s = LONG_S[usize::from(std::env::var_os("TAXEL_CAMPAIGN").is_some())];
    let (one, two) = (controller(30.0, -5_000.0), controller(-20.0, -77.7));
    let on = [Some(one), Some(one), Some(one), Some(two), Some(two), None];
    let mut lines = lines(&on);
    let (mut shared, mut apart, mut stated) = (Vec::new(), Vec::new(), Vec::new());
    let mut started = 0.0;
    while started < long_s * SECOND {
        started += SCAN;
        let found: Vec<_> = lines.iter_mut().map(|line| scan(line, started)).collect();
        // The rates are known after two seconds.
        if started < 4.0 * SECOND {
            continue;
        }
        let buses: Vec<_> = lines.iter().map(|line| line.client.bus()).collect();
        assert!(buses[0] == buses[1] && buses[1] == buses[2] && buses[3] == buses[4], "{buses:?}");
        assert!(buses[0] != buses[3] && buses[0].is_some() && buses[3].is_some() && buses[5].is_none());
        let off: Vec<_> = found.iter().map(|found| found.expect("it has a time").0).collect();
        shared.extend([off[0] - off[1], off[1] - off[2], off[0] - off[2], off[3] - off[4]].map(f64::abs));
        apart.push((off[0] - off[5]).abs());
        stated.extend(found.iter().take(5).flatten().map(|(_, stated)| *stated));
    }
    let [median, p99, most] = [0.5, 0.99, 1.0].map(|part| quantile(&mut shared, part));
    let [apart, widest] = [quantile(&mut apart, 0.99), quantile(&mut stated, 0.99)];
    println!(
        "{long_s} s, {} pairs of scans on one controller: skew median {median:.0} us, p99 {p99:.0}, largest {most:.0}; \
         with a board that is on none p99 {apart:.0}; stated p99 {widest:.0}",
        shared.len()
    );
    assert!(p99 <= 100.0, "p99 {p99} us");
}

#[test]
fn a_board_that_restarts_or_changes_the_port_finds_its_controller_again() {
    let (one, two) = (controller(30.0, -5_000.0), controller(-20.0, -77.7));
    let mut lines = lines(&[Some(one), Some(two), Some(one)]);
    let mut started = 0.0;
    for (until_s, changes, same) in
        [(10.0, 0, [false, true]), (20.0, 1, [false, true]), (40.0, 2, [true, false])]
    {
        match changes {
            1 => lines[2].restart(started),
            // The cable goes into another computer's port, the board's clock goes on.
            2 => lines[2].controller = Some(two),
            _ => {}
        }
        while started < until_s * SECOND {
            started += SCAN;
            lines.iter_mut().for_each(|line| _ = scan(line, started));
        }
        let buses = [0, 1, 2].map(|number: usize| lines[number].client.bus());
        assert_eq!([buses[2] == buses[1], buses[2] == buses[0]], same, "after {until_s} s: {buses:?}");
    }
}

/// The frames of two controllers may begin together by chance. What is stated then holds all the same.
#[test]
fn controllers_that_are_taken_for_one_break_no_bound() {
    for off_us in [5.0, 90.0, 300.0, 700.0] {
        let (one, two) = (controller(30.0, -5_000.0), controller(30.0, -5_000.0 + off_us * 1e-6));
        let mut lines = lines(&[Some(one), Some(two), Some(one), Some(two)]);
        let mut started = 0.0;
        while started < 60.0 * SECOND {
            started += SCAN;
            lines.iter_mut().for_each(|line| _ = scan(line, started));
        }
    }
}

/// A board may say anything of its frames and of its time.
#[test]
fn nonsense_of_a_board_does_no_harm() {
    let mut line = lines(&[Some(controller(30.0, -5_000.0))]).remove(0);
    let mut started = 0.0;
    while started < 3.0 * SECOND {
        started += SCAN;
        scan(&mut line, started);
    }
    let mut seq = 1_000;
    for (number, noticed) in
        (0..400).flat_map(|of: u64| [(of as u16 * 163, of << 55), (u16::MAX, u64::MAX - of), (0, of)])
    {
        seq += 1;
        let start = StartOfFrame { number, noticed: Micros(noticed), late_us: u16::MAX };
        let mut wire = [0; 64];
        let bytes = encode(&(seq, Report::StartOfFrame(start)), &mut wire).unwrap();
        bytes.iter().for_each(|byte| drop(line.client.push(*byte)));
        for time in [0, 1, noticed, u64::MAX] {
            let _ = (line.client.host_time(Micros(time)), line.client.board_time_at(time));
        }
    }
    assert!(line.client.bus().is_none_or(|bus| bus < 64), "{:?}", line.client.bus());
}
