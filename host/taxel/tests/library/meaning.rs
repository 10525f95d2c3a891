//! Intentions of simulated touches: 500 seeded variants of a pat and of a lash, and controls with the map's
//! reason.

pub mod family;
mod flicker;
mod garments;
mod judge;
mod monotone;
mod objects;
mod same;
pub mod scripted;
pub mod strangers;

use std::collections::BTreeSet;
use taxel::files::scripts;
use taxel::sim::{self, FRAME_PERIOD_US, Player, Script};
use taxel_core::capacity::TAXELS;
use taxel_core::fold::{JointAngle, Posture};
use taxel_core::format::{Code, Micros};
use taxel_core::garment::Layout;
use taxel_core::intent::{
    CONCEPTS, Felt, Intent, IntentConfig, IntentState, Leading, PRESS_PER_NEWTON, Touch, tactile,
};
use taxel_core::pipeline::{Pipeline, PipelineState};
use taxel_core::scene::Scene;

/// Least share of right answers, per cent.
const RIGHT: usize = 98;

/// Reaction to a script: every intention that led, in order, and the map's reason for the last one.
struct Course {
    led: Vec<Leading>,
    reason: String,
}

fn perceive(script: &Script) -> Course {
    let garment = scripts::garment(script).expect("a built-in scene has a garment");
    let layout = Layout::build(&garment, TAXELS, 4095).expect("it is checked");
    let pipeline = Pipeline::build(&Scene::shipped(), &layout).expect("the shipped scene fits");
    let mut state = Box::new(PipelineState::<TAXELS, { TAXELS / 2 }>::default());
    state.reset(&layout, false, 4095);
    state.condition.tare(script.tare_frames as u16);
    let mut player = Player::new(script, &garment).expect("the script is checked");
    let mut codes = vec![0u16; TAXELS];
    let mut course = Course { led: Vec::new(), reason: "nothing leads".into() };
    let frames = (script.duration_s * 1e6 / FRAME_PERIOD_US as f64) as u64 + 200;
    for frame in 0..frames {
        let start = frame * FRAME_PERIOD_US;
        player.frame(start, &mut codes);
        let codes: Vec<Code> = codes.iter().map(|code| Code(*code)).collect();
        let percept = pipeline.process(&mut *state, &layout, &codes, false, Micros(start), &mut ());
        let Some(meaning) = percept.meaning.filter(|meaning| meaning.changed).cloned() else { continue };
        course.led.push(meaning.leading);
        if let Some(why) = pipeline.intent().and_then(|intent| intent.why(state.intent())) {
            let names = pipeline.intent().expect("it is on").map().concepts();
            let parts = why
                .parts
                .iter()
                .map(|part| format!("{} {:+.2}", names[usize::from(part.from)], part.value.to_f64()));
            course.reason =
                format!("{} because {}", meaning.leading.as_str(), parts.collect::<Vec<_>>().join(", "));
        }
    }
    course
}

/// Asserts that `wanted` leads in nearly all variants, and nothing else. `TAXEL_CAMPAIGN=1`: of 500 instead of 150.
fn assert_right(scene: &str, wanted: Leading) {
    let variants = if std::env::var_os("TAXEL_CAMPAIGN").is_some() { 500 } else { 150 };
    let script = scripts::load(scene).expect("built in");
    let garment = scripts::garment(&script).expect("a built-in scene has a garment");
    let layout = Layout::build(&garment, 2048, 4095).expect("it ships");
    let mut wrong = Vec::new();
    for seed in 0..variants {
        let course = perceive(&sim::vary(&script, Some(&layout), seed));
        let led: BTreeSet<_> = course.led.iter().map(|leading| leading.as_str()).collect();
        let fine = led.contains(wanted.as_str()) && led.iter().all(|l| *l == "none" || *l == wanted.as_str());
        if !fine {
            wrong.push(format!("  seed {seed}: {led:?}; {}", course.reason));
        }
    }
    let right = variants as usize - wrong.len();
    println!("{scene}: {right} of {variants} lead to {}", wanted.as_str());
    wrong.iter().take(12).for_each(|line| println!("{line}"));
    assert!(right * 100 >= variants as usize * RIGHT);
}

#[test]
fn a_pat_is_kindness() {
    assert_right("pat", Leading::Kindness);
}

#[test]
fn a_lash_is_an_attack() {
    assert_right("lash", Leading::Attack);
}

#[test]
fn controls() {
    let pat = scripts::load("pat").expect("built in");
    let lash = scripts::load("lash").expect("built in");
    let hold = scripts::load("hold").expect("built in");
    let idle = scripts::load("idle").expect("built in");
    let force = |script: &Script| script.touches.iter().map(|t| t.force_n).fold(0.0, f64::max);
    let strong = sim::scale_force(&hold, force(&lash) / force(&hold));
    let cases = [
        ("the pat", perceive(&pat)),
        ("the lash", perceive(&lash)),
        ("the lash at 5 % of its force", perceive(&sim::scale_force(&lash, 0.05))),
        ("a hold at the lash's peak force", perceive(&strong)),
        ("an idle garment", perceive(&idle)),
        ("a pat at three times the rate", perceive(&sim::scale_rate(&pat, 3.0))),
    ];
    for (name, course) in &cases {
        let led: Vec<_> = course.led.iter().map(|leading| leading.as_str()).collect();
        println!(
            "{name}: {}; {}",
            if led.is_empty() { "none".into() } else { led.join(", ") },
            course.reason
        );
    }
    let led = |index: usize, leading| cases[index].1.led.contains(&leading);
    assert!(led(0, Leading::Kindness) && led(1, Leading::Attack));
    assert!(!led(2, Leading::Attack), "a lash without force is no attack");
    // Its slow rise passes through forces at which a palm is kind.
    let end = cases[3].1.led.iter().rev().find(|leading| **leading != Leading::None);
    assert!(
        !led(3, Leading::Attack) && end == Some(&Leading::Threat),
        "a strong hold is no blow, but a threat"
    );
    assert!(cases[4].1.led.is_empty(), "nothing touches an idle garment");
    assert!(!led(5, Leading::Attack), "quick pats are no blows");
}

/// A slap of 30 N and 60 ms, and 300 ms after it a palm of 3 N that strokes for 3 s; breadth and speed are
/// noisy.
#[test]
fn a_slap_then_stroking_is_an_attack_and_then_kindness_without_flicker() {
    let stage = Intent::<CONCEPTS>::build(&IntentConfig::new(tactile())).expect("the shipped map is whole");
    let touch = |newton: u32, mm: u32, duration_ms: u32, speed: u32| Touch {
        press: newton * PRESS_PER_NEWTON as u32,
        force: newton * PRESS_PER_NEWTON as u32,
        cover_mm2: 100 * mm,
        breadth: 10 * mm,
        friendliness: 40,
        duration_ms,
        speed,
        // A stroke goes on at 50 mm/s.
        way: [(speed.min(1) * duration_ms / 2) as i32, 0],
        // The stage computes the rest.
        ..Touch::default()
    };
    let mut latest = [0; 2];
    for seed in 0..100 {
        let mut random = fastrand::Rng::with_seed(seed);
        let mut state = IntentState::default();
        let mut led = Vec::new();
        for ms in (0..4_000).step_by(5) {
            let present = match ms {
                100..160 => Some(touch(30, random.u32(15..20), ms - 100, 0)),
                460..3_460 => Some(touch(3, random.u32(50..70), ms - 460, random.u32(300..900))),
                _ => None,
            };
            let mut felt = Felt::default();
            present.iter().for_each(|it| felt.add(0, it.force, 300, it.cover_mm2 as u16 / 100, 100, 40));
            let now = Micros(1000 * u64::from(ms));
            let meaning = stage.process(&mut state, present.as_slice(), &felt, &[], now);
            led.extend(meaning.filter(|m| m.changed).map(|m| (ms, m.leading)));
        }
        led.retain(|(_, leading)| *leading != Leading::None);
        let [(slap, Leading::Attack), (stroke, Leading::Kindness)] = led[..] else {
            panic!("seed {seed}: {led:?}");
        };
        latest = [latest[0].max(slap - 100), latest[1].max(stroke - 460)];
    }
    println!("attack at most {} ms after its onset, kindness {} ms", latest[0], latest[1]);
    // The onset delay is 30 ms; the slap counts for 600 ms after its end, and then a stroke shows itself by its way.
    assert!(latest[0] <= 40 && latest[1] <= 1_300, "{latest:?}");
}

/// A bending arm folds its own garment, without a touch.
#[test]
fn an_arm_that_bends_means_nothing() {
    let script = scripts::load("elbow").expect("built in");
    let garment = scripts::garment(&script).expect("it is a preset");
    let layout = Layout::build(&garment, TAXELS, 4095).expect("it is checked");
    let scene = Scene::shipped();
    let pipeline = Pipeline::build(&scene, &layout).expect("the shipped scene fits");
    let led = |is_posture_sent: bool| {
        let mut state = Box::new(PipelineState::<TAXELS, { TAXELS / 2 }>::default());
        state.reset(&layout, false, 4095);
        state.condition.tare(script.tare_frames as u16);
        let mut player = Player::new(&script, &garment).expect("the script is checked");
        let (mut codes, mut led) = (vec![0u16; TAXELS], BTreeSet::new());
        for start in (0..3_500_000).step_by(FRAME_PERIOD_US as usize) {
            let angle = script.posture(start as f64 / 1e6).map(|(_, angle)| (100.0 * angle) as i16);
            let joints = (0..).zip(angle).map(|(joint, centidegrees)| JointAngle { joint, centidegrees });
            if is_posture_sent {
                let posture = Posture { joints: joints.collect() };
                state
                    .condition
                    .posture_mut()
                    .accept(&posture, &scene.joints, Micros(start))
                    .expect("it is a joint of the scene");
            }
            player.frame(start, &mut codes);
            let codes: Vec<Code> = codes.iter().map(|code| Code(*code)).collect();
            let percept = pipeline.process(&mut *state, &layout, &codes, false, Micros(start), &mut ());
            led.extend(percept.meaning.map(|meaning| meaning.leading.as_str()));
        }
        led
    };
    assert_eq!(led(true), BTreeSet::from(["none"]));
    assert_eq!(led(false), BTreeSet::from(["none"]), "a fold is no hand, even if its posture is not sent");
}

/// Forty families of touches against a person's judgement. `TAXEL_CAMPAIGN=1`: five of each instead of one.
#[test]
fn families_are_understood() {
    let each = if std::env::var_os("TAXEL_CAMPAIGN").is_some() { 5 } else { 1 };
    judge::judge(&judge::table(each));
}
