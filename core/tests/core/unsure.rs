//! "Baseline unsure" on the wire: named in the map of health, and no intention follows from it.

use crate::board::Bench;
use taxel_core::health::TaxelHealth;
use taxel_core::intent::Leading;
use taxel_core::scene::Scene;
use taxel_core::wire::{Ill, Report, Request};

/// Frames of 5 ms in a second.
const SECOND: u32 = 200;

/// What is told while all codes rise by so many counts per second, for so many seconds: unsure or not, by map of health, and
/// what leads.
fn told(rate: u32, seconds: u32) -> (Vec<bool>, Vec<Leading>) {
    let mut bench = Bench::new(Scene::shipped());
    let all: Vec<usize> = (0..64).collect();
    bench.press(&all, 200);
    bench.ask(&Request::Tare { frames: 16 });
    bench.ask(&Request::Start);
    let (mut unsure, mut led) = (Vec::new(), Vec::new());
    for frame in 0..seconds * SECOND {
        bench.press(&all, 200 + (rate * frame.saturating_sub(SECOND) / SECOND) as u16);
        bench.scan();
        bench.drain(usize::MAX, |report| match report {
            Report::HealthMap(map) => unsure.push(match map.taxels[..] {
                [] => false,
                [Ill { first: 0, count: 64, health: TaxelHealth::Unsure }] => true,
                _ => panic!("{map:?}"),
            }),
            Report::Intent(intent) if intent.leading != Leading::None => led.push(intent.leading),
            _ => {}
        });
    }
    (unsure, led)
}

#[test]
fn drift_that_is_no_longer_followed_surely_is_told_and_means_nothing() {
    let (unsure, led) = told(60, 20);
    assert!(unsure.contains(&true), "{unsure:?}");
    assert_eq!(led, []);
    let (unsure, led) = told(20, 20);
    assert!(!unsure.contains(&true) && led.is_empty(), "{unsure:?} {led:?}");
}
