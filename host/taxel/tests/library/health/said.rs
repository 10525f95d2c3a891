//! Intentions announced because of faulty taxels before they are silenced.

use super::watched::{FRAME_S, TARE, TAXELS, WatchedBoard};
use std::collections::BTreeSet;
use taxel::files::scripts;
use taxel::sim::{Noisy, Script, Stuck};

/// Frames of the tare and those in which every taxel is judged.
const FRAMES: u32 = TARE as u32 + 200;

/// Intentions announced for an untouched garment in which this many taxels break at a time.
fn said(count: u32, from_s: f64, seed: u64, fault: impl Fn(u16, &mut Script)) -> BTreeSet<&'static str> {
    let mut script = scripts::parse("duration_s = 2", "faults.toml").unwrap();
    (script.seed, script.faults.from_s) = (seed, from_s);
    let mut rng = fastrand::Rng::with_seed(seed);
    (0..count).for_each(|_| fault(rng.u16(..TAXELS as u16), &mut script));
    let mut watched = WatchedBoard::new();
    watched.play(&script, FRAMES);
    watched.said
}

fn nothing() -> BTreeSet<&'static str> {
    BTreeSet::from(["none"])
}

#[test]
fn taxels_that_were_stuck_or_shorted_at_power_up_say_nothing() {
    for (seed, code) in [(1, 20), (2, 500), (3, 2000), (4, 4000), (5, 4095)] {
        let stuck = |taxel, script: &mut Script| script.faults.stuck.push(Stuck { taxel, code });
        assert_eq!(said(5, 0.0, seed, stuck), nothing(), "stuck at {code}");
    }
    assert_eq!(said(5, 0.0, 6, |taxel, script| script.faults.shorted.push(taxel)), nothing());
}

/// The noisier they are, the fewer may break at once: together, several look like a touch.
#[test]
fn noisy_taxels_say_nothing() {
    let kinds = [(5, 20.0), (5, 60.0), (1, 200.0)];
    for (seed, (count, counts)) in (1..=5).flat_map(|seed| kinds.map(|kind| (seed, kind))) {
        for from_s in [0.0, 30.0 * FRAME_S] {
            let noisy = |taxel, script: &mut Script| script.faults.noisy.push(Noisy { taxel, counts });
            assert_eq!(
                said(count, from_s, seed, noisy),
                nothing(),
                "{count}: {counts} counts from {from_s} s on"
            );
        }
    }
}
