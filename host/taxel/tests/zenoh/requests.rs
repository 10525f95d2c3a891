//! Requests of several programs go to one board, and its answers come to all.

use crate::stage::{Network, Offered, place, wait_for};
use taxel::client::Event;
use taxel_core::wire::Request;
use zenoh::Wait;

#[test]
fn a_request_of_one_viewer_is_done_and_answered() {
    let network = Network::new();
    let offered = Offered::begin(&network);
    let mut viewers = [network.view(), network.view()];
    for viewer in &mut viewers {
        wait_for(viewer, "a Hello", |event| *event == Event::Hello);
    }
    let tare = Request::Tare { frames: 20 };
    viewers[0].request(&tare).unwrap();
    for viewer in &mut viewers {
        let answer = wait_for(
            viewer,
            "an answer",
            |event| matches!(event, Event::Answer { request, .. } if *request == tare.number()),
        );
        assert_eq!(answer, Event::Answer { request: tare.number(), refusal: None });
    }
    let refused = Request::Tare { frames: 5000 };
    viewers[1].request(&refused).unwrap();
    wait_for(
        &mut viewers[1],
        "a refusal",
        |event| matches!(event, Event::Answer { request, refusal: Some(_) } if *request == refused.number()),
    );
    // Each of the two has reached the board once.
    assert_eq!(offered.rig.lock().unwrap().asked.iter().filter(|asked| **asked == tare.number()).count(), 2);
}

#[test]
fn what_is_no_request_does_not_reach_the_board() {
    let network = Network::new();
    let _offered = Offered::begin(&network);
    let mut viewer = network.view();
    wait_for(&mut viewer, "a Hello", |event| *event == Event::Hello);
    let other = network.other();
    let alive = other.liveliness().get(place().all_alive()).wait().unwrap();
    let key = alive.recv().unwrap().into_result().unwrap().key_expr().as_str().to_string();
    let ask = key.replace("/alive/", "/ask/");
    let said = |payload: &[u8]| {
        let replies = other.get(&ask).payload(payload).wait().unwrap();
        let error = replies.recv().unwrap().into_result().unwrap_err();
        error.payload().try_to_string().unwrap().into_owned()
    };
    assert_eq!(said(b""), "it has no bytes");
    assert_eq!(said(b"garbage"), "it has no end");
    assert!(!said(b"garbage\0").is_empty());
    wait_for(&mut viewer, "health", |event| matches!(event, Event::Health(health) if health.refused == 0));
}
