//! Drift against touch: which touches are kept and which are lost.

use super::rig::{Trial, feel};
use taxel::sim::Course;
use taxel_core::garment::Garment;

/// Times in which a touch rises, s.
const RISES: [f64; 5] = [1.0, 5.0, 10.0, 20.0, 40.0];
/// Common drift, counts/s.
const RATES: [f64; 5] = [0.0, 1.0, 3.0, 5.0, 10.0];

/// Fate of a touch on a drifting garment.
fn word(garment: Garment, (shape, force_n): (&str, f64), rate: f64, rise_s: f64) -> &'static str {
    let trial = Trial { common: Course { rate, way: 1_300.0 }, ..Trial::new(garment, 25.0) };
    let end = 12.0 + rise_s;
    let felt = feel(&trial.touched(shape, force_n, 12.0, rise_s, 10.0), end + 10.0);
    match (felt.felt(end, end + 10.0), felt.unsure(end, end + 10.0)) {
        (1.0, 0.0) => "kept",
        (1.0, _) => "unsure",
        _ => "lost",
    }
}

/// A chart of docs/evidence/drift.md, for a palm; what rises within ten seconds at up to 3 counts/s is felt, and
/// unsure contacts are reported.
fn chart(garment: &Garment, force_n: f64) {
    println!("drift, counts/s  a palm of {force_n} N on {} rises in {RISES:?} s", garment.name);
    for rate in RATES {
        let words = RISES.map(|rise_s| word(garment.clone(), ("palm", force_n), rate, rise_s));
        println!("{rate:15.1}  {}", words.map(|word| format!("{word:8}")).join(""));
        if rate <= 3.0 {
            assert!(!words[..3].contains(&"lost"), "{} at {rate} counts/s: {words:?}", garment.name);
        }
    }
}

#[test]
fn what_is_kept_and_what_is_lost() {
    chart(&Garment::mat(), 5.0);
}

/// It covers most of a block of 4 x 16.
#[test]
fn what_is_kept_on_a_block() {
    chart(&Garment::block(), 40.0);
}
