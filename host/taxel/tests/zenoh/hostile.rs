//! Whoever writes to a board's keys without being its program, and asks what is no request.

use crate::stage::{Network, Offered, place, wait_for, wait_for_words};
use std::time::Duration;
use taxel::client::Event;
use taxel::network::{BoardPlace, LONGEST_ASK, PieceStamp};
use taxel::session::Session;
use zenoh::Wait;
use zenoh::qos::CongestionControl;

/// How it is reported.
const STRANGE: &str = "something else writes to";

/// Who offers the board.
fn publisher(other: &zenoh::Session) -> u64 {
    let alive = other.liveliness().get(place().all_alive()).wait().unwrap();
    let sample = alive.recv().unwrap().into_result().unwrap();
    BoardPlace::publisher(sample.key_expr().as_str()).unwrap()
}

/// Another hundred frames, all as the board has sent them; nothing is reported a second time.
fn goes_on(viewer: &mut Session) {
    let mut frames = 0;
    wait_for(viewer, "frames", |event| {
        frames += usize::from(matches!(event, Event::Frame { .. }));
        assert!(!event.remark().is_some_and(|text| text.contains(STRANGE)), "{event:?}");
        frames == 100
    });
    let counts = viewer.client().counts();
    assert_eq!((counts.refused(), counts.restarts), (0, 0));
}

#[test]
fn what_the_program_has_not_sent_is_reported_and_ignored() {
    for (stamp, payload, why) in [
        (None, vec![2, 1, 0], "its attachment is no stamp"),
        (Some((0, 0)), vec![2, 1, 0], "its stamp does not count it"),
        (Some((u64::MAX, u64::MAX)), vec![2, 1, 0], "its number is far from those before it"),
        (Some((1, 1)), vec![2, 1, 0], "its number has come before"),
        (Some((1 << 20, 0)), vec![7; 3 << 20], "it is too long"),
        (Some((1 << 20, 0)), b"garbage".to_vec(), "it has no end"),
    ] {
        // A network of its own: the flood of one case is still under way when the next one begins.
        let network = Network::new();
        let _offered = Offered::begin(&network);
        let other = network.other();
        let mut viewer = network.view();
        wait_for(&mut viewer, "frames", |event| matches!(event, Event::Frame { .. }));
        let publisher = publisher(&other);
        let put = || {
            let attachment = stamp.map(|(main, images)| PieceStamp { publisher, main, images }.to_bytes());
            // The network drops nothing of it, as it may of several megabytes otherwise.
            let put = other.put(place().main(), payload.clone()).congestion_control(CongestionControl::Block);
            match attachment {
                Some(bytes) => put.attachment(bytes.as_slice()).wait().unwrap(),
                None => put.wait().unwrap(),
            }
        };
        put();
        let reported = wait_for_words(&mut viewer, STRANGE);
        let ends = format!("{STRANGE} taxel/arm/left/wire/main, and is ignored: {why}");
        assert_eq!(reported, format!("zenoh:arm/left: {ends}"));
        // It is reported once, and a flood takes nothing from the board.
        (0..50).for_each(|_| put());
        goes_on(&mut viewer);
    }
}

#[test]
fn a_request_of_ten_megabytes_is_refused_at_once_and_takes_no_room() {
    let network = Network::new();
    let _offered = Offered::begin(&network);
    let mut viewer = network.view();
    wait_for(&mut viewer, "frames", |event| matches!(event, Event::Frame { .. }));
    let other = network.other();
    let ask = place().ask(publisher(&other));
    for bytes in [LONGEST_ASK + 1, 10 << 20] {
        let replies = other.get(&ask).payload(vec![1; bytes]).wait().unwrap();
        let said = replies.recv().unwrap().into_result().unwrap_err();
        let said = said.payload().try_to_string().unwrap().into_owned();
        assert_eq!(said, format!("it has {bytes} bytes, and a request has at most {LONGEST_ASK}"));
    }
    // Above what is taken from the network nothing arrives.
    let endless = other.get(&ask).payload(vec![1; 20 << 20]).timeout(Duration::from_secs(2)).wait().unwrap();
    assert!(endless.recv().map_or(true, |reply| reply.result().is_err()));
    goes_on(&mut viewer);
}

#[test]
fn names_with_signs_of_keys_are_no_boards_and_wide_queries_are_answered_for_what_they_meet() {
    for name in ["arm/*", "**/left", "arm/le$*ft", "arm/left#2", "a\u{202e}/b"] {
        let why = name.parse::<BoardPlace>().unwrap_err();
        assert!(why.starts_with("the name of a ") && why.contains("letters, digits, _ and -"), "{why}");
    }
    let network = Network::new();
    let _offered = Offered::begin(&network);
    let mut viewer = network.view();
    wait_for(&mut viewer, "frames", |event| matches!(event, Event::Frame { .. }));
    let other = network.other();
    let replies = other.get("taxel/**").payload(b"garbage".as_slice()).wait().unwrap();
    let mut said: Vec<_> = std::iter::from_fn(|| replies.recv().ok()).collect();
    said.sort_by_key(|reply| reply.result().is_ok());
    let refusal = said[0].result().unwrap_err().payload().try_to_string().unwrap().into_owned();
    assert_eq!((said.len(), refusal.as_str()), (2, "it has no end"));
    assert_eq!(said[1].result().unwrap().key_expr().as_str(), place().state());
    goes_on(&mut viewer);
}

#[test]
fn a_flood_of_signs_of_life_is_reported_a_few_times() {
    let network = Network::new();
    let _offered = Offered::begin(&network);
    let mut viewer = network.view();
    wait_for(&mut viewer, "frames", |event| matches!(event, Event::Frame { .. }));
    let other = network.other();
    let tokens: Vec<_> =
        (1..=300).map(|id| other.liveliness().declare_token(place().alive(id)).wait().unwrap()).collect();
    let odd = other.liveliness().declare_token("taxel/arm/left/alive/nobody").wait().unwrap();
    wait_for_words(&mut viewer, "it is offered twice");
    goes_on(&mut viewer);
    drop((tokens, odd));
    goes_on(&mut viewer);
}
