//! Long scans and self-tests feed the watchdog in time.

use std::cell::Cell;
use taxel::files::scripts;
use taxel::sim::{PINS, SimBoard, SimClock};
use taxel_core::acquire::{Acquire, Clock, Depth, LONGEST_MS, MuxScan, Plan, check_duration};
use taxel_core::capacity::TAXELS;
use taxel_core::format::Micros;
use taxel_core::garment::{Circuit, Garment, Layout, Pins};
use taxel_core::run::block_on;
use taxel_core::selftest::Examine;

/// Longest time without progress, us: a twentieth of a frame's limit.
const LONGEST_STEP_US: u64 = 50 * LONGEST_MS as u64;

/// A clock that records progress.
struct Watched {
    clock: SimClock,
    fed: Cell<Micros>,
    longest_us: Cell<u64>,
}

impl Clock for Watched {
    fn now(&self) -> Micros {
        self.clock.now()
    }

    fn progressed(&self) {
        let since = self.now().since(self.fed.replace(self.now()));
        self.longest_us.set(self.longest_us.get().max(since));
    }
}

/// Duration, and the longest time without progress, us.
fn watched(watched: &Watched, act: impl FnOnce()) -> (u64, u64) {
    let begun = watched.now();
    watched.fed.set(begun);
    watched.longest_us.set(0);
    act();
    // The time since the last progress.
    watched.progressed();
    (watched.now().since(begun), watched.longest_us.get())
}

#[test]
fn the_longest_scans_and_self_tests_feed_the_watchdog_as_they_go() {
    for (settle_ns, depth) in [(900_000, Depth::Twelve), (100_000, Depth::MeanOf8), (3_000, Depth::Twelve)] {
        let mut garment = Garment::reference();
        garment.wiring.settle_ns = settle_ns;
        let layout = Layout::build(&garment, TAXELS, 4095).unwrap();
        let circuit = Circuit::build(&garment, &layout, Pins::FEATHER).unwrap();
        let plan = Plan { depth, ..Plan::default() };
        check_duration(&circuit, &plan).unwrap();
        let script = scripts::parse("duration_s = 1", "rest.toml").unwrap();
        let SimBoard { mut lines, delay, adc, clock, .. } = SimBoard::new(&garment, &script, 1).unwrap();
        let watch = Watched { clock, fed: Cell::new(Micros(0)), longest_us: Cell::new(0) };
        let mut scan = MuxScan::<_, _, _, _, PINS, TAXELS>::new(&mut lines, delay, adc, &watch);
        let (frame_us, step_us) = watched(&watch, || {
            block_on(scan.scan(&circuit, &plan)).unwrap();
        });
        let (test_us, part_us) = watched(&watch, || {
            scan.examine(&circuit).unwrap();
        });
        println!(
            "{settle_ns} ns: frame {frame_us} us, step {step_us}; self-test {test_us} us, step {part_us}"
        );
        assert!(step_us <= LONGEST_STEP_US && part_us <= LONGEST_STEP_US, "{step_us}, {part_us}");
        assert!(step_us < frame_us / 8, "a step is a small part of a frame");
    }
}
