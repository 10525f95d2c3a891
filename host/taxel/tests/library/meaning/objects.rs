//! What is laid down and rests is an object: seldom kind, and no attack. `TAXEL_CAMPAIGN=1`: 500 objects instead of
//! 60.

use crate::meaning::monotone::said;
use fastrand::Rng;
use taxel::files::scripts;
use taxel::sim::{Script, Shape, Size, Touch};
use taxel_core::garment::Garment;
use taxel_core::intent::Leading;

fn log_between(rng: &mut Rng, low: f64, high: f64) -> f64 {
    low * (high / low).powf(rng.f64())
}

/// A box, plate, ball or strap of 2 to 200 N that is laid down in 0.1 to 1 s and lies for 2 to 30 s.
fn object(seed: u64) -> Script {
    let mut rng = Rng::with_seed(0x6f62_6a00 + seed);
    let shape = [Shape::Box, Shape::Plate, Shape::Ball, Shape::Strap][rng.usize(..4)];
    let size = match shape {
        Shape::Ball => [log_between(&mut rng, 30.0, 140.0); 2],
        Shape::Strap => [log_between(&mut rng, 80.0, 180.0), log_between(&mut rng, 10.0, 50.0)],
        _ => [log_between(&mut rng, 40.0, 180.0), log_between(&mut rng, 30.0, 240.0)],
    };
    let panel = ["chest", "back", "left arm"][rng.usize(..3)];
    let text = format!("panel = \"{panel}\"\nshape = \"palm\"\nforce_n = 1\nstart_s = 0.4");
    let plain: Touch = toml::from_str(&text).expect("it is short");
    let touch = Touch {
        shape,
        size_mm: Some(Size::Both(size)),
        at: Some([4.0 + 8.0 * rng.f64(), 8.0 + 16.0 * rng.f64()]),
        angle_deg: 180.0 * rng.f64(),
        force_n: log_between(&mut rng, 2.0, 200.0),
        rise_s: log_between(&mut rng, 0.1, 1.0),
        hold_s: log_between(&mut rng, 2.0, 30.0),
        fall_s: log_between(&mut rng, 0.1, 0.5),
        ..plain
    };
    let mut script =
        scripts::parse(&format!("duration_s = {}", touch.end_s() + 1.0), "object.toml").expect("it is short");
    script.seed = seed + 1;
    (script.sensor.gain_spread, script.sensor.hysteresis) = (0.15 * rng.f64(), 0.2 * rng.f64());
    script.sensor.noise = 0.02 * rng.f64();
    script.touches = vec![touch];
    script
}

#[test]
fn what_lies_is_neither_kind_nor_an_attack() {
    let count = if std::env::var_os("TAXEL_CAMPAIGN").is_some() { 500 } else { 60 };
    let [mut kind, mut threats, mut attacks] = [0; 3];
    for seed in 0..count {
        let script = object(seed);
        let (said, _) = said(&script, &Garment::reference());
        let any = |of: Leading| usize::from(said.contains(&of));
        kind += any(Leading::Kindness);
        threats += any(Leading::Threat);
        attacks += any(Leading::Attack);
        if any(Leading::Kindness) + any(Leading::Attack) > 0 {
            println!("  {seed}: {said:?}: {:?}", script.touches[0]);
        }
    }
    println!("{count} objects: {kind} kindness, {threats} threats, {attacks} attacks");
    // A strap of 160 N that comes in 0.1 s fills its taxels first, and seems to have come at once.
    assert!(20 * kind <= count as usize && 200 * attacks <= count as usize);
}
