//! The bytes of every JSON message: lines, recordings' topics, replayed frames. TAXEL_BLESS=1 updates the
//! golden file.

use std::collections::BTreeMap;
use std::time::Duration;
use taxel::client::{Client, Event, Stamp};
use taxel::json::{MessagePrinter, Replay, message};
use taxel::record::json_message;
use taxel::session::{Observer, Session};
use taxel::source::{self, SourceOptions, SourceSpec};
use taxel_core::format::{Celsius, Micros, Q15, name};
use taxel_core::react::Reaction;
use taxel_core::selftest::{Fault, Findings, PinFault};
use taxel_core::surface::{
    BodyDirection, InBase, Landed, LinkName, RegionPhase, RegionSymbol, SurfacePoint, Wrench,
};
use taxel_core::wire::{
    Budget, GestureReport, Health, Level, PressingReport, ReactionReport, ReflexReport, RegionsReport,
    SelfTestReport, StartOfFrame, SyncReport, Temperature, WireError,
};

const GOLDEN: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/library/golden/lines.txt");
const SCENES: [&str; 2] = ["pat", "five"];
const TIME: Micros = Micros(1_234_567);
const STAMP: Stamp = Stamp { board_us: 7, host_us: 1_700_000_000_000_123, uncertainty_us: Some(412) };

/// Lines by scene and form: where they come from, their type and their keys. The last of each is kept.
type Lines = BTreeMap<String, String>;

/// Keys of a value, also of those in it, as a text that is equal for values of one form.
fn form(value: &serde_json::Value) -> String {
    use serde_json::Value::{Array, Object};
    match value {
        Object(fields) => fields.iter().map(|(key, value)| format!("{key}{}", form(value))).collect(),
        Array(items) => items.first().map_or(String::new(), form),
        _ => String::new(),
    }
}

fn keep(lines: &mut Lines, place: &str, text: &str) {
    let value: serde_json::Value = serde_json::from_str(text).unwrap();
    let kind = value["type"].as_str().unwrap_or("none").to_string();
    lines.insert(format!("{place} {kind} {}", form(&value)), format!("{place} {text}"));
}

/// What a scene's board reports: as lines, printed with pixels, recorded; and its codes processed again.
fn simulate(scene: &str, lines: &mut Lines) {
    let spec: SourceSpec = format!("sim:{scene}").parse().unwrap();
    let mut session = Session::over(source::open(&spec, &SourceOptions::default()).unwrap()).unwrap();
    session.parts().0.stream_raw(u16::MAX).unwrap();
    let mut replay: Option<Replay> = None;
    while let Some(event) = session.wait().unwrap() {
        let client = session.client();
        keep(lines, &format!("{scene} line"), &message(client, &event).to_string());
        let recorded = json_message(client, &event, STAMP).unwrap();
        keep(lines, &format!("{scene} recorded"), std::str::from_utf8(&recorded).unwrap());
        if let Event::Frame { .. } = event {
            let mut printed = Vec::new();
            MessagePrinter::new(true, &mut printed).event(client, &event, STAMP).unwrap();
            keep(lines, &format!("{scene} printed"), std::str::from_utf8(&printed).unwrap());
        }
        if let (Event::Hello, Some(description)) = (&event, client.description()) {
            replay = Some(Replay::new(&description.garment, &description.scene, 4095).unwrap());
        }
        if let (Event::Raw { time, whole: true, .. }, Some(replay)) = (&event, &mut replay) {
            keep(lines, &format!("{scene} replayed"), &replay.frame(client.raw(), *time).to_string());
        }
    }
    if scene == SCENES[0] {
        others(session.client(), lines);
    }
}

pub fn pressing() -> PressingReport {
    let spot = SurfacePoint { link: 1, at: [-150_000, 20, 300_000], normal: [0, -16_384, 5] };
    let base = InBase { at: [1, -1, 1_000_000], normal: [16_384, 0, 0], force: [-4_000, 3, 0] };
    let landed = |id, base| Landed { id, spot, force: [-3, 4_000, 0], base };
    let wrench = Wrench {
        link: 1,
        name: LinkName::try_from("forearm").unwrap(),
        force: [-3, 4_000, 0],
        moment: [-1_200_000, 0, 77],
        pressed: 4_100,
        center: [-150_000, 20, 300_000],
    };
    PressingReport {
        frame: 9,
        time: TIME,
        posed: Some(Micros(70)),
        contacts: [landed(7, None), landed(8, Some(base))].into_iter().collect(),
        links: [wrench].into_iter().collect(),
        ..PressingReport::default()
    }
}

/// Events that the scenes do not cause.
fn others(client: &Client, lines: &mut Lines) {
    let fault = |pin, fault| PinFault { pin, fault };
    let mut findings = Findings { lines: 9, inputs: 4, ..Findings::default() };
    findings.faults.extend([fault(2, Fault::Bridged(3)), fault(8, Fault::StuckHigh), fault(27, Fault::Open)]);
    let gesture = GestureReport {
        frame: 9,
        time: TIME,
        touch: 3,
        panel: 1,
        class: 2,
        name: name("rub"),
        score: -70_000,
        lead: 123_456,
        observed_ms: 900,
        ended: true,
        confidence: Some(Q15(23_456)),
    };
    let reaction = Reaction { index: 2, name: name("retreat"), active: true, value: -7 };
    let reflex = ReflexReport { frame: 9, time: TIME, index: 1, taxel: 77, value: 900, other: Some(78) };
    let region = RegionSymbol {
        phase: RegionPhase::Moving,
        way: BodyDirection::Down,
        contacts: 2,
        since: Micros(1_000),
        ..RegionSymbol::default()
    };
    let all = [
        Event::Unusable("protocol 2".into()),
        Event::Gesture(gesture),
        Event::Pressing(Box::new(pressing())),
        Event::Regions(Box::new(RegionsReport {
            frame: 9,
            time: TIME,
            regions: [region].into_iter().collect(),
        })),
        Event::Shapes { names: vec!["mug".into(), "ball".into()], prototypes: 12 },
        Event::Reaction(ReactionReport { frame: 9, time: TIME, reaction }),
        Event::Reflex(reflex),
        Event::Health(Health { time: TIME, scans: 7, scan_us: 3000, ..Health::default() }),
        Event::Budget(Budget { frame: 9, time: TIME, frames: 20, encode_us: 31, ..Budget::default() }),
        Event::Temperature(Temperature { time: TIME, celsius: Celsius(3_333) }),
        Event::SelfTest(SelfTestReport { time: TIME, findings }),
        Event::Log { time: TIME, level: Level::Warn, text: "a \"word\"\n".into() },
        Event::Lost { why: "usb is gone".into(), since_us: 1_700_000_000_000_000 },
        Event::Back { how: "usb is back".into(), after: Duration::from_millis(1500) },
        Event::Other { why: "another \"board\"".into() },
        Event::Sync(SyncReport { token: 3, received: TIME, sent: Micros(1_234_599) }),
        Event::StartOfFrame(StartOfFrame { number: 2047, noticed: TIME, late_us: 24 }),
        Event::Answer { request: 3, refusal: Some("no".into()) },
        Event::Answer { request: 255, refusal: None },
        Event::Raw { frame: 9, time: TIME, whole: false },
        Event::Refused(WireError::Crc),
    ];
    for event in all {
        keep(lines, "made line", &message(client, &event).to_string());
        let recorded = json_message(client, &event, Stamp { uncertainty_us: None, ..STAMP }).unwrap();
        keep(lines, "made recorded", std::str::from_utf8(&recorded).unwrap());
    }
}

#[test]
fn messages_keep_their_bytes() {
    let mut lines = Lines::new();
    SCENES.iter().for_each(|scene| simulate(scene, &mut lines));
    let text: String = lines.values().map(|line| format!("{}\n", line.trim_end())).collect();
    if std::env::var_os("TAXEL_BLESS").is_some() {
        std::fs::write(GOLDEN, &text).expect("it can be written");
    }
    let golden = std::fs::read_to_string(GOLDEN).expect("golden/lines.txt");
    for (have, want) in text.lines().zip(golden.lines()) {
        assert_eq!(have, want);
    }
    assert_eq!(text.lines().count(), golden.lines().count());
}
