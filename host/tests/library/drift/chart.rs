//! Drift against touch: what is kept, what is lost, and where the board says that it is unsure.

use super::rig::{Trial, feel};
use taxel::sim::Course;
use taxel_core::garment::Garment;

/// Times in which a palm of 5 N rises, s.
const RISES: [f64; 5] = [1.0, 5.0, 10.0, 20.0, 40.0];

/// What becomes of a palm on a mat that drifts.
fn word(rate: f64, rise_s: f64) -> &'static str {
    let trial = Trial { common: Course { rate, way: 1_300.0 }, ..Trial::new(Garment::mat(), 25.0) };
    let end = 12.0 + rise_s;
    let felt = feel(&trial.touched("palm", 5.0, 12.0, rise_s, 10.0), end + 10.0);
    match felt.felt(end, end + 10.0) {
        _ if felt.unsure_s > 0.0 => "unsure",
        1.0 => "kept",
        _ => "lost",
    }
}

/// The table of docs/bounds.md; what is promised is kept.
#[test]
fn what_is_kept_and_what_is_lost() {
    println!("drift, counts/s  a palm of 5 N rises in {RISES:?} s");
    for rate in [0.0, 1.0, 3.0, 10.0, 20.0] {
        let words = RISES.map(|rise_s| word(rate, rise_s));
        println!("{rate:15.1}  {}", words.map(|word| format!("{word:8}")).join(""));
        if rate <= 3.0 {
            assert_eq!(words[..3], ["kept"; 3], "{rate} counts/s");
        }
    }
}
