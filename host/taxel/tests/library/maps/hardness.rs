//! Hard and soft objects are distinguished by the growth of force and area, through the whole pipeline.

use taxel::fcm::map::MapFile;
use taxel::json::Replay;
use taxel::sim::{Footprint, Shape};
use taxel_core::contact::Hardness;
use taxel_core::format::Micros;
use taxel_core::garment::Garment;
use taxel_core::intent::{IntentConfig, MapConfig};
use taxel_core::scene::Scene;

const SIDE: u16 = 24;
/// Pitch of panels without one.
const PITCH_MM: [f64; 2] = [10.0, 10.0];
const COUNTS_PER_NEWTON: f64 = 1000.0;
/// Greatest force, N, and the frames until it is reached.
const FORCE: f64 = 20.0;
const FRAMES: u32 = 30;

/// A map with one input: soft is kind, hard is a threat.
fn scene() -> Scene {
    let text = "name = \"feel\"\ntransfer = \"tanh\"\nlambda = 3\n[[concept]]\nname = \"hard\"\n[[concept]]\nname = \"kindness\"\n\
                [[concept]]\nname = \"threat\"\n\
                [[input]]\nconcept = \"hard\"\nsource = \"hardness\"\nrise = [1000, 4000]\nat = [-1, 1]\n\
                [[edge]]\nfrom = \"hard\"\nto = \"kindness\"\nweight = -1\n\
                [[edge]]\nfrom = \"hard\"\nto = \"threat\"\nweight = 1\n";
    let map: MapFile = crate::maps::files::map(text);
    let config: MapConfig = *map.to_config().unwrap();
    let mut scene = Scene { intent: Some(IntentConfig::new(config)), ..Scene::shipped() };
    scene.react.clear();
    scene
}

/// Results at the greatest force of an object pressed on a panel; `patch` is its size in mm at a force in N.
fn pressed(shape: Shape, patch: impl Fn(f64) -> [f64; 2]) -> (u32, String, Vec<f64>) {
    let mut replay = Replay::new(&Garment::recorded(SIDE, SIDE), &scene(), 4095).unwrap();
    let mut last = serde_json::Value::Null;
    for frame in 0..FRAMES + 10 {
        // Half a cosine, after two empty frames.
        let part = (f64::from(frame.saturating_sub(2)) / f64::from(FRAMES)).min(1.0);
        let newton = FORCE * (0.5 - 0.5 * (part * std::f64::consts::PI).cos());
        let footprint = Footprint::build(shape, patch(newton.max(1e-3)), 0.0, PITCH_MM);
        let middle = f32::from(SIDE) / 2.0;
        let codes: Vec<u16> = (0..SIDE * SIDE)
            .map(|taxel| {
                let (x, y) = (f32::from(taxel % SIDE) - middle, f32::from(taxel / SIDE) - middle);
                (f64::from(footprint.share(x, y)) * newton * COUNTS_PER_NEWTON).round().min(4095.0) as u16
            })
            .collect();
        last = replay.frame(&codes, Micros(u64::from(frame) * 5_128));
    }
    let cue = last["contacts"][0]["hardness"].as_u64().unwrap() as u32;
    let concepts =
        ["hard", "kindness", "threat"].map(|name| last["intent"]["concepts"][name].as_f64().unwrap());
    (cue, last["intent"]["leading"].as_str().unwrap().into(), concepts.to_vec())
}

/// Diameter of the Hertz patch, mm, of a ball with a radius of 60 mm and a combined modulus in kPa.
fn hertz(newton: f64, kpa: f64) -> [f64; 2] {
    let diameter = 2.0 * (3.0 * newton * 60.0 / (4.0 * kpa * 1e-3)).cbrt();
    [diameter.max(4.0); 2]
}

#[test]
fn soft_is_no_threat_and_hard_is_one() {
    let soft = pressed(Shape::Ball, |newton| hertz(newton, 20.0));
    let rubber = pressed(Shape::Ball, |newton| hertz(newton, 200.0));
    let hard = pressed(Shape::Plate, |_| [20.0, 20.0]);
    println!("counts per cm2: soft {}, rubber {}, a stamp {}", soft.0, rubber.0, hard.0);
    assert_eq!(
        [&soft, &rubber, &hard].map(|it| Hardness::of(it.0)),
        [Hardness::Soft, Hardness::Firm, Hardness::Hard]
    );
    assert_eq!((soft.1.as_str(), hard.1.as_str()), ("none", "threat"));
    assert_eq!((soft.2[0], hard.2[0]), (-1.0, 1.0));
    // On the ramp between its ends.
    let wanted = (f64::from(rubber.0) - 1_000.0) / 1_500.0 - 1.0;
    assert!((rubber.2[0] - wanted).abs() < 1e-4, "{} for {wanted}", rubber.2[0]);
}

#[test]
fn a_map_that_does_not_ask_is_not_reported() {
    let shipped = taxel_core::intent::Intent::<64>::build(&Scene::shipped().intent.unwrap()).unwrap();
    let asks = taxel_core::intent::Intent::<64>::build(&scene().intent.unwrap()).unwrap();
    assert_eq!((shipped.feels(), asks.feels()), (false, true));
}
