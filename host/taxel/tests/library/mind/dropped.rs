//! Each source of the mind dropped in turn: the default that the map states counts, and nothing contradicts
//! itself.

use super::touched::robot;
use fastrand::Rng;
use std::sync::Arc;
use taxel::fcm::robot_source::RobotSource;
use taxel::fcm::{load, map::MapFile};
use taxel::mind::{
    BoardPlacement, BoardSense, BodyPlace, FeltContact, HostInputLine, RobotMeaning, RobotMind,
};
use taxel_core::format::{Micros, Q15};
use taxel_core::intent::{Leading, Outcome};
use taxel_core::wire::IntentReport;

/// Links of the two boards.
const PLACES: [[&str; 2]; 2] = [["chest", "left hand"], ["back", "left arm"]];

fn places(board: usize) -> Vec<Arc<BodyPlace>> {
    let place = |region: &str| Arc::new(BodyPlace { region: region.into(), link: "torso".into() });
    PLACES[board].map(place).into()
}

/// What a source says.
#[derive(Clone)]
enum Said {
    Board(usize, BoardSense),
    HostInput(&'static str, f64),
    Joints(f64),
}

pub fn report(leading: Leading, value: i32) -> BoardSense {
    let map = load::map("tactile").unwrap();
    let activation = |name: &str| if name == leading.as_str() { Q15(value) } else { Q15(0) };
    let concepts = map.concept.iter().map(|concept| activation(&concept.name)).collect();
    let outcome = Outcome::Fixed;
    BoardSense::Intent(Box::new(IntentReport {
        frame: 1,
        time: Micros(0),
        leading,
        outcome,
        steps: 3,
        concepts,
    }))
}

/// All sources, each with random values.
fn sources(rng: &mut Rng) -> Vec<Vec<Said>> {
    let board = |board: usize, rng: &mut Rng| {
        let map: Option<Arc<MapFile>> = Some(Arc::new(load::map("tactile").unwrap()));
        let places = places(board);
        let leading = [Leading::None, Leading::Kindness, Leading::Threat, Leading::Attack][rng.usize(..4)];
        let contacts = (0..rng.u32(..3)).map(|contact| FeltContact {
            contact,
            place: places[rng.usize(..2)].clone(),
            spot: None,
            load: rng.u32(..8000),
            cover_mm2: rng.u32(..9000),
            peak: rng.u32(..2000),
            panel: 0,
            at_mm: [rng.f64() * 100.0, rng.f64() * 100.0],
        });
        let contacts = BoardSense::Contacts(contacts.collect());
        let begins = BoardSense::Begins(BoardPlacement { places, map });
        [begins, contacts, report(leading, rng.i32(16384..=32768))]
            .map(|sense| Said::Board(board, sense))
            .into()
    };
    vec![
        board(0, rng),
        board(1, rng),
        vec![Said::HostInput("vision", rng.f64() * 2.0 - 1.0)],
        vec![Said::HostInput("voice", rng.f64() * 2.0 - 1.0)],
        vec![Said::HostInput("plan", rng.f64())],
        vec![Said::Joints(rng.f64() * 0.1)],
    ]
}

fn say(mind: &mut RobotMind, said: &Said, host_us: u64) {
    match said {
        Said::Board(board, sense) => {
            mind.board(*board, sense, host_us);
        }
        Said::HostInput(name, value) => {
            let line =
                HostInputLine { host_input: [(name.to_string(), *value)].into(), ..HostInputLine::default() };
            mind.take_input(&line, host_us).unwrap();
        }
        Said::Joints(turned) => {
            for (at, us) in [(0.0, 20_000), (*turned, 0)] {
                let positions = [("waist".to_string(), at)].into();
                let line = HostInputLine { positions, ..HostInputLine::default() };
                mind.take_input(&line, host_us - us).unwrap();
            }
        }
    }
}

const NOW_US: u64 = 5_000_000;

/// What a mind means after these sources, by its concepts.
fn mean(said: &[&Vec<Said>]) -> (RobotMind, RobotMeaning) {
    let mut mind = RobotMind::new(&robot([None; 2])).unwrap();
    for ms in [0, 40] {
        said.iter().flat_map(|said| *said).for_each(|said| say(&mut mind, said, NOW_US + 1000 * ms));
    }
    for ms in [300, 320] {
        mind.pass(NOW_US + 1000 * ms);
    }
    let meaning = mind.meaning().unwrap().clone();
    (mind, meaning)
}

/// Checks that what is announced and felt goes together.
fn check(mind: &RobotMind, meaning: &RobotMeaning) {
    let value = |name: &str| meaning.activations[mind.map().find(name).unwrap()];
    let none = Q15(0);
    match meaning.leading {
        Leading::Kindness => assert!(value("anger") == none && value("kindness") > value("threat")),
        Leading::Threat | Leading::Attack => {
            assert!(value("happiness") == none && value("politeness") == none, "{meaning:?}");
            assert!(value(meaning.leading.as_str()) > value("kindness"));
        }
        Leading::None => {}
    }
    if value("hug") > none {
        assert!(meaning.leading != Leading::Attack || value("hug") < Q15(20_000), "{meaning:?}");
    }
    for (input, heard) in mind.inputs().iter().zip(&meaning.heard) {
        assert!(heard.age_ms.is_some() || heard.value == input.default, "{input:?}: {heard:?}");
        let causes = mind.senses().causes(input, meaning.host_us);
        assert!(heard.age_ms.is_some() || causes.is_empty(), "{input:?}: {causes:?}");
    }
}

#[test]
fn each_source_dropped_leaves_its_default_and_nothing_contradicts_itself() {
    let mut rng = Rng::with_seed(23);
    let mut led = [0; 4];
    for _ in 0..300 {
        let all = sources(&mut rng);
        for dropped in 0..=all.len() {
            let kept: Vec<&Vec<Said>> =
                all.iter().enumerate().filter(|(at, _)| *at != dropped).map(|(_, said)| said).collect();
            let (mind, meaning) = mean(&kept);
            check(&mind, &meaning);
            led[meaning.leading as usize] += 1;
            let defaults =
                mind.inputs().iter().zip(&meaning.heard).filter(|(_, heard)| heard.age_ms.is_none());
            let defaults: Vec<&RobotSource> = defaults.map(|(input, _)| &input.source).collect();
            let is_default = |source: RobotSource| defaults.contains(&&source);
            let part = |words: &[&str]| words.iter().map(ToString::to_string).collect::<Vec<String>>();
            assert_eq!(is_default(RobotSource::Load(part(&["chest"]))), dropped == 0);
            assert_eq!(is_default(RobotSource::Load(part(&["back"]))), dropped == 1);
            // One board that speaks is enough.
            assert!(!is_default(RobotSource::Intent(Leading::Attack)));
            for (name, number) in [("vision", 2), ("voice", 3), ("plan", 4)] {
                assert_eq!(is_default(RobotSource::HostInput(name.into())), dropped == number, "{name}");
            }
            assert_eq!(is_default(RobotSource::Motion(Vec::new())), dropped == 5);
        }
    }
    println!("led: none, kindness, threat, attack: {led:?}");
    assert!(led.iter().all(|count| *count > 50), "{led:?}");
}

#[test]
fn what_is_too_old_has_its_default() {
    let all = sources(&mut Rng::with_seed(1));
    let (mut mind, _) = mean(&all.iter().collect::<Vec<_>>());
    let stale = |mind: &RobotMind| {
        mind.meaning().unwrap().heard.iter().filter(|heard| heard.age_ms.is_none()).count()
    };
    // Without a body nobody knows which way the surface moved, and what it met.
    assert_eq!(stale(&mind), 5);
    // Joints stand still after 0.3 s, boards and vision are silent after 1 s, voice after 3 s, plans after 10
    // s.
    let mut counts = Vec::new();
    for ms in [400, 1_100, 3_100, 10_100] {
        let now_us = NOW_US + 1000 * ms;
        let heard =
            mind.inputs().to_vec().iter().map(|input| mind.senses().value(input, now_us)).collect::<Vec<_>>();
        counts.push(heard.iter().filter(|heard| heard.age_ms.is_none()).count());
    }
    assert_eq!(counts, [6, 20, 21, 22]);
    mind.forget(0, NOW_US + 500_000);
    let chest = RobotSource::Load(vec!["chest".into()]);
    let at = mind.inputs().iter().position(|input| input.source == chest).unwrap();
    assert_eq!(mind.senses().value(&mind.inputs()[at], NOW_US + 500_000).age_ms, None);
}

/// Whatever the inputs: no feeling contradicts what leads.
#[test]
fn feelings_follow_meanings_whatever_is_sensed() {
    use taxel::fcm::board::BoardMap;
    // With the map of active touch, by the concepts that both have.
    let file = robot([None; 2]).map;
    let map = BoardMap::build(&file).unwrap();
    let at = |name: &str| file.find(name).unwrap();
    let [kind, threat, attack] = ["kindness", "threat", "attack"].map(at);
    let [happy, angry, polite] = ["happiness", "anger", "politeness"].map(at);
    let entries: Vec<usize> = file.entries().into_iter().map(at).collect();
    let mut rng = Rng::with_seed(5);
    for _ in 0..100_000 {
        let mut start = map.state([]);
        for entry in &entries {
            start[*entry] = if rng.bool() { rng.i32(-32768..=32768) } else { 0 };
        }
        let run = map.infer(&start);
        assert_eq!(run.outcome, Outcome::Fixed);
        let x = |concept: usize| run.state[concept];
        let leads = |one: usize, others: [usize; 2]| {
            x(one) >= 16384 && others.iter().all(|other| x(one) - x(*other) >= 3277)
        };
        if leads(threat, [kind, attack]) || leads(attack, [kind, threat]) {
            assert!(x(happy) == 0 && x(polite) == 0, "{:?}", &run.state[..file.concept.len()]);
        }
        if leads(kind, [threat, attack]) {
            assert_eq!(x(angry), 0, "{:?}", &run.state[..file.concept.len()]);
        }
    }
}
