//! Variants of a script: the same deed by another hand, on another garment of its kind.

use fastrand::Rng;
use taxel::sim::{Script, Size, scale_force, scale_rate};

/// Variant of a script: forces and times by a factor of 0.8 to 1.25 each, sizes by up to 15 %, places by up to 1.5
/// taxels; a garment with gains that differ by 15 %, a hysteresis of 20 % and a noise of 2 %.
pub fn varied(script: &Script, seed: u64) -> Script {
    let mut rng = Rng::with_seed(seed);
    let octaves = |rng: &mut Rng, most: f64| (most * (2.0 * rng.f64() - 1.0)).exp();
    let quarter = 1.25f64.ln();
    let mut script = scale_force(script, octaves(&mut rng, quarter));
    script = scale_rate(&script, octaves(&mut rng, quarter));
    let (size, shift) = (octaves(&mut rng, 1.15f64.ln()), [0; 2].map(|_| 3.0 * rng.f64() - 1.5));
    for touch in &mut script.touches {
        let [length, width] = touch.size().map(|mm| (mm * size).max(1.0));
        touch.size_mm = Some(Size::Both([length, width]));
        // Places in mm move by the pitch of the reference garment.
        touch.at = touch.at.map(|at| [at[0] + shift[0], at[1] + shift[1]]);
        touch.at_mm = touch.at_mm.map(|at| [at[0] + 12.0 * shift[0], at[1] + 10.0 * shift[1]]);
    }
    script.seed = rng.u64(1..1 << 40);
    (script.sensor.gain_spread, script.sensor.hysteresis, script.sensor.noise) = (0.15, 0.2, 0.02);
    script
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn variants_differ_and_can_be_made_again() {
        let script = taxel::files::scripts::load("pat").unwrap();
        let forces: Vec<f64> = (0..20).map(|seed| varied(&script, seed).touches[0].force_n).collect();
        let force = script.touches[0].force_n;
        assert!(forces.iter().all(|it| (0.799..=1.251).contains(&(it / force))));
        assert!(forces.iter().any(|it| *it > 1.1 * force) && forces.iter().any(|it| *it < 0.9 * force));
        assert_eq!(varied(&script, 3), varied(&script, 3));
        varied(&script, 3).check().unwrap();
    }
}
