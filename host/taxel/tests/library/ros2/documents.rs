//! The node's table of topics, and what is written about it: the documentation, the launch file and the
//! layouts of RViz and Foxglove, which need a ROS with a screen to be run.

use super::definitions::{Definitions, package};
use serde_json::Value;
use std::collections::BTreeSet;
use std::path::Path;
use taxel::ros2::parameters::PARAMETERS;
use taxel::ros2::topic_part;
use taxel::ros2::topics::{PUBLISHED, RosQos, RosTopic, SERVICES, TAKEN};
use taxel_core::garment::{Garment, Layout};

fn text(path: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(path);
    std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// Whole name in a node called `/taxel`.
fn whole(name: &str) -> String {
    match name.strip_prefix("~/") {
        Some(own) => format!("/taxel/{own}"),
        None => format!("/{}", name.trim_start_matches('/')),
    }
}

/// Topics that the node publishes with the reference garment, by whole name.
fn published() -> Vec<(String, RosTopic)> {
    let layout = Layout::build(&Garment::reference(), 2048, 4095).unwrap();
    let panels: Vec<String> = layout.areas().iter().map(|area| topic_part(&area.name)).collect();
    let of = |topic: RosTopic| {
        let parts = if topic.name.contains("PANEL") { panels.clone() } else { vec![String::new()] };
        parts.into_iter().map(move |part| (whole(&topic.name.replace("PANEL", &part)), topic))
    };
    PUBLISHED.into_iter().flat_map(of).collect()
}

fn words(qos: RosQos) -> String {
    let reliability = if qos.reliable { "reliable" } else { "best effort" };
    let latched = if qos.latched { ", transient local" } else { "" };
    format!("{reliability}{latched}, depth {}", qos.depth)
}

#[test]
fn the_documentation_has_every_topic_service_and_parameter() {
    let page = text("docs/reference/ros2.md");
    let mut rows = Vec::new();
    for topic in PUBLISHED.into_iter().chain(TAKEN) {
        let (package, message) = topic.message;
        rows.push(format!("| `{}` | {package}/{message} | {} |", whole(topic.name), words(topic.qos)));
    }
    for (name, (package, kind)) in SERVICES {
        rows.push(format!("| `{}` | {package}/{kind} |", whole(name)));
    }
    for (name, kind, value) in PARAMETERS {
        rows.push(format!("| `{name}` | {kind} | {value} |"));
    }
    let missing: Vec<&String> = rows.iter().filter(|row| !page.contains(row.as_str())).collect();
    assert!(missing.is_empty(), "{missing:#?}");
}

/// Messages that the node publishes.
const WHOLE: [&str; 8] =
    ["BodyRegions", "Contacts", "Health", "Intent", "Pressing", "Reaction", "RobotIntent", "Symbols"];

#[test]
fn our_messages_are_those_of_the_package() {
    let build = std::fs::read_to_string(package().join("CMakeLists.txt")).unwrap();
    let all = Definitions::of_package();
    assert!(all.names().all(|name| build.contains(&format!("\"msg/{name}.msg\""))));
    assert_eq!(all.names().count(), build.matches(".msg\"").count());
    let ours =
        PUBLISHED.into_iter().map(|topic| topic.message).filter(|(package, _)| *package == "taxel_msgs");
    let ours: BTreeSet<&str> = ours.map(|(_, message)| message).collect();
    assert_eq!(Vec::from_iter(ours), WHOLE);
    assert!(ours_are_known(&all));
    for (_, (package_of, kind)) in SERVICES {
        assert!(package_of != "taxel_msgs" || package().join(format!("srv/{kind}.srv")).is_file());
    }
}

fn ours_are_known(all: &Definitions) -> bool {
    let parts =
        ["BodyRegion", "Contact", "Landed", "LinkWrench", "Region", "RobotTouch", "Symbol", "Uncertain"];
    parts.iter().chain(&WHOLE).all(|name| all.names().any(|known| known == *name))
}

#[test]
fn rviz_shows_topics_of_the_node_as_they_are() {
    let layout = text("examples/ros2/taxel.rviz");
    let mut shown = 0;
    for display in layout.split("    - Class: rviz_default_plugins/").skip(1) {
        let Some((_, rest)) = display.split_once("        Value: ") else { continue };
        let name = rest.lines().next().unwrap();
        let all = published();
        let (_, topic) = all.iter().find(|(known, _)| known == name).unwrap_or_else(|| panic!("{name}"));
        assert_eq!(display.lines().next().unwrap(), topic.message.1, "{name}");
        let policy = if topic.qos.reliable { "Reliable" } else { "Best Effort" };
        assert!(display.contains(&format!("Reliability Policy: {policy}")), "{name}");
        assert!(display.contains(&format!("Depth: {}\n", topic.qos.depth)), "{name}");
        shown += 1;
    }
    assert_eq!(shown, 12, "image, points and force of four panels");
    let frame = layout.split("Fixed Frame: ").nth(1).and_then(|rest| rest.lines().next()).unwrap();
    let links = Layout::build(&Garment::reference(), 2048, 4095).unwrap();
    assert!(links.areas().iter().any(|area| area.link.as_str() == frame), "{frame}");
}

#[test]
fn foxglove_shows_topics_of_the_node_and_fields_of_their_messages() {
    let layout: Value = serde_json::from_str(&text("examples/ros2/foxglove-layout.json")).unwrap();
    let mut named = BTreeSet::new();
    names(&layout["configById"], &mut named);
    assert!(named.len() > 10, "{named:?}");
    let all = published();
    for name in &named {
        let (topic, field) = name.split_once('.').unwrap_or((name, ""));
        let (_, topic) = all.iter().find(|(known, _)| known == topic).unwrap_or_else(|| panic!("{name}"));
        if let Some(field) = field.split(['.', '[']).next().filter(|field| !field.is_empty()) {
            let file = package().join(format!("msg/{}.msg", topic.message.1));
            let file = std::fs::read_to_string(file).unwrap();
            assert!(file.lines().any(|line| line.split(' ').nth(1) == Some(field)), "{name}");
        }
    }
}

/// Texts of a value, and keys, that begin with `/`.
fn names(value: &Value, named: &mut BTreeSet<String>) {
    match value {
        Value::String(text) if text.starts_with('/') => _ = named.insert(text.clone()),
        Value::Array(all) => all.iter().for_each(|value| names(value, named)),
        Value::Object(all) => all.iter().for_each(|(key, value)| {
            names(&Value::String(key.clone()), named);
            names(value, named);
        }),
        _ => {}
    }
}
