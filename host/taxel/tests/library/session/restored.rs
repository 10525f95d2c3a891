//! All settings of a session are restored, whatever breaks.

use super::rig::{Rig, source};
use std::path::Path;
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};
use taxel::client::Event;
use taxel::files::bases::Base;
use taxel::session::setting::set_shapes;
use taxel::session::{Poll, Returns, Session};
use taxel_core::condition::Certificate;
use taxel_core::format::{Q15, name};
use taxel_core::garment::Garment;
use taxel_core::intent::{Feed, MapInput, Source as From};
use taxel_core::scene::Scene;
use taxel_core::wire::Request;

/// Number of breaks, in a test and in a campaign.
fn rounds() -> usize {
    if std::env::var_os("TAXEL_CAMPAIGN").is_some() { 1000 } else { 50 }
}

pub fn garment() -> Garment {
    Garment { name: name("mine"), ..Garment::block() }
}

/// A scene with a concept that the host feeds.
pub fn scene() -> Scene {
    let mut scene = Scene { name: name("mine"), ..Scene::shipped() };
    scene.contact.high += 1;
    let map = &mut scene.intent.as_mut().unwrap().map;
    map.concepts.push(name("warmth")).unwrap();
    let concept = map.concepts.len() as u8 - 1;
    let fed =
        MapInput { concept, source: From::Host(0), low: -32768, high: 32768, at_low: -100, at_high: 100 };
    map.inputs.push(fed).unwrap();
    scene
}

/// Request numbers of all settings, in the order of restoring.
fn order(parts: usize) -> Vec<u8> {
    let added = vec![9; parts];
    [&[5, 6, 10, 11, 8][..], &added, &[18, 0, 4, 12]].concat()
}

/// Sends all settings in another order. Returns the number of parts of the base of shapes.
fn set(session: &mut Session) -> usize {
    let (client, _) = session.parts();
    client.request(&Request::SetGarment(&postcard::to_allocvec(&garment()).unwrap())).unwrap();
    client.request(&Request::SetScene(&postcard::to_allocvec(&scene()).unwrap())).unwrap();
    let feed = Feed { concept: name("warmth"), value: Q15(9), age_ms: 5, timeout_ms: 0, default: Q15(0) };
    client.request(&Request::Feed(feed)).unwrap();
    let gains = Request::SetGain { first: 0, gains: std::iter::repeat_n(5000, 64).collect() };
    client.request(&gains).unwrap();
    let of = Certificate { id: 77, taxels: 64, year: 2026, month: 2, day: 3, error: 9 };
    client.request(&Request::SetCalibration(of)).unwrap();
    client.start(8).unwrap();
    let base = Base::open(Path::new("drawn")).unwrap();
    set_shapes(client, &base).unwrap();
    client.stream_budget(5).unwrap();
    base.gallery.prototypes.len().div_ceil(64)
}

/// Continues until an event meets the condition.
#[track_caller]
pub fn until(session: &mut Session, mut is_it: impl FnMut(&Event) -> bool) -> Event {
    let begun = Instant::now();
    loop {
        if let Poll::Event(event) = session.poll().unwrap()
            && is_it(&event)
        {
            return event;
        }
        assert!(begun.elapsed() < Duration::from_secs(20), "it did not come");
    }
}

/// A remark of the host that holds these words.
#[track_caller]
pub fn reported(session: &mut Session, words: &str) -> String {
    let holds =
        |event: &Event| event.remark().is_some_and(|text| text.starts_with("rig ") && text.contains(words));
    until(session, holds).remark().unwrap().to_string()
}

#[test]
fn everything_is_set_again_whatever_breaks() {
    let rig = Arc::new(Mutex::new(Rig::new()));
    let mut session = Session::new(source(&rig), Returns::Always);
    let parts = set(&mut session);
    let mut answered = Vec::new();
    until(&mut session, |event| {
        if let Event::Answer { request, refusal } = event
            && *request != Request::KeyFrame.number()
        {
            assert_eq!(*refusal, None, "{request}");
            answered.push(*request);
        }
        answered.len() == order(parts).len()
    });
    for round in 0..rounds() {
        // A brown-out that the link survives, a link that breaks, and both.
        let (restarts, breaks) = [(true, false), (false, true), (true, true)][round % 3];
        {
            let mut rig = rig.lock().unwrap();
            if restarts {
                rig.restart();
            }
            if breaks {
                rig.cut();
            }
            rig.asked.clear();
        }
        if breaks {
            assert!(reported(&mut session, "is gone").ends_with("waiting for it"));
        }
        let text = reported(&mut session, if restarts { "restarted" } else { "kept running" });
        assert_eq!(text.contains("is back after"), breaks, "{text}");
        until(&mut session, |event| matches!(event, Event::Frame { .. }));
        let rig = rig.lock().unwrap();
        // A reopened link sends the start at once; settings proved by a `Hello` are not repeated.
        let asked: Vec<u8> = rig.asked.iter().copied().skip(usize::from(breaks)).collect();
        let unproven = |number: &u8| restarts || ![5, 6, 10, 11, 12].contains(number);
        let expected: Vec<u8> = order(parts).into_iter().filter(unproven).collect();
        assert_eq!(asked, expected, "round {round}");
        assert_eq!((rig.garment(), rig.scene()), (&garment(), &scene()), "round {round}");
        assert_eq!(rig.calibration(), (5000, Some(77)), "round {round}");
        assert_eq!(session.client().description().unwrap().garment, garment());
        assert_eq!(session.client().description().unwrap().scene, scene());
    }
    println!("memory: {0} restarts, disconnects and both; {0} times everything set again in order", rounds());
}

#[test]
fn what_was_replaced_or_taken_back_is_not_set_again() {
    let rig = Arc::new(Mutex::new(Rig::new()));
    let mut session = Session::new(source(&rig), Returns::Always);
    let (client, _) = session.parts();
    client.start(4).unwrap();
    client.stream_raw(9).unwrap();
    client.stream_raw(0).unwrap();
    client.request(&Request::SetScene(&postcard::to_allocvec(&scene()).unwrap())).unwrap();
    // The scene is too large: a refused setting is not remembered, and the one before stays.
    client.request(&Request::SetScene(&[255; 9])).unwrap();
    // A garment undoes the tare.
    client.request(&Request::SetGarment(&postcard::to_allocvec(&garment()).unwrap())).unwrap();
    let mut answers = 0;
    until(&mut session, |event| {
        answers += usize::from(matches!(event, Event::Answer { .. }));
        answers == 7
    });
    rig.lock().unwrap().restart();
    reported(&mut session, "set again");
    let rig = rig.lock().unwrap();
    assert_eq!(rig.asked, [5, 6, 0, 4]);
    assert_eq!((rig.garment(), rig.scene()), (&garment(), &scene()));
}

#[test]
fn a_board_that_restarts_before_it_has_answered_is_asked_again() {
    let rig = Arc::new(Mutex::new(Rig::new()));
    let mut session = Session::new(source(&rig), Returns::Always);
    // Opening the port restarts the board: requests sent at once are lost.
    let (client, _) = session.parts();
    client.request(&Request::SetScene(&postcard::to_allocvec(&scene()).unwrap())).unwrap();
    client.start(0).unwrap();
    session.poll().unwrap();
    rig.lock().unwrap().restart();
    reported(&mut session, "set again");
    let rig = rig.lock().unwrap();
    assert_eq!(rig.scene(), &scene());
}
