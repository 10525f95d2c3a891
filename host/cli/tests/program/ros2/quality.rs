//! Who listens, and how: subscribers by default, one that stands still, and a flood of others' messages.

use super::calls::frames;
use super::peer::{Peer, Taxel, Wrench, domain, until};
use serde::Serialize;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Duration;
use taxel::ros2::Cdr;
use taxel::ros2::topics::{CONCEPT, JSON, RosTopic};
use taxel_cli::ros2::{RosNode, RosParameters, RosPlace};

/// Messages that the middleware keeps for a subscriber that confirms none, and more.
const MANY: u32 = 10_000;

#[test]
fn subscribers_by_default_get_forces() {
    let (taxel, mut peer) = (Taxel::start("forces", &["--source", "sim:pat"]), Peer::open("forces"));
    let wrenches =
        peer.hear::<Wrench>(&taxel.name("tactile/back/wrench"), ("geometry_msgs", "WrenchStamped"));
    let pressed = || wrenches.take().unwrap().filter(|(wrench, _)| wrench.force[2] > 0.0);
    until("a force", pressed);
}

/// A scene whose map hears of the concept `warmth`.
fn scene() -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("ros2-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let map = "name = \"warm\"\nlambda = 1\n[[concept]]\nname = \"warmth\"\n[[concept]]\nname = \"kindness\"\n\
               [[input]]\nconcept = \"warmth\"\nsource = { host = 3 }\nrise = [-32768, 32768]\nat = [-1, 1]\n\
               [[edge]]\nfrom = \"warmth\"\nto = \"kindness\"\nweight = 1\n";
    std::fs::write(folder.join("warm.toml"), map).unwrap();
    let scene = folder.join("scene.toml");
    std::fs::write(&scene, "[intent]\nmap = \"warm.toml\"\n").unwrap();
    scene
}

/// A node of ours in this process.
fn talker(name: &str) -> RosNode {
    let place = RosPlace { domain: domain(), namespace: "/peers".into(), name: name.into(), board: None };
    RosNode::open(place, &RosParameters { source: "none".into(), image_hz: 0.0 }).unwrap()
}

/// The one that stands still is a `taxel ros2` that subscribes to a concept.
#[cfg(unix)]
#[test]
fn a_subscriber_that_confirms_nothing_takes_nothing_from_others() {
    let still = Taxel::start("still", &["--source", "sim:idle", "--scene", &scene().display().to_string()]);
    let name = still.name("taxel/concepts/warmth");
    let topic = RosTopic { name: name.clone().leak(), ..CONCEPT };
    let mut node = talker("talker");
    node.offer(&topic, "").unwrap();
    until("the one that stands still", || node.wants(&topic, "").then_some(()));
    still.signal("-STOP");
    let mut peer = Peer::open("listener");
    let heard = peer.hear::<f64>(&name, topic.message);
    let mut publish =
        |number: u32| node.publish(&topic, "", Cdr::default().f64(number.into()).finish()).unwrap();
    let newest = || std::iter::from_fn(|| heard.take().unwrap()).last().map(|(number, _)| number as u32);
    let mut number = 0;
    while number < MANY {
        (0..50).for_each(|more| publish(number + more));
        number += 50;
        let wanted = number;
        until(&format!("message {wanted}"), || {
            // The first ones of a topic that is offered anew are for nobody.
            publish(number);
            number += 1;
            newest().filter(|newest| *newest >= wanted)
        });
    }
}

#[test]
fn messages_of_any_length_arrive() {
    let (mut peer, mut node) = (Peer::open("long"), talker("long_talker"));
    let name = format!("/long_{}/text", std::process::id());
    let topic = RosTopic { name: name.clone().leak(), ..JSON };
    let heard = peer.hear::<String>(&name, topic.message);
    let next = || std::iter::from_fn(|| heard.take().unwrap()).last().map(|(text, _)| text.len());
    for length in [1, 2000, 70_001, 70_002, 70_003, 70_004] {
        let text = Cdr::default().text(&"x".repeat(length)).finish();
        until(&format!("{length} bytes"), || {
            node.publish(&topic, "", text.clone()).unwrap();
            thread::sleep(Duration::from_millis(20));
            next().filter(|heard| *heard == length)
        });
    }
}

/// As many joints as a message has room for, as fast as can be.
#[derive(Debug, Clone, Serialize)]
struct Joints {
    stamp: (i32, u32),
    frame_id: String,
    name: Vec<String>,
    position: Vec<f64>,
    rest: [u32; 2],
}

#[test]
fn a_flood_of_joint_states_takes_no_contacts() {
    let (taxel, mut peer) = (Taxel::start("flood", &["--source", "sim:five"]), Peer::open("flood"));
    let contacts = peer.hear(&taxel.name("taxel/contacts"), ("taxel_msgs", "Contacts"));
    let joints = Joints {
        stamp: (0, 0),
        frame_id: String::new(),
        name: (0..500).map(|joint| format!("joint_{joint}")).collect(),
        position: vec![0.5; 500],
        rest: [0; 2],
    };
    frames(&contacts, 1);
    let publisher = peer.publish_to(&taxel.name("joint_states"), ("sensor_msgs", "JointState"));
    let is_over = AtomicBool::new(false);
    let heard = thread::scope(|scope| {
        scope.spawn(|| {
            while !is_over.load(Ordering::Relaxed) {
                publisher.publish(joints.clone()).unwrap();
            }
        });
        let heard = frames(&contacts, 400);
        is_over.store(true, Ordering::Relaxed);
        heard
    });
    assert!(heard.windows(2).all(|pair| pair[1] > pair[0]), "{heard:?}");
}
