//! A board whose texts contain terminal control characters.

use super::stage::{events, frame, hello};
use crate::sink::Sink;
use taxel::client::{Client, Stamp};
use taxel::json::MessagePrinter;
use taxel::session::Observer;
use taxel::source::{self, SourceOptions};
use taxel_cli::terminal::Lines;
use taxel_core::format::{Micros, Name, name};
use taxel_core::garment::Garment;
use taxel_core::react::Reaction;
use taxel_core::scene::Scene;
use taxel_core::wire::{Answer, GestureReport, Level, Log, ReactionReport, Report, ShapesReport};

/// Clears a screen, sets a title, rings, returns to the start of the line, reverses the text, and clears with
/// an 8-bit control code.
const EVIL: &str = "\u{1b}[2J\u{1b}]0;x\u{7}\r\u{202e}\u{9b}2J";

fn evil(text: &str) -> Name {
    name(&format!("{text}\u{1b}[2J\u{9b}"))
}

fn says() -> Vec<u8> {
    let (mut garment, mut scene) = (Garment::reference(), Scene::shipped());
    garment.name = evil("g");
    for panel in &mut garment.panels {
        panel.name = evil(&panel.name[..2]);
        (panel.link, panel.region) = (evil("l"), evil("r"));
    }
    scene.name = evil("s");
    scene.friendliness.clear();
    let joints: Vec<Name> = scene.joints.iter().map(|joint| evil(&joint[..2])).collect();
    scene.joints = joints.into_iter().collect();
    scene.react.iter_mut().for_each(|row| row.name = evil(&row.name[..2]));
    if let Some(intent) = &mut scene.intent {
        intent.map.name = evil("m");
        intent.map.concepts.last_mut().unwrap().clone_from(&evil("c"));
    }
    let mut said = hello(0, &garment, &scene, EVIL);
    let text = format!("{EVIL} the disk\u{1b}c");
    let reaction = Reaction { name: evil("flinch"), active: true, ..reaction() };
    let gesture = GestureReport { name: evil("pat"), ..gesture() };
    let shapes = ShapesReport { prototypes: 3, names: [evil("ring"), evil("edge")].into_iter().collect() };
    for (seq, report) in (1..).zip([
        Report::Log(Log { time: Micros(5), level: Level::Warn, text: &text }),
        Report::Answer(Answer { request: 1, refusal: Some(&text) }),
        Report::Reaction(ReactionReport { frame: 1, time: Micros(7), reaction }),
        Report::Gesture(gesture),
        Report::Shapes(shapes),
    ]) {
        said.extend(frame(seq, &report));
    }
    said
}

fn reaction() -> Reaction {
    Reaction { index: 0, name: Name::new(), active: false, value: 0 }
}

fn gesture() -> GestureReport {
    GestureReport {
        frame: 1,
        time: Micros(6),
        touch: 1,
        panel: 1,
        class: 0,
        name: Name::new(),
        score: 0,
        lead: 0,
        observed_ms: 5,
        ended: false,
        confidence: None,
    }
}

#[test]
fn control_codes_of_a_board_never_reach_a_terminal() {
    let source = source::open(&"sim:idle".parse().unwrap(), &SourceOptions::default()).unwrap();
    let (mut client, lines, json) = (Client::new(), Sink::default(), Sink::default());
    let mut shows: Vec<Box<dyn Observer>> =
        vec![Box::new(Lines::new(lines.clone())), Box::new(MessagePrinter::new(false, json.clone()))];
    shows.opened(&source).unwrap();
    let stamp = Stamp { board_us: 5, host_us: 7, uncertainty_us: None };
    for event in events(&mut client, &says()) {
        shows.event(&client, &event, stamp).unwrap();
    }
    assert!(client.description().is_some(), "a board with such names is of use all the same");
    for text in [lines.text(), json.text()] {
        let obeyed =
            |sign: &char| (sign.is_control() && *sign != '\n') || ('\u{2028}'..='\u{202e}').contains(sign);
        let found: Vec<char> = text.chars().filter(obeyed).collect();
        assert!(found.is_empty(), "{found:?} in {text:?}");
    }
    for (text, words) in [(lines.text(), "the disk"), (lines.text(), "flinch"), (json.text(), "\"pat")] {
        assert!(text.contains(words), "{words} is not in {text}");
    }
    assert_eq!(lines.text().lines().filter(|line| line.contains("the disk")).count(), 2);
}
