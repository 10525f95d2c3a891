//! What touches mean to the robot, as a message of ROS 2, read by its definition, beside its line of JSON.

use super::definitions::Definitions;
use serde_json::json;
use std::path::Path;
use taxel::mind::{Approach, Mover, Probe, RobotMeaningLine, RobotTouchLine, robot_intent_message};
use taxel::robot::ReadRobot;

const ROBOT: &str = "name = \"two\"\n[[boards]]\nname = \"torso\"\nsource = \"sim:five\"\ngarment = \"reference\"\n\
                     [[boards]]\nname = \"hand\"\nsource = \"sim:press\"\ngarment = \"block-4x16\"\n";
const NOW_US: u64 = 1_700_000_000_250_000;

#[test]
fn the_message_of_the_mind_says_what_its_line_says() {
    let robot = ReadRobot::parse("two.toml".into(), ROBOT.into(), Path::new(".")).unwrap();
    let other = RobotTouchLine {
        board: 1,
        contact: 4,
        region: "mat".into(),
        link: "left_hand".into(),
        load: 900,
        mover: Mover::Unsure,
        approach: None,
        probe: None,
    };
    let own = RobotTouchLine {
        board: 0,
        mover: Mover::Own,
        approach: Some(Approach { normal_m_s: 0.25, speed_m_s: 0.5 }),
        probe: Some(Probe { hardness: Some(1500), point: 40, slide: 30, stir: 5 }),
        ..other.clone()
    };
    let concepts = [("kindness", 0.75), ("hug", -0.5), ("anger", 0.0)];
    let line = RobotMeaningLine {
        host_time_us: NOW_US,
        leading: "kindness",
        holding: vec!["kindness".into(), "hug".into()],
        concepts: concepts.map(|(name, value)| (name.to_string(), json!(value))).into_iter().collect(),
        defaults: vec!["plan".into()],
        touches: vec![other, own],
    };
    let reported = Definitions::of_package().read("RobotIntent", &robot_intent_message(&robot, &line));
    assert_eq!(reported["header"]["stamp"], json!({ "sec": 1_700_000_000, "nanosec": 250_000_000 }));
    let written = serde_json::to_value(&line).unwrap();
    for key in ["leading", "holding", "defaults"] {
        assert_eq!(reported[key], written[key], "{key}");
    }
    let names = reported["concepts"].as_array().unwrap();
    assert_eq!(names.len(), 3);
    for (name, value) in names.iter().zip(reported["activations"].as_array().unwrap()) {
        assert_eq!(*value, written["concepts"][name.as_str().unwrap()]);
    }
    let common = json!({ "contact": 4, "region": "mat", "link": "left_hand", "load": 900 });
    for touch in reported["touches"].as_array().unwrap() {
        assert!(common.as_object().unwrap().iter().all(|(key, value)| touch[key] == *value), "{touch}");
    }
    let [unsure, moved] = [&reported["touches"][0], &reported["touches"][1]];
    assert_eq!((&unsure["board"], &unsure["mover"]), (&json!("hand"), &json!(2)));
    assert_eq!((&moved["board"], &moved["mover"]), (&json!("torso"), &json!(0)));
    let felt = [("approach_normal", 0.25), ("approach_speed", 0.5), ("hardness", 1.5e6), ("point", 0.4)];
    for (key, value) in felt.into_iter().chain([("slide", 0.03), ("stir", 0.05)]) {
        assert!(unsure[key].is_null() && (moved[key].as_f64().unwrap() - value).abs() < 1e-9, "{key}");
    }
}
