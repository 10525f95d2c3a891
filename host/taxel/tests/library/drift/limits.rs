//! Limits of tracked drift and of slow touches.

use super::is_campaign;
use super::rig::{Felt, Trial, feel, fine, garments};
use taxel::sim::{Course, Patch};
use taxel_core::garment::Garment;

fn is_silent(felt: &Felt) -> bool {
    felt.felt(0.0, f64::MAX) == 0.0 && felt.led.is_empty()
}

#[test]
fn twenty_counts_per_second_are_followed_on_every_garment_at_every_rate() {
    let rates: &[f64] = if is_campaign() { &[0.5, -3.0, 20.0, -20.0] } else { &[-3.0, 20.0] };
    for (garment, quickest) in garments().into_iter().chain([fine()]) {
        for hz in [25.0, quickest] {
            for &rate in rates {
                let felt = feel(&Trial::new(garment.clone(), hz).drifting(rate), 45.0);
                let felt_s: Vec<f64> =
                    felt.course.iter().filter(|(.., contacts)| *contacts > 0).map(|(t, ..)| *t).collect();
                assert!(
                    is_silent(&felt),
                    "{} at {hz} Hz, {rate} counts/s: from {:?} to {:?} s, {:?}",
                    garment.name,
                    felt_s.first(),
                    felt_s.last(),
                    felt.led
                );
            }
        }
    }
}

#[test]
fn random_drift_on_random_garments_begins_no_contact() {
    let seeds = if is_campaign() { 40 } else { 12 };
    for seed in 0..seeds {
        let mut random = fastrand::Rng::with_seed(seed);
        let (rows, columns) = (random.u16(4..40), random.u16(4..40));
        let rate = 40.0 * random.f64() - 20.0;
        let hz = 25.0 * 8f64.powf(random.f64());
        let trial = Trial { seed, ..Trial::new(Garment::recorded(rows, columns), hz) };
        let common = Course { rate, way: 200.0 + 600.0 * random.f64() };
        let felt = feel(&Trial { common, ..trial }, 60.0);
        assert!(is_silent(&felt), "seed {seed}: {rows} x {columns} at {hz} Hz, {common:?}: {:?}", felt.led);
    }
}

/// Reaction to 90 s of a patch that drifts at this rate, on two garments, one of them at two frame rates.
fn patched(rate: f64) -> Vec<(String, Felt)> {
    let drifts = |(garment, hz): (Garment, f64)| {
        let name = format!("{} at {hz} Hz", garment.name);
        let mut trial = Trial::new(garment, hz);
        let course = Course { rate, way: 300.0 };
        trial.patches.push(Patch { panel: 0, at: [9.0, 7.0], size: [8.0, 8.0], edge: 4.0, course });
        (name, feel(&trial, 90.0))
    };
    let garments = [(Garment::mat(), 25.0), (Garment::mat(), 195.0), (Garment::recorded(24, 27), 60.0)];
    garments.into_iter().map(drifts).collect()
}

#[test]
fn a_patch_is_followed_at_a_count_per_second() {
    for (name, felt) in patched(1.0) {
        assert!(is_silent(&felt), "{name}: {:?}", felt.led);
    }
}

/// A palm of 5 N that comes within ten seconds shows the same codes: the two cannot be distinguished.
#[test]
fn a_patch_at_five_counts_per_second_is_unsure_and_means_nothing() {
    for (name, felt) in patched(5.0) {
        let begins = felt.course.iter().find(|(.., contacts)| *contacts > 0).map(|(t, ..)| *t);
        let unsure = felt.unsure(0.0, 90.0);
        println!("{name}: contacts from {begins:?} s on, {:.0} % of their frames unsure", 100.0 * unsure);
        assert!(felt.led.is_empty(), "{name}: {:?}", felt.led);
        assert!(unsure > 0.95, "{name}");
    }
}

/// Share of a quick touch's pressure that a slow one shows at its end, on a drifting garment.
fn kept(garment: &Garment, hz: f64, (shape, force_n, rise_s): (&str, f64, f64), rate: f64) -> f64 {
    let at_rest = Trial::new(garment.clone(), hz);
    let quick = feel(&at_rest.clone().touched(shape, force_n, 2.0, 0.3, 6.0), 7.0).pressure(4.0, 7.0);
    let drifting = Trial { common: Course { rate, way: 1_300.0 }, ..at_rest };
    let end = 12.0 + rise_s;
    let slow = feel(&drifting.touched(shape, force_n, 12.0, rise_s, 20.0), end + 10.0);
    assert_eq!(slow.felt(end, end + 10.0), 1.0, "{} at {hz} Hz, {shape} at {rate} counts/s", garment.name);
    slow.pressure(end, end + 10.0) / quick
}

/// Asserts that a touch keeps at least half of its pressure at each of these frame rates and drift rates.
fn assert_kept(garment: &Garment, touch: (&str, f64, f64), cases: [(f64, f64); 3]) {
    for (hz, rate) in cases {
        let part = kept(garment, hz, touch, rate);
        println!("{} at {hz} Hz, {rate} counts/s: {:.0} % of its pressure", garment.name, 100.0 * part);
        assert!((0.5..1.3).contains(&part), "{part}");
    }
}

#[test]
fn a_fingertip_of_a_newton_that_rises_in_half_a_minute_is_kept() {
    for (garment, quickest) in garments() {
        let cases = [(25.0, 3.0), (25.0, -3.0), (quickest.min(400.0), 0.0)];
        assert_kept(&garment, ("finger", 1.0, 30.0), cases);
    }
}

#[test]
fn a_palm_of_five_newtons_that_rises_in_ten_seconds_is_kept() {
    for (garment, quickest) in garments().into_iter().filter(|(garment, _)| garment.name != "block-4x16") {
        assert_kept(&garment, ("palm", 5.0, 10.0), [(25.0, 3.0), (25.0, -3.0), (quickest, 0.0)]);
    }
}
