//! Boards and programs that are lost, and come back.

use crate::stage::{Network, Offered, state, wait_for, wait_for_words};
use taxel::client::Event;
use taxel_core::format::Code;
use taxel_core::wire::Request;

#[test]
fn a_lost_board_is_waited_for_and_set_again() {
    let network = Network::new();
    let offered = Offered::begin(&network);
    let mut viewer = network.view();
    wait_for(&mut viewer, "a Hello", |event| *event == Event::Hello);
    viewer.request(&Request::Tare { frames: 8 }).unwrap();
    wait_for(&mut viewer, "an answer", |event| matches!(event, Event::Answer { request: 12, .. }));
    {
        let mut rig = offered.rig.lock().unwrap();
        rig.plugged = false;
        rig.cut();
    }
    let gone = wait_for_words(&mut viewer, "is gone");
    assert!(gone.starts_with("zenoh:arm/left is gone"), "{gone}");
    {
        let mut rig = offered.rig.lock().unwrap();
        rig.restart();
        rig.plugged = true;
    }
    let back = wait_for_words(&mut viewer, "set again");
    assert!(back.contains("tare"), "{back}");
    assert!(offered.rig.lock().unwrap().asked.contains(&Request::Tare { frames: 8 }.number()));
    assert_eq!(viewer.client().counts().refused(), 0);
}

#[test]
fn what_touches_a_lost_board_ends_for_its_viewers() {
    let network = Network::new();
    let offered = Offered::begin(&network);
    let (mut viewer, other) = (network.view(), network.other());
    viewer.request(&Request::Tare { frames: 8 }).unwrap();
    wait_for(&mut viewer, "an answer", |event| matches!(event, Event::Answer { request: 12, .. }));
    offered.rig.lock().unwrap().codes[20..23].fill(Code(2000));
    wait_for(&mut viewer, "a symbol", |event| matches!(event, Event::Symbols(_)));
    assert_eq!(state(&other)["live"], true);
    {
        let mut rig = offered.rig.lock().unwrap();
        rig.plugged = false;
        rig.cut();
    }
    let is_end = |event: &Event| matches!(event, Event::Contacts { released, .. } if !released.is_empty());
    wait_for(&mut viewer, "the end of the touch", is_end);
    wait_for(&mut viewer, "the loss", |event| matches!(event, Event::Lost { .. }));
    assert!(viewer.client().contacts().is_empty() && viewer.client().regions().is_empty());
    assert_eq!(state(&other)["live"], false);
}

#[test]
fn a_program_that_ends_and_begins_again_is_the_same_board() {
    let network = Network::new();
    let offered = Offered::begin(&network);
    let mut viewer = network.view();
    wait_for(&mut viewer, "contacts", |event| matches!(event, Event::Frame { .. }));
    let rig = offered.rig.clone();
    drop(offered);
    wait_for_words(&mut viewer, "is gone");
    let again = Offered::of(&network, rig);
    let back = wait_for_words(&mut viewer, "is back");
    assert!(back.contains("kept running"), "{back}");
    let counts = viewer.client().counts();
    assert_eq!((counts.restarts, counts.refused()), (0, 0));
    drop(again);
}
