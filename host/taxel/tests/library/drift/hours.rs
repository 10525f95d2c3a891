//! Hours without a touch: drift, breath and noise.

use super::is_campaign;
use super::rig::{Trial, feel};
use taxel::sim::{Course, Patch};
use taxel_core::garment::Garment;

/// A chest that rises and falls by ten counts 18 times a minute.
const BREATH: Course = Course { rate: 6.0, way: 10.0 };

/// Ten parts, each an hour in the campaign, else 30 s; from 0.5 to 5 counts/s, at times 10.
#[test]
fn nothing_is_announced_in_hours_of_drift_breath_and_noise() {
    let (parts, seconds) = if is_campaign() { (10, 3_600.0) } else { (5, 30.0) };
    let garments = [Garment::reference(), Garment::block(), Garment::recorded(20, 27), Garment::mat()];
    let (mut felt_s, mut led) = (0.0, 0);
    for (part, garment) in (0..parts).zip(garments.iter().cycle()) {
        let rate = [0.5, -1.0, 2.0, 3.0, 10.0, -5.0][part % 6];
        let common = Course { rate, way: 200.0 + 100.0 * part as f64 };
        let mut trial = Trial { common, seed: part as u64, ..Trial::new(garment.clone(), 25.0) };
        let size = [f64::from(garment.panels[0].columns), f64::from(garment.panels[0].rows) / 2.0];
        trial.patches.push(Patch { panel: 0, at: [0.0; 2], size, edge: 4.0, course: BREATH });
        let felt = feel(&trial, seconds);
        felt_s += felt.course.iter().filter(|(.., contacts)| *contacts > 0).count() as f64 / trial.hz;
        led += felt.led.len();
        println!("part {part}, {}: {led} intentions, {felt_s:.0} s", garment.name);
    }
    let hours = parts as f64 * seconds / 3_600.0;
    println!("{hours:.2} hours of drift, breath and noise: {led} intentions, {felt_s:.0} s of contacts");
    assert_eq!((led, felt_s), (0, 0.0));
}

/// A garment just put on once announced a ghost, then a threat, after 21 s.
#[test]
fn two_and_three_counts_per_second_announce_nothing() {
    for (rate, hz) in [(2.0, 195.0), (3.0, 195.0), (-2.0, 25.0), (3.0, 25.0)] {
        let trial = Trial { common: Course { rate, way: 1_500.0 }, ..Trial::new(Garment::reference(), hz) };
        let seconds = if hz > 100.0 { 90.0 } else { 400.0 };
        let felt = feel(&trial, if is_campaign() { seconds } else { seconds / 2.0 });
        assert_eq!(felt.felt(0.0, f64::MAX), 0.0, "{rate} counts/s at {hz} Hz");
        assert!(felt.led.is_empty(), "{rate} counts/s at {hz} Hz: {:?}", felt.led);
    }
}
