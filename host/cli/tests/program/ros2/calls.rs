//! Services of the node, called by another program: many calls, early ones, long ones, slow ones.

use super::peer::{Done, Framed, Peer, SET_SCENE, SetScene, TRIGGER, Taxel, Trigger, until};
use ros2_client::{Client, Message, Subscription};
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::process::Command;

/// Answers of a service by the number of the call, once there are so many.
fn answers<A: Message + 'static>(client: &Client<A, Done>, many: usize) -> Vec<Done> {
    let mut all = BTreeMap::new();
    until("all answers", || {
        while let Some((id, done)) = client.receive_response().unwrap() {
            all.insert(id.sequence_number, done);
        }
        (all.len() == many).then_some(())
    });
    all.into_values().collect()
}

/// Frames of the lists of contacts that come, so many.
pub fn frames(contacts: &Subscription<Framed>, many: usize) -> Vec<u32> {
    let mut frames = Vec::new();
    until("lists of contacts", || {
        frames.extend(std::iter::from_fn(|| contacts.take().unwrap()).map(|(list, _)| list.frame));
        (frames.len() >= many).then_some(())
    });
    frames
}

#[test]
fn more_calls_than_wait_are_refused_and_each_is_answered() {
    let (taxel, mut peer) = (Taxel::start("many_calls", &["--source", "sim:idle"]), Peer::open("many_calls"));
    let client = peer.client(&taxel.name("taxel/tare"), TRIGGER, Trigger(0));
    for _ in 0..30 {
        client.send_request(Trigger(0)).unwrap();
    }
    let answers = answers(&client, 30);
    let refused: Vec<&Done> = answers.iter().filter(|done| !done.success).collect();
    let why = "8 calls wait for the board already: call again once they are answered";
    assert!(refused.iter().all(|done| done.message == why), "{refused:?}");
    assert!((1..23).contains(&refused.len()), "{} of 30 are refused", refused.len());
}

#[test]
fn an_answer_to_a_long_scene_arrives_and_is_short() {
    let (taxel, mut peer) = (Taxel::start("long_scene", &["--source", "sim:idle"]), Peer::open("long_scene"));
    let client = peer.client(&taxel.name("taxel/set_scene"), SET_SCENE, SetScene(String::new()));
    client.send_request(SetScene("x".repeat(100_000))).unwrap();
    client.send_request(SetScene(format!("name = \"{}\"\n", "y".repeat(230_000)))).unwrap();
    let answers = answers(&client, 2);
    assert!(answers.iter().all(|done| !done.success && done.message.len() < 1100), "{answers:?}");
    assert!(answers[0].message.ends_with("x cannot be read: file name too long"), "{}", answers[0].message);
    assert_eq!(answers[1].message, "the scene: a scene has at most 64 KiB, not 225");
}

/// A pipe that nobody writes is the slowest of files.
#[cfg(unix)]
#[test]
fn a_scene_that_is_read_slowly_holds_up_no_contacts() {
    let pipe = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("scene-{}", std::process::id()));
    assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    let (taxel, mut peer) = (Taxel::start("slow_scene", &["--source", "sim:five"]), Peer::open("slow_scene"));
    let contacts = peer.hear(&taxel.name("taxel/contacts"), ("taxel_msgs", "Contacts"));
    let client = peer.client(&taxel.name("taxel/set_scene"), SET_SCENE, SetScene(String::new()));
    frames(&contacts, 1);
    client.send_request(SetScene(pipe.display().to_string())).unwrap();
    frames(&contacts, 400);
    let answers = answers(&client, 1);
    assert!(!answers[0].success && answers[0].message.contains("a FIFO"), "{answers:?}");
    std::fs::remove_file(&pipe).unwrap();
}

/// The middleware may know a client's call before the end that takes the answer.
#[test]
fn a_call_is_answered_though_its_client_is_known_later() {
    let (taxel, mut peer) = (Taxel::start("early_call", &["--source", "sim:idle"]), Peer::open("early_call"));
    let heard: Subscription<String> = peer.hear(&taxel.name("taxel/json"), ("std_msgs", "String"));
    let (service, kind) = (taxel.name("taxel/save"), "std_srvs::srv::dds_::Trigger");
    let caller = peer.caller(&service, kind);
    peer.find(&service);
    let mut calls = 0;
    until("the line about the board's answer", || {
        // Only what is published once the service is met reaches it.
        if calls % 100 == 0 {
            caller.write(Trigger(0), None).unwrap();
        }
        calls += 1;
        let mut lines = std::iter::from_fn(|| heard.take().unwrap()).map(|(line, _)| line);
        lines.any(|line| line.contains("\"request\":\"save\"")).then_some(())
    });
    let mut answers = peer.answered::<Done>(&service, kind);
    until("the answer", || answers.take_next_sample().unwrap());
}
