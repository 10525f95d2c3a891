//! What touches a board when it is lost has ended for the host, once, and begins anew if the board still feels it.

use super::restored::{reported, until};
use super::rig::{Rig, source};
use crate::lines::pressing;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};
use taxel::client::{Client, Event, Stamps};
use taxel::files::calibrate::ForceScale;
use taxel::json::message;
use taxel::record::{Origin, Plan, PlannedBoard, Play, Recorder};
use taxel::recording::Messages;
use taxel::ros2::topic_part;
use taxel::session::{Observer, Poll, Returns, Session};
use taxel_core::contact::Phase;
use taxel_core::format::{Code, Micros, Q15, name};
use taxel_core::intent::{Leading, Outcome};
use taxel_core::react::Reaction;
use taxel_core::surface::{RegionPhase, RegionSymbol};
use taxel_core::wire::{IntentReport, ReactionReport, RegionsReport, Report, encode};

/// A session whose board is pressed, and the ids of the contacts.
fn pressed(rig: &Arc<Mutex<Rig>>) -> (Session, Vec<u32>) {
    let mut session = Session::new(source(rig), Returns::Always);
    session.parts().0.start(8).unwrap();
    until(&mut session, |event| matches!(event, Event::Answer { request: 12, .. }));
    rig.lock().unwrap().codes[20..23].fill(Code(2000));
    until(&mut session, |event| matches!(event, Event::Symbols(list) if !list.regions.is_empty()));
    let ids = session.client().contacts().iter().map(|placed| placed.contact.id).collect();
    (session, ids)
}

/// The host's own events until the board is lost.
fn ends(session: &mut Session) -> Vec<Event> {
    let mut own = Vec::new();
    loop {
        let Poll::Event(event) = session.poll().unwrap() else { continue };
        if session.client().is_own() {
            assert_eq!(session.client().lines().count(), 0, "the board has sent nothing for it");
            own.push(event);
        }
        if matches!(own.last(), Some(Event::Lost { .. })) {
            return own;
        }
    }
}

#[test]
fn what_was_present_ends_when_the_board_is_lost() {
    let rig = Arc::new(Mutex::new(Rig::new()));
    let (mut session, ids) = pressed(&rig);
    assert!(!ids.is_empty() && session.client().image().is_some());
    {
        let mut rig = rig.lock().unwrap();
        rig.plugged = false;
        rig.cut();
    }
    let own = ends(&mut session);
    let [Event::Contacts { released, .. }, Event::Symbols(symbols), ..] = &own[..] else { panic!("{own:?}") };
    let gone = |id: &u32, phase, total| (*id, phase, total);
    let released: Vec<_> =
        released.iter().map(|p| gone(&p.contact.id, p.contact.phase, p.contact.total)).collect();
    assert_eq!(released, ids.iter().map(|id| gone(id, Phase::Released, 0)).collect::<Vec<_>>());
    assert!(symbols.regions.is_empty() && symbols.events.iter().all(|it| it.phase == Phase::Released));
    assert_eq!(symbols.events.iter().map(|it| it.contact).collect::<Vec<_>>(), ids);
    let client = session.client();
    assert!(client.contacts().is_empty() && client.regions().is_empty() && client.image().is_none());
    assert!(client.leading() == Leading::None && client.released().is_empty() && client.raw().is_empty());
    assert!(matches!(own.last(), Some(Event::Lost { why, since_us })
        if why == "rig is gone: broken pipe; waiting for it" && *since_us > 1_600_000_000_000_000));
}

#[test]
fn a_contact_that_outlasts_the_gap_begins_anew_with_its_id() {
    let rig = Arc::new(Mutex::new(Rig::new()));
    let (mut session, ids) = pressed(&rig);
    rig.lock().unwrap().cut();
    ends(&mut session);
    assert!(reported(&mut session, "is back").contains("kept running"));
    let mut phases = Vec::new();
    until(&mut session, |event| {
        let is_list = matches!(event, Event::Contacts { .. });
        phases.extend(is_list.then_some(()));
        phases.len() == 3
    });
    assert_eq!(session.client().contacts().iter().map(|p| p.contact.id).collect::<Vec<_>>(), ids);
    // Its first list after the gap says so, and no other.
    let mut again = Session::new(source(&rig), Returns::Always);
    again.parts().0.start(0).unwrap();
    until(&mut again, |event| matches!(event, Event::Contacts { .. }));
    assert_eq!(again.client().contacts()[0].contact.phase, Phase::Held);
    rig.lock().unwrap().cut();
    let mut seen = Vec::new();
    until(&mut again, |event| {
        let is_list = matches!(event, Event::Contacts { released, .. } if released.is_empty());
        seen.extend(is_list.then_some(event.clone()));
        seen.len() == 1
    });
    assert_eq!(again.client().contacts()[0].contact.phase, Phase::Onset);
    until(&mut again, |event| matches!(event, Event::Contacts { .. }));
    assert_eq!(again.client().contacts()[0].contact.phase, Phase::Held);
}

#[test]
fn what_a_restarted_board_has_forgotten_ends_before_its_first_message() {
    let rig = Arc::new(Mutex::new(Rig::new()));
    let (mut session, ids) = pressed(&rig);
    rig.lock().unwrap().codes.fill(Code(100));
    rig.lock().unwrap().restart();
    let mut order = Vec::new();
    until(&mut session, |event| {
        match event {
            Event::Contacts { released, .. } if !released.is_empty() => {
                order.extend(released.iter().map(|placed| placed.contact.id));
            }
            Event::Hello => order.push(0),
            _ => {}
        }
        *event == Event::Hello
    });
    assert_eq!(order, [&ids[..], &[0]].concat());
}

/// The client of a board that has said this.
fn heard(reports: &[Report<'_>]) -> Client {
    let mut client = Client::new();
    for (seq, report) in (0u32..).zip(reports) {
        let mut room = [0; 1024];
        client.push_all(encode(&(seq, report), &mut room).unwrap()).1.expect("it is an event");
    }
    client
}

#[test]
fn regions_forces_intention_and_reactions_end_too() {
    let (frame, time) = (7, Micros(900));
    let region = |phase| RegionSymbol { phase, contacts: 2, ..RegionSymbol::default() };
    let regions = [RegionPhase::Held, RegionPhase::Free, RegionPhase::Released].map(region);
    let regions = RegionsReport { frame, time, regions: regions.into_iter().collect() };
    let concepts = [Q15(9_000), Q15(0)].into_iter().collect();
    let (leading, outcome) = (Leading::Kindness, Outcome::Fixed);
    let intent = IntentReport { frame, time, leading, outcome, steps: 3, concepts };
    let reaction = |index, active| {
        let reaction = Reaction { index, name: name("flinch"), active, value: 5 };
        Report::Reaction(ReactionReport { frame, time, reaction })
    };
    let mut client = heard(&[
        Report::Regions(regions),
        Report::Pressing(pressing()),
        Report::Intent(intent),
        reaction(0, true),
        reaction(1, true),
        reaction(0, false),
    ]);
    client.lost("it is gone".into(), 5);
    let own: Vec<_> = std::iter::from_fn(|| client.next_event(&[]).1).collect();
    let [
        Event::Regions(regions),
        Event::Pressing(pressing),
        Event::Reaction(reaction),
        Event::Intent(intent),
        Event::Lost { .. },
    ] = &own[..]
    else {
        panic!("{own:?}")
    };
    let phases = [RegionPhase::Released, RegionPhase::Free, RegionPhase::Free];
    assert_eq!(regions.regions.iter().map(|region| region.phase).collect::<Vec<_>>(), phases);
    assert!(regions.regions.iter().all(|region| region.contacts == 0));
    assert!(pressing.links.is_empty() && pressing.contacts.is_empty());
    assert_eq!((reaction.reaction.index, reaction.reaction.active), (1, false));
    assert!(intent.leading == Leading::None && intent.concepts.iter().all(|value| *value == Q15(0)));
    // It is reported once.
    client.lost("it is gone".into(), 5);
    let own: Vec<_> = std::iter::from_fn(|| client.next_event(&[]).1).collect();
    assert!(matches!(own[..], [Event::Lost { .. }]), "{own:?}");
    let line = message(&client, &own[0]).to_string();
    assert_eq!(line, r#"{"type":"lost","since_us":5,"why":"it is gone"}"#);
}

/// Force and torque of a `WrenchStamped` are its last 48 bytes.
fn is_zero(wrench: &[u8]) -> bool {
    wrench.iter().rev().take(48).all(|byte| *byte == 0)
}

/// Records a board that is lost while it is pressed. Returns the file, and the board's session.
fn recorded(name: &str) -> (PathBuf, Session) {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let origin = Origin { scale: ForceScale::new(None, Some(100.0)), ..Origin::default() };
    let board = PlannedBoard { origin, ..PlannedBoard::default() };
    let recorder = Recorder::create(Plan { ros2: true, force: true, ..Plan::of(&path, board) }).unwrap();
    let (mut board, mut stamps) = (recorder.board(0), Stamps::start());
    let mut session = taxel::open("sim:press").unwrap();
    let mut record = |client: &Client, event: &Event| {
        let stamp = stamps.of(client, event);
        board.event(client, event, stamp).unwrap();
    };
    until(&mut session, |event| *event == Event::Hello);
    record(session.client(), &Event::Hello);
    while session.client().contacts().is_empty() || session.client().image().is_none() {
        let event = session.wait().unwrap().expect("it presses");
        record(session.client(), &event);
    }
    let event = until(&mut session, |event| matches!(event, Event::Frame { .. }));
    record(session.client(), &event);
    session.parts().0.lost("it is gone".into(), 5);
    while let Some(event) = session.note() {
        record(session.client(), &event);
    }
    recorder.finish().unwrap();
    (path, session)
}

#[test]
fn readers_of_a_recording_see_what_ended_when_the_board_was_lost() {
    let (path, live) = recorded("ended-read.mcap");
    let is_lost = |event: &Event| matches!(event, Event::Lost { why, since_us } if why == "it is gone" && *since_us == 5);
    let ends = |all: &[(usize, Event)]| {
        let last = all.iter().rev().find(|(_, event)| matches!(event, Event::Contacts { .. }));
        assert!(all.iter().any(|(present, _)| *present > 0) && is_lost(&all.last().unwrap().1), "{all:?}");
        matches!(last, Some((0, Event::Contacts { released, .. })) if !released.is_empty())
    };
    let mut play = Play::open(&path.clone().into()).unwrap();
    let mut read = Vec::new();
    while let Some((_, event)) = play.next_event().unwrap() {
        read.push((play.client().contacts().len(), event));
    }
    let mut replay = Session::open(&format!("replay:{}@max", path.display())).unwrap();
    let mut replayed = Vec::new();
    while let Some(event) = replay.wait().unwrap() {
        replayed.push((replay.client().contacts().len(), event));
    }
    assert!(ends(&read) && ends(&replayed));
    assert!(play.client().image().is_none() && live.client().image().is_none());
}

#[test]
fn a_recording_has_a_last_wrench_of_zero_and_stale_diagnostics() {
    let (path, session) = recorded("ended.mcap");
    let of = |file: &str, topic: &str| {
        let mut messages = Messages::of_topic(&path.with_file_name(file), topic).unwrap();
        let mut all = Vec::new();
        while let Some(message) = messages.next_message().unwrap() {
            all.push(message.data.to_vec());
        }
        all
    };
    let panels = session.client().layout().unwrap().areas().iter();
    let wrenches: Vec<_> = panels
        .map(|area| of("ended.ros2.mcap", &format!("/tactile/{}/wrench", topic_part(&area.name))))
        .collect();
    assert!(wrenches.iter().flatten().any(|wrench| !is_zero(wrench)));
    assert!(wrenches.iter().all(|of_panel| is_zero(of_panel.last().unwrap())));
    let reported = of("ended.ros2.mcap", "/diagnostics");
    assert!(reported.last().unwrap().windows(10).any(|words| words == b"it is gone"));
    // Whoever reads the topics of contacts and intention sees them end.
    let contacts: Value =
        serde_json::from_slice(of("ended.mcap", "/taxel/contacts").last().unwrap()).unwrap();
    assert_eq!(contacts["contacts"], json!([]));
    assert!(!contacts["released"].as_array().unwrap().is_empty());
    assert_eq!(of("ended.mcap", "/taxel/lost").len(), 1);
}
