//! Another board in the place of the one that was lost: reported as another, and given nothing that was asked of that
//! one.

use super::restored::{reported, scene, until};
use super::rig::{self, Rig};
use std::sync::{Arc, Mutex};
use taxel::client::{Event, Identity};
use taxel::error::{ErrorKind, SourceError};
use taxel::session::{Poll, Returns, Session};
use taxel::source::Source;
use taxel_core::format::name;
use taxel_core::garment::Garment;
use taxel_core::wire::{Request, encode};

fn named(called: &str) -> Garment {
    Garment { name: name(called), ..Garment::block() }
}

/// Boards, the number of the one that is plugged in, and serial numbers on USB if there are any.
struct Socket {
    rigs: [Arc<Mutex<Rig>>; 2],
    plugged: Mutex<usize>,
    serials: [Option<&'static str>; 2],
}

impl Socket {
    fn new(garments: [&str; 2], serials: [Option<&'static str>; 2]) -> Arc<Socket> {
        let rigs = garments.map(|garment| Arc::new(Mutex::new(Rig::with_garment(named(garment)))));
        Arc::new(Socket { rigs, plugged: Mutex::new(0), serials })
    }

    fn open(self: Arc<Socket>) -> taxel::Result<Source> {
        let there = *self.plugged.lock().unwrap();
        let source = rig::open(&self.rigs[there])?;
        let usb_serial = self.serials[there].map(String::from);
        Ok(Source { usb_serial, returns: Some(Box::new(move || self.clone().open())), ..source })
    }

    /// Plugs in the other board.
    fn exchange(&self) {
        let mut plugged = self.plugged.lock().unwrap();
        self.rigs[*plugged].lock().unwrap().cut();
        *plugged = 1 - *plugged;
    }

    /// A session that has sent a scene, and streams.
    fn session(self: &Arc<Socket>) -> Session {
        let mut session = Session::new(self.clone().open().unwrap(), Returns::Always);
        let (client, _) = session.parts();
        client.request(&Request::SetScene(&postcard::to_allocvec(&scene()).unwrap())).unwrap();
        client.start(8).unwrap();
        until(&mut session, |event| matches!(event, Event::Answer { request: 12, .. }));
        session
    }
}

/// Names of what is reported until an image comes.
fn words(session: &mut Session) -> Vec<&'static str> {
    let mut words = Vec::new();
    until(session, |event| {
        words.extend(match event {
            Event::Lost { .. } => Some("lost"),
            Event::Back { .. } => Some("back"),
            Event::Other { .. } => Some("other"),
            Event::Hello => Some("hello"),
            Event::Frame { .. } if words.contains(&"lost") => Some("frame"),
            _ => None,
        });
        words.last() == Some(&"frame")
    });
    words.dedup();
    words
}

#[test]
fn another_board_is_reported_as_another_and_gets_no_setting() {
    let socket = Socket::new(["head", "hand"], [None; 2]);
    let mut session = socket.session();
    socket.exchange();
    let why = until(&mut session, |event| matches!(event, Event::Other { .. }));
    let want = "rig answers with another board: it has the garment hand, not head";
    assert_eq!(why.remark(), Some(want));
    assert_eq!(until(&mut session, |event| !matches!(event, Event::Lost { .. })), Event::Hello);
    until(&mut session, |event| matches!(event, Event::Frame { .. }));
    assert_eq!(session.client().description().unwrap().garment, named("hand"));
    assert!(session.gap().is_none());
    // Whoever follows it is asked for no image, scene or baseline of the other.
    let asked = socket.rigs[1].lock().unwrap().asked.clone();
    assert_eq!(asked, [Request::Start.number()]);
    // From now on it is the one.
    socket.rigs[1].lock().unwrap().cut();
    let after = reported(&mut session, "is back after");
    assert!(after.ends_with("kept running; set again: start"), "{after}");
    socket.exchange();
    assert_eq!(words(&mut session), ["lost", "other", "hello", "frame"]);
}

#[test]
fn serial_numbers_decide_where_there_are_any() {
    let socket = Socket::new(["glove", "glove"], [Some("A"), Some("B")]);
    let mut session = socket.session();
    socket.exchange();
    let why = until(&mut session, |event| matches!(event, Event::Other { .. }));
    assert_eq!(why.remark(), Some("rig answers with another board: its serial number is B, not A"));
    // A link without serial numbers, a UART or TCP, has the boards' own: the ids of their chips.
    let socket = Socket::new(["glove", "glove"], [None; 2]);
    for (rig, chip) in socket.rigs.iter().zip(["A", "B"]) {
        let mut rig = rig.lock().unwrap();
        rig.chip = chip;
        rig.restart();
    }
    let mut session = socket.session();
    socket.exchange();
    let why = until(&mut session, |event| matches!(event, Event::Other { .. }));
    assert_eq!(why.remark(), Some("rig answers with another board: its serial number is B, not A"));
    // The number of a probe, by which a board is named, is not that of the chip behind it.
    let socket = Socket::new(["glove", "glove"], [Some("probe"), None]);
    socket.rigs[0].lock().unwrap().chip = "A";
    socket.rigs[0].lock().unwrap().restart();
    let mut session = Session::new(socket.clone().open().unwrap(), Returns::Always);
    session.recognise(Identity::new(Some("probe".into()), None));
    session.parts().0.start(8).unwrap();
    until(&mut session, |event| {
        assert!(!matches!(event, Event::Other { .. }));
        matches!(event, Event::Frame { .. })
    });
    // One number, another garment: it was dressed otherwise meanwhile.
    let socket = Socket::new(["head", "hand"], [Some("A"), Some("A")]);
    let mut session = socket.session();
    socket.exchange();
    assert_eq!(words(&mut session)[..2], ["lost", "hello"]);
    let after = reported(&mut session, "is back after");
    assert!(after.contains("set-scene"), "{after}");
}

#[test]
fn a_board_that_was_dressed_otherwise_is_the_same() {
    let socket = Socket::new(["head", "hand"], [None; 2]);
    let mut session = socket.session();
    // By another program, under our eyes.
    let bytes = postcard::to_allocvec(&named("sleeve")).unwrap();
    let mut room = [0; 4096];
    let request = encode(&Request::SetGarment(&bytes), &mut room).unwrap().to_vec();
    socket.rigs[0].lock().unwrap().receive(&request);
    until(&mut session, |event| *event == Event::Hello);
    assert_eq!(session.client().description().unwrap().garment, named("sleeve"));
    socket.rigs[0].lock().unwrap().cut();
    assert!(reported(&mut session, "is back after").contains("kept running"));
    // It forgets that with its power.
    socket.rigs[0].lock().unwrap().restart();
    socket.rigs[0].lock().unwrap().cut();
    assert!(reported(&mut session, "is back after").contains("restarted"));
}

#[test]
fn concepts_of_a_scene_that_another_program_sets_are_known_by_their_names() {
    let socket = Socket::new(["head", "hand"], [None; 2]);
    let mut session = socket.session();
    let mut other = scene();
    let concepts = &mut other.intent.as_mut().unwrap().map.concepts;
    *concepts.last_mut().unwrap() = name("cold");
    let bytes = postcard::to_allocvec(&other).unwrap();
    let mut room = [0; 8192];
    let request = encode(&Request::SetScene(&bytes), &mut room).unwrap().to_vec();
    socket.rigs[0].lock().unwrap().receive(&request);
    until(&mut session, |event| *event == Event::Hello);
    assert_eq!(session.client().concepts().last(), Some(&name("cold")));
    // It is another scene of the same board.
    assert_eq!((session.client().counts().restarts, session.gap()), (0, None));
}

#[test]
fn a_garment_that_was_sent_is_not_sent_to_another_board() {
    let socket = Socket::new(["head", "hand"], [None; 2]);
    let mut session = Session::new(socket.clone().open().unwrap(), Returns::Always);
    let (client, _) = session.parts();
    client.request(&Request::SetGarment(&postcard::to_allocvec(&named("mine")).unwrap())).unwrap();
    client.start(0).unwrap();
    until(&mut session, |event| matches!(event, Event::Frame { .. }));
    // The board has forgotten it, and gets it again; the other one does not.
    socket.rigs[0].lock().unwrap().restart();
    socket.rigs[0].lock().unwrap().cut();
    assert!(reported(&mut session, "is back after").contains("set-garment"));
    assert_eq!(*socket.rigs[0].lock().unwrap().garment(), named("mine"));
    socket.exchange();
    assert_eq!(words(&mut session), ["lost", "other", "hello", "frame"]);
    assert_eq!(*socket.rigs[1].lock().unwrap().garment(), named("hand"));
}

#[test]
fn whoever_follows_one_board_waits_for_it() {
    let socket = Socket::new(["head", "hand"], [None; 2]);
    let mut session = Session::new(socket.clone().open().unwrap(), Returns::Always);
    session.recognise(Identity::new(None, Some(named("head"))));
    session.parts().0.start(0).unwrap();
    until(&mut session, |event| matches!(event, Event::Frame { .. }));
    socket.exchange();
    let mut reported = Vec::new();
    // It is reported once, however often the other one says what it is, and nothing else comes of it.
    while socket.rigs[1].lock().unwrap().asked.len() < 3 {
        if let Poll::Event(event) = session.poll().unwrap() {
            reported.push(event);
        }
    }
    let others = reported.iter().filter(|event| matches!(event, Event::Other { .. })).count();
    assert_eq!((others, matches!(reported.last(), Some(Event::Other { .. }))), (1, true), "{reported:?}");
    assert!(session.gap().is_some());
    socket.exchange();
    assert_eq!(until(&mut session, |event| *event == Event::Hello), Event::Hello);
    until(&mut session, |event| matches!(event, Event::Back { .. }));
    assert_eq!(session.client().description().unwrap().garment, named("head"));
}

#[test]
fn a_recording_of_another_board_is_refused_with_its_reason() {
    let source = rig::open(&Arc::new(Mutex::new(Rig::with_garment(named("hand"))))).unwrap();
    let mut session = Session::new(Source { returns: None, ..source }, Returns::Always);
    session.recognise(Identity::new(None, Some(named("head"))));
    session.parts().0.start(0).unwrap();
    let error = loop {
        if let Err(error) = session.poll() {
            break error;
        }
    };
    let why = error.cause().map(|cause| cause.kind());
    assert!(matches!(why, Some(ErrorKind::Source(SourceError::Other(_)))), "{error:?}");
}
