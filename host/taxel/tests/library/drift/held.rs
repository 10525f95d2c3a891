//! Touches held while the garment drifts, and touches that cover most of a small one.

use super::is_campaign;
use super::rig::{Trial, feel, fine, garments};
use taxel::sim::Course;
use taxel_core::garment::Garment;

/// The touch: 3 N of a fingertip, counts.
const TOUCH: f64 = 3_000.0;

/// Pressure at the end of a touch held for this long from 30 s on, at this drift, as a share of the touch's.
/// 30 s of drift show each taxel's share of it.
fn left(trial: &Trial, course: Course, seconds: f64) -> f64 {
    let end = 30.3 + seconds;
    let trial = Trial { common: course, ..trial.clone() }.touched("finger", 3.0, 30.0, 0.3, seconds + 5.0);
    let felt = feel(&trial, end);
    let [first, last] = [felt.pressure(31.0, 36.0), felt.pressure(end - 6.0, end)];
    println!(
        "{}: {} counts/s: {first:.0} counts, {seconds:.0} s later {last:.0}",
        trial.garment.name, course.rate
    );
    assert_eq!((felt.felt(0.0, 30.0), felt.felt(30.5, end)), (0.0, 1.0), "{}", trial.garment.name);
    last / TOUCH
}

#[test]
fn a_touch_is_held_for_a_minute_at_a_count_per_second() {
    for (garment, _) in garments() {
        let trial = Trial::new(garment, 50.0);
        let part = left(&trial, Course { rate: 1.0, way: 1_900.0 }, 60.0);
        assert!((0.7..1.3).contains(&part), "{part}");
    }
}

/// Each taxel under it drifts by up to 600 counts more or less than its panel, which cannot be measured; its
/// surroundings do not join it. In the second case the drift turns at the moment the touch begins.
#[test]
fn a_touch_is_held_for_a_minute_at_twenty_counts_per_second() {
    for (garment, quickest) in garments() {
        for (hz, way) in [(quickest.min(400.0), 1_200.0), (25.0, 600.0)] {
            let part = left(&Trial::new(garment.clone(), hz), Course { rate: 20.0, way }, 60.0);
            assert!((0.8..1.2).contains(&part), "{part}");
        }
    }
}

/// Where the drift goes far, each taxel under the touch ends up to 450 counts off its panel, which cannot be
/// measured. Its surroundings follow their own drift and do not join it.
#[test]
fn a_touch_is_held_for_an_hour_at_half_a_count_per_second() {
    for garment in [Garment::block(), Garment::recorded(12, 12)] {
        for (way, seeds) in if is_campaign() { [(60.0, 8), (900.0, 24)] } else { [(60.0, 1), (900.0, 1)] } {
            let part = |seed| {
                let trial = Trial { seed, ..Trial::new(garment.clone(), 25.0) };
                left(&trial, Course { rate: 0.5, way }, 3_600.0)
            };
            let parts: Vec<f64> = (0..seeds).map(part).collect();
            assert!(parts.iter().all(|part| (0.8..1.1).contains(part)), "over {way} counts: {parts:.2?}");
        }
    }
}

/// Four rows at 1,562 frames per second: which touches are lost, or never noticed.
#[test]
fn a_block_at_full_speed_feels_what_covers_most_of_it() {
    for (shape, force_n, rise_s, hold_s) in [
        ("palm", 10.0, 0.3, 2.5),
        ("palm", 5.0, 0.3, 2.5),
        ("finger", 1.0, 1.5, 5.0),
        ("palm", 10.0, 0.3, 20.0),
    ] {
        let trial = Trial::new(Garment::block(), 1_562.0).touched(shape, force_n, 3.0, rise_s, hold_s);
        let felt = feel(&trial, 3.0 + rise_s + hold_s);
        let all = felt.felt(3.0 + rise_s, 3.0 + rise_s + hold_s);
        assert_eq!(all, 1.0, "{shape} of {force_n} N within {rise_s} s");
    }
}

/// Ten minutes of a palm on garments at rest and in slow drift, or one of them in the check.
#[test]
fn a_palm_is_held_as_one_contact_for_minutes() {
    let seconds = if is_campaign() { 600.0 } else { 60.0 };
    for (garment, _) in garments().into_iter().chain([fine()]) {
        for (rate, most) in [(0.0, 0.11), (1.0, if is_campaign() { 0.65 } else { 0.1 })] {
            let common = Course { rate, way: 500.0 };
            let trial = Trial { noise: 3.9, common, ..Trial::new(garment.clone(), 25.0) };
            let end = 30.3 + seconds;
            let felt = feel(&trial.touched("palm", 10.0, 30.0, 0.3, seconds), end + 8.0);
            let first = felt.pressure(32.0, 37.0);
            let worst = (0..10)
                .map(|part| end - seconds + 2.0 + (seconds - 2.0) * f64::from(part) / 10.0)
                .map(|from| (felt.pressure(from, from + (seconds - 2.0) / 10.0) / first - 1.0).abs())
                .fold(0.0, f64::max);
            let name = &garment.name;
            println!("{name}, {rate} counts/s: {first:.0} counts, then up to {:.0} % off", 100.0 * worst);
            assert!(worst <= most, "{name} at {rate} counts/s: {worst}");
            assert_eq!(felt.felt(30.5, end), 1.0, "{name}");
            if rate == 0.0 {
                assert_eq!((felt.ids.len(), felt.unsure(30.5, end)), (1, 0.0), "{name}");
                assert_eq!(felt.felt(end + 0.8, end + 8.0), 0.0, "{name}");
            }
        }
    }
}

/// A garment of two panels: what one palm covers grew by drift, until both panels were one contact.
#[test]
fn a_held_contact_does_not_grow_by_drift() {
    for rate in [10.0, 20.0] {
        let common = Course { rate, way: 500.0 };
        let trial = Trial { noise: 3.9, common, ..Trial::new(Garment::reference(), 25.0) };
        let seconds = if is_campaign() { 300.0 } else { 90.0 };
        let felt = feel(&trial.touched("palm", 10.0, 30.0, 0.3, seconds), 30.3 + seconds);
        let first = felt.pressure(32.0, 37.0);
        let most =
            felt.course.iter().filter(|(t, ..)| *t > 37.0).map(|(_, total, _)| *total).fold(0.0, f64::max);
        println!("{rate} counts/s: {first:.0} counts, then at most {most:.0}");
        assert!(most <= 2.0 * first, "{rate} counts/s: {first}, then {most}");
    }
}
