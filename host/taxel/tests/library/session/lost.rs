//! Settings that cannot be restored, and sources that do not come back: an error that blames the board.

use super::restored::{garment, reported, until};
use super::rig::{Rig, source};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};
use taxel::client::{Client, Event};
use taxel::error::{Error, ErrorKind, SourceError};
use taxel::session::{Returns, Session};
use taxel_core::format::{Celsius, Code, Micros};
use taxel_core::garment::{Garment, Pins};
use taxel_core::scene::Scene;
use taxel_core::wire::{Hello, MAGIC, PROTOCOL, Report, Request, Temperature, encode};

const TARE: Request<'_> = Request::Tare { frames: 8 };

/// The error at the end of a session.
fn ends(session: &mut Session) -> Error {
    let begun = Instant::now();
    loop {
        if let Err(error) = session.poll() {
            return error;
        }
        assert!(begun.elapsed() < Duration::from_secs(30), "it goes on");
    }
}

#[test]
fn a_board_that_refuses_what_it_had_taken_is_an_error() {
    let rig = Arc::new(Mutex::new(Rig::new()));
    let mut session = Session::new(source(&rig), Returns::Always);
    let (client, _) = session.parts();
    let mut other = garment();
    // A pin that differs from the board's shipped garment.
    other.wiring.row.lines[0].pin = 22;
    client.request(&Request::SetGarment(&postcard::to_allocvec(&other).unwrap())).unwrap();
    client.start(0).unwrap();
    until(&mut session, |event| matches!(event, Event::Frame { .. }));
    {
        let mut rig = rig.lock().unwrap();
        rig.pins = Pins { outputs: Pins::ANY.outputs & !(1 << 22), ..Pins::ANY };
        rig.restart();
    }
    let error = ends(&mut session);
    let text = format!("{error:#}");
    assert!(text.starts_with("rig: after it came back, the board refuses set-garment: "), "{text}");
    let ErrorKind::Source(SourceError::Refused { request, reason, .. }) = error.kind() else {
        panic!("{text}")
    };
    assert_eq!((*request, text.ends_with(reason.as_str())), ("set-garment", true));
}

#[test]
fn a_source_that_does_not_come_back_ends_after_a_stated_time_or_at_once() {
    for (returns, words) in [
        (Returns::Never, "rig is gone: broken pipe"),
        (
            Returns::Within(Duration::from_secs(1)),
            "rig is gone, and has not come back within 1 s: broken pipe",
        ),
    ] {
        let rig = Arc::new(Mutex::new(Rig::new()));
        let mut session = Session::new(source(&rig), returns);
        session.parts().0.start(0).unwrap();
        until(&mut session, |event| matches!(event, Event::Frame { .. }));
        {
            let mut rig = rig.lock().unwrap();
            rig.plugged = false;
            rig.cut();
        }
        let begun = Instant::now();
        let error = ends(&mut session);
        assert_eq!(format!("{error:#}"), words);
        let ErrorKind::Source(SourceError::Gone { label, patience, .. }) = error.kind() else {
            panic!("{error}")
        };
        assert_eq!((label.as_str(), patience.is_some()), ("rig", returns != Returns::Never));
        assert!(begun.elapsed() < Duration::from_secs(3));
    }
}

#[test]
fn a_source_is_waited_for_as_long_as_it_takes() {
    let rig = Arc::new(Mutex::new(Rig::new()));
    let mut session = Session::new(source(&rig), Returns::Always);
    session.parts().0.start(0).unwrap();
    until(&mut session, |event| matches!(event, Event::Frame { .. }));
    {
        let mut rig = rig.lock().unwrap();
        rig.plugged = false;
        rig.cut();
    }
    reported(&mut session, "is gone");
    let begun = Instant::now();
    while begun.elapsed() < Duration::from_millis(1500) {
        session.poll().unwrap();
    }
    assert!(session.is_gone());
    rig.lock().unwrap().plugged = true;
    let text = reported(&mut session, "is back after");
    let seconds: f64 =
        text.split("after ").nth(1).and_then(|rest| rest.split(' ').next()).unwrap().parse().unwrap();
    assert!((1.5..4.0).contains(&seconds), "{text}");
}

#[test]
fn a_board_that_is_lost_before_it_has_said_what_it_is_comes_back_like_any_other() {
    let rig = Arc::new(Mutex::new(Rig::new()));
    let mut session = Session::new(source(&rig), Returns::Always);
    session.parts().0.start(8).unwrap();
    rig.lock().unwrap().cut();
    reported(&mut session, "is gone");
    assert!(session.client().description().is_none());
    let text = reported(&mut session, "is back after");
    assert!(text.ends_with("set again: start, tare"), "{text}");
    assert!(session.gap().is_none());
    until(&mut session, |event| matches!(event, Event::Frame { .. }));
    assert_eq!(session.client().counts().restarts, 0);
}

#[test]
fn a_board_that_does_not_read_holds_nothing_up() {
    let rig = Arc::new(Mutex::new(Rig::new()));
    let mut session = Session::new(source(&rig), Returns::Never);
    session.parts().0.start(0).unwrap();
    until(&mut session, |event| matches!(event, Event::Frame { .. }));
    rig.lock().unwrap().deaf = true;
    let begun = Instant::now();
    let mut frames = 0;
    let error = loop {
        match session.poll() {
            Ok(taxel::session::Poll::Event(Event::Frame { .. })) => frames += 1,
            Ok(_) => {}
            Err(error) => break error,
        }
        assert!(begun.elapsed() < Duration::from_secs(30), "it goes on");
    };
    assert!(frames > 100, "{frames} frames came meanwhile");
    let text = format!("{error:#}");
    assert!(text.starts_with("rig is gone: the board has read nothing for 5 s; "), "{text}");
    assert!(matches!(error.kind(), ErrorKind::Source(SourceError::Gone { .. })), "{error:?}");
    let why = error.cause().map(Error::kind);
    assert!(matches!(why, Some(ErrorKind::Source(SourceError::Silent(_)))), "{why:?}");
}

#[test]
fn a_tare_that_a_touched_board_refuses_when_it_is_back_ends_nothing() {
    let rig = Arc::new(Mutex::new(Rig::new()));
    let mut session = Session::new(source(&rig), Returns::Always);
    session.parts().0.start(8).unwrap();
    until(&mut session, |event| matches!(event, Event::Answer { request, .. } if *request == TARE.number()));
    rig.lock().unwrap().codes[20..23].fill(Code(2000));
    until(&mut session, |event| matches!(event, Event::Contacts { .. }));
    while session.client().contacts().is_empty() {
        session.poll().unwrap();
    }
    // The link breaks before the request is read.
    session.parts().0.request(&TARE).unwrap();
    rig.lock().unwrap().cut();
    let text = reported(&mut session, "is back after");
    assert!(text.ends_with("; set again: start; no new tare: something touches the garment"), "{text}");
    until(&mut session, |event| matches!(event, Event::Frame { .. }));
}

#[test]
fn messages_before_a_returned_board_is_known_count_as_lost() {
    let (garment, scene, clock) = (
        postcard::to_allocvec(&Garment::block()).unwrap(),
        postcard::to_allocvec(&Scene::shipped()).unwrap(),
        postcard::to_allocvec(&Micros(5)).unwrap(),
    );
    let hello = Report::Hello(Hello {
        magic: MAGIC,
        protocol: PROTOCOL,
        garment: &garment,
        firmware: b"taxel",
        clock: &clock,
        scene: &scene,
        calibration: b"",
        chip: b"",
        boot: None,
    });
    let warm = Report::Temperature(Temperature { time: Micros(9), celsius: Celsius(2_500) });
    let mut client = Client::new();
    let say = |client: &mut Client, seq: u32, report: &Report<'_>| {
        let mut room = vec![0; 8192];
        let frame = encode(&(seq, report), &mut room).unwrap();
        frame.iter().filter_map(|byte| client.push(*byte)).count()
    };
    assert_eq!(say(&mut client, 0, &hello) + say(&mut client, 1, &warm), 2);
    client.reconnected();
    // Nobody gets it: it may be another board's.
    assert_eq!(say(&mut client, 5, &warm), 0);
    assert_eq!(say(&mut client, 6, &hello) + say(&mut client, 7, &warm), 2);
    assert_eq!((client.counts().lost, client.counts().restarts), (4, 0));
}
