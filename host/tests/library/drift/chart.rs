//! Drift against touch: what is kept, what is lost, and where the board says that it is unsure.

use super::rig::{Trial, feel};
use taxel::sim::Course;
use taxel_core::garment::Garment;

/// Times in which a touch rises, s.
const RISES: [f64; 5] = [1.0, 5.0, 10.0, 20.0, 40.0];
/// Common drift, counts/s.
const RATES: [f64; 6] = [0.0, 1.0, 3.0, 10.0, 20.0, 60.0];

/// What becomes of a touch on a garment that drifts.
fn word(garment: Garment, (shape, force_n): (&str, f64), rate: f64, rise_s: f64) -> &'static str {
    let trial = Trial { common: Course { rate, way: 1_300.0 }, ..Trial::new(garment, 25.0) };
    let end = 12.0 + rise_s;
    let felt = feel(&trial.touched(shape, force_n, 12.0, rise_s, 10.0), end + 10.0);
    match felt.felt(end, end + 10.0) {
        _ if felt.unsure_s > 0.0 => "unsure",
        1.0 => "kept",
        _ => "lost",
    }
}

/// The chart of docs/bounds.md; what is promised is kept.
#[test]
fn what_is_kept_and_what_is_lost() {
    println!("drift, counts/s  a palm of 5 N on a mat rises in {RISES:?} s");
    for rate in RATES {
        let words = RISES.map(|rise_s| word(Garment::mat(), ("palm", 5.0), rate, rise_s));
        println!("{rate:15.1}  {}", words.map(|word| format!("{word:8}")).join(""));
        if rate <= 3.0 {
            assert_eq!(words[..3], ["kept"; 3], "{rate} counts/s");
        }
    }
}

/// A palm that covers most of a block of 4 x 16.
#[test]
fn what_is_kept_on_a_block() {
    println!("drift, counts/s  a palm of 40 N on a block rises in {RISES:?} s");
    for rate in RATES {
        let words = RISES.map(|rise_s| word(Garment::block(), ("palm", 40.0), rate, rise_s));
        println!("{rate:15.1}  {}", words.map(|word| format!("{word:8}")).join(""));
    }
}
