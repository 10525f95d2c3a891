//! What is harder, faster or more pointed is never judged milder. `TAXEL_CAMPAIGN=1`: 10,000 pairs instead of 150.

use fastrand::Rng;
use std::sync::atomic::{AtomicU64, Ordering};
use std::thread;
use taxel::files::scripts;
use taxel::sim::{FRAME_PERIOD_US, Player, Script, Shape, Size, Touch};
use taxel_core::capacity::TAXELS;
use taxel_core::format::{Code, Micros};
use taxel_core::garment::{Garment, Layout};
use taxel_core::intent::Leading;
use taxel_core::pipeline::{Pipeline, PipelineState};
use taxel_core::scene::Scene;

/// By how much one touch of a pair is harder, faster or more pointed than the other.
const FACTOR: f64 = 1.25;

/// The chest of the reference garment, which is played four times as fast as the whole.
fn small() -> Garment {
    let mut garment = Garment::reference();
    garment.panels.truncate(1);
    garment.blocks.retain(|block| block.panel == 0);
    garment.seams.clear();
    garment
}

/// The gravest word for a touch.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Word {
    /// Kindness, or none.
    Mild,
    /// None, and a taxel was full.
    Unclear,
    Threat,
    Attack,
}

/// Every intention that is announced for a script on a garment, and whether a taxel was full meanwhile.
pub fn said(script: &Script, garment: &Garment) -> (Vec<Leading>, bool) {
    let layout = Layout::build(garment, TAXELS, 4095).expect("the garment is good");
    let pipeline = Pipeline::build(&Scene::shipped(), &layout).expect("the shipped scene fits");
    let map = pipeline.intent().expect("it is on").map();
    let unclear = map.find("unclear").expect("the shipped map has it");
    let mut state = Box::new(PipelineState::<TAXELS, { TAXELS / 2 }>::default());
    state.reset(&layout, false, 4095);
    state.condition.tare(script.tare_frames as u16);
    let mut player = Player::new(script, garment).expect("the script is checked");
    let mut codes = vec![0u16; layout.taxels()];
    let (mut said, mut full) = (Vec::new(), false);
    for start in (0..(script.duration_s * 1e6) as u64).step_by(FRAME_PERIOD_US as usize) {
        player.frame(start, &mut codes);
        let codes: Vec<Code> = codes.iter().map(|code| Code(*code)).collect();
        let percept = pipeline.process(&mut *state, &layout, &codes, false, Micros(start), &mut ());
        let Some(meaning) = percept.meaning else { continue };
        full |= meaning.activations[unclear].to_f64() >= 0.5;
        said.extend(Some(meaning.leading).filter(|_| meaning.changed));
    }
    (said, full)
}

/// The gravest word, and whether a taxel was full.
fn word(touch: &Touch, garment: &Garment) -> (Word, bool) {
    let mut script =
        scripts::parse(&format!("duration_s = {}", touch.end_s() + 0.8), "pair.toml").expect("it is short");
    (script.idle.noise_counts, script.idle.spread_counts) = (0.0, 0.0);
    script.touches = vec![touch.clone()];
    let (said, full) = said(&script, garment);
    let word = match said {
        said if said.contains(&Leading::Attack) => Word::Attack,
        said if said.contains(&Leading::Threat) => Word::Threat,
        _ if full => Word::Unclear,
        _ => Word::Mild,
    };
    (word, full)
}

fn log_between(rng: &mut Rng, low: f64, high: f64) -> f64 {
    low * (high / low).powf(rng.f64())
}

/// A touch on the middle of the panel.
fn touch(rng: &mut Rng) -> Touch {
    let shape =
        [Shape::Palm, Shape::Strap, Shape::Box, Shape::Plate, Shape::Finger, Shape::Ball][rng.usize(..6)];
    let size = match shape {
        Shape::Finger => [log_between(rng, 6.0, 30.0); 2],
        Shape::Ball => [log_between(rng, 30.0, 110.0); 2],
        Shape::Strap => [log_between(rng, 60.0, 150.0), log_between(rng, 8.0, 50.0)],
        _ => [log_between(rng, 40.0, 150.0), log_between(rng, 30.0, 110.0)],
    };
    let text = "panel = \"chest\"\nshape = \"palm\"\nforce_n = 1\nstart_s = 0.3";
    let plain: Touch = toml::from_str(text).expect("it is short");
    Touch {
        shape,
        size_mm: Some(Size::Both(size)),
        at: Some([7.5 + rng.f64(), 15.5 + rng.f64()]),
        angle_deg: 180.0 * rng.f64(),
        force_n: log_between(rng, 0.5, 300.0),
        rise_s: log_between(rng, 0.006, 0.6),
        hold_s: log_between(rng, 0.01, 1.0),
        fall_s: log_between(rng, 0.01, 0.3),
        ..plain
    }
}

#[test]
fn what_is_harder_faster_or_more_pointed_is_never_milder() {
    let pairs = if std::env::var_os("TAXEL_CAMPAIGN").is_some() { 10_000 } else { 150 };
    let (next, garment) = (AtomicU64::new(0), small());
    let judged = |seed: u64| {
        let mut rng = Rng::with_seed(0x6d6f_6e6f ^ seed);
        let less = touch(&mut rng);
        let (how, more) = match seed % 3 {
            0 => ("harder", Touch { force_n: FACTOR * less.force_n, ..less.clone() }),
            1 => {
                // It lasts as long as the other.
                let rise_s = less.rise_s / FACTOR;
                let hold_s = less.hold_s + less.rise_s - rise_s;
                ("faster", Touch { rise_s, hold_s, ..less.clone() })
            }
            _ => {
                let size = Size::Both(less.size().map(|mm| mm / FACTOR.sqrt()));
                ("more pointed", Touch { size_mm: Some(size), ..less.clone() })
            }
        };
        let [(of_less, _), (of_more, full)] = [&less, &more].map(|touch| word(touch, &garment));
        let words = [of_less, of_more];
        // Of a full taxel only the least is known, and `unclear` says so beside the word.
        let milder = of_more < of_less && !full;
        (words, milder.then(|| format!("  {seed}, {how}: {words:?}: {less:?}")))
    };
    let work = || {
        let mut own = Vec::new();
        while let Some(seed) = Some(next.fetch_add(1, Ordering::Relaxed)).filter(|seed| *seed < pairs) {
            own.push(judged(seed));
        }
        own
    };
    let workers = thread::available_parallelism().map_or(1, usize::from);
    let all: Vec<_> = thread::scope(|scope| {
        let hands: Vec<_> = (0..workers).map(|_| scope.spawn(work)).collect();
        hands.into_iter().flat_map(|hand| hand.join().expect("it plays")).collect()
    });
    let wrong: Vec<&String> = all.iter().filter_map(|(_, wrong)| wrong.as_ref()).collect();
    let count = |of: Word| all.iter().filter(|(words, _)| words[0] == of).count();
    let [mild, unclear, threat, attack] = [Word::Mild, Word::Unclear, Word::Threat, Word::Attack].map(count);
    println!(
        "{pairs} pairs: {mild} mild, {unclear} unclear, {threat} threats, {attack} attacks; {} milder",
        wrong.len()
    );
    wrong.iter().take(20).for_each(|wrong| println!("{wrong}"));
    assert!(mild.min(threat).min(attack) > pairs as usize / 20, "they are of all kinds");
    assert_eq!(wrong.len(), 0);
}
