//! Two boards that a touch of the robot meets, and minds that hear all of it or a part.

use super::spread::SpreadTouch;
use crate::meaning::family::Announced;
use fastrand::Rng;
use std::path::Path;
use taxel::mind::{BoardSense, HostInputLine, MindReader, RobotMind, RobotReasons};
use taxel::robot::ReadRobot;
use taxel::virtual_board::VirtualBoard;
use taxel_core::format::Micros;
use taxel_core::intent::Leading;
use taxel_core::scene::Scene;
use taxel_core::wire::Request;

/// Time of the tare at the start, us.
const TARE_US: u64 = 200_000;
/// Time after the end of its force in which announcements still belong to a touch, us.
const AFTER_US: u64 = 1_500_000;
/// Time between two values of vision and voice, us, and the greatest age of one, ms.
const SENT_US: u64 = 100_000;
const SENT_AGE_MS: u32 = 120;

/// A robot of two boards of these links.
pub fn robot(links: [Option<&str>; 2]) -> ReadRobot {
    let board = |(name, link): (&str, Option<&str>)| {
        let link = link.map_or(String::new(), |link| format!("link = \"{link}\"\n"));
        format!("[[boards]]\nname = \"{name}\"\nsource = \"sim:idle\"\n{link}")
    };
    let boards: String = ["one", "two"].into_iter().zip(links).map(board).collect();
    let text = format!("name = \"touched\"\nurdf = \"reference\"\n{boards}");
    ReadRobot::parse("touched.toml".into(), text, Path::new(".")).unwrap()
}

/// A source of the mind.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Heard {
    /// The first board alone, by its own word.
    One,
    /// The second.
    Two,
    /// Contacts of both boards, without their words.
    Contacts,
    /// What is seen.
    Vision,
    /// What is heard.
    Voice,
    /// All of them.
    All,
}

impl Heard {
    pub const ALL: [Heard; 6] =
        [Heard::One, Heard::Two, Heard::Contacts, Heard::Vision, Heard::Voice, Heard::All];

    /// True if a mind with this source hears what a board says.
    fn hears(self, sense: &BoardSense) -> bool {
        match self {
            Heard::All => true,
            Heard::Contacts => !matches!(sense, BoardSense::Intent(_)),
            _ => false,
        }
    }
}

/// Plays a touch. Returns the announcements by each source of [`Heard::ALL`]. What is seen is right in 3 of 4
/// touches, what is heard in 7 of 8 of those at which anything is said, which is every second.
pub fn hear(mut touch: SpreadTouch, number: u64) -> [Announced; 6] {
    let robot = robot([touch.parts[0].link, touch.parts[1].link]);
    let mut rng = Rng::with_seed(0x3a1d ^ touch.span.1 ^ number << 40);
    let friendly = if touch.expected.is_harmful() { -0.8 } else { 0.8 };
    let flipped = |is_right: bool| if is_right { friendly } else { -friendly };
    let vision = flipped(rng.u32(..4) > 0);
    let voice = rng.bool().then(|| flipped(rng.u32(..8) > 0));
    let mut boards: Vec<(VirtualBoard, MindReader, u64)> = Vec::new();
    for (number, part) in touch.parts.iter().enumerate() {
        let mut board = VirtualBoard::new(part.garment.clone(), Scene::shipped()).unwrap();
        board.client().request(&Request::Tare { frames: (TARE_US / part.period_us) as u16 }).unwrap();
        boards.push((board, MindReader::new(&robot, number), rng.u64(..part.period_us)));
    }
    let mut minds = Heard::ALL.map(|heard| (heard, RobotMind::new(&robot).unwrap()));
    let mut announced: [Announced; 6] = Default::default();
    let mut leading = [Leading::None; 6];
    let (mut next_us, end_us) = (touch.span.0, touch.span.1 + AFTER_US);
    loop {
        let board = usize::from(boards[0].2 > boards[1].2);
        let now = boards[board].2;
        if now >= end_us {
            return announced;
        }
        let (stepped, reader, due) = &mut boards[board];
        let part = &mut touch.parts[board];
        *due += (part.period_us as f64 * (1.0 + 0.05 * (rng.f64() - 0.5))) as u64;
        let mut codes = vec![0; stepped.taxels()];
        (part.codes)(now, &mut codes);
        let mut senses = Vec::new();
        let mut sink = |client: &taxel::client::Client, event: &taxel::client::Event| {
            senses.extend(reader.sense(client, event));
            Ok(())
        };
        stepped.step(&codes, Micros(now), &mut sink).unwrap();
        let at_ms = (now as i64 - touch.span.0 as i64) / 1000;
        let mut says = |at: usize, said: Leading| {
            if std::mem::replace(&mut leading[at], said) != said {
                announced[at].push((said, at_ms));
            }
        };
        for sense in &senses {
            if let BoardSense::Intent(report) = sense {
                says(board, report.leading);
            }
            for (at, (heard, mind)) in minds.iter_mut().enumerate().skip(2) {
                let news = if heard.hears(sense) { mind.board(board, sense, now) } else { mind.pass(now) };
                if let Some(meaning) = news {
                    says(at, meaning.leading);
                }
            }
        }
        if now >= next_us && now < touch.span.1 {
            next_us += SENT_US;
            let age_ms = rng.u32(40..SENT_AGE_MS);
            let line = |name: &str, value: f64| HostInputLine {
                host_input: [(name.to_string(), value)].into(),
                age_ms,
                ..HostInputLine::default()
            };
            let known = [("vision", Some(vision), Heard::Vision), ("voice", voice, Heard::Voice)];
            for (at, (heard, mind)) in minds.iter_mut().enumerate() {
                for (name, value, of) in &known {
                    let Some(value) = value.filter(|_| [*of, Heard::All].contains(heard)) else { continue };
                    if let Some(meaning) = mind.take_input(&line(name, value), now).unwrap() {
                        says(at, meaning.leading);
                    }
                }
            }
        }
    }
}

/// Plays a touch until this concept holds, and explains it.
pub fn explained(robot: &ReadRobot, mut touch: SpreadTouch, concept: &str) -> RobotReasons {
    let mut mind = RobotMind::new(robot).unwrap();
    let at = mind.map().find(concept).unwrap();
    let mut boards: Vec<(VirtualBoard, MindReader)> = Vec::new();
    for (number, part) in touch.parts.iter().enumerate() {
        let mut board = VirtualBoard::new(part.garment.clone(), Scene::shipped()).unwrap();
        board.client().request(&Request::Tare { frames: 20 }).unwrap();
        boards.push((board, MindReader::new(robot, number)));
    }
    for now in (0..touch.span.1).step_by(5_000) {
        for (number, (stepped, reader)) in boards.iter_mut().enumerate() {
            let mut codes = vec![0; stepped.taxels()];
            (touch.parts[number].codes)(now, &mut codes);
            let mut senses = Vec::new();
            let mut sink = |client: &taxel::client::Client, event: &taxel::client::Event| {
                senses.extend(reader.sense(client, event));
                Ok(())
            };
            stepped.step(&codes, Micros(now), &mut sink).unwrap();
            for sense in &senses {
                mind.board(number, sense, now);
            }
        }
        if mind.meaning().is_some_and(|meaning| meaning.holding.contains(&at)) {
            return RobotReasons::of(&mind, now as f64 / 1e6, Some(concept), robot).unwrap();
        }
    }
    panic!("{concept} does not hold");
}
