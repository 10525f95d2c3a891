//! The robot's contacts as a message of ROS 2, read by its definition, beside its line of JSON.

use super::definitions::Definitions;
use serde_json::{Value, json};
use std::path::Path;
use taxel::robot::{
    ReadRobot, RobotContact, RobotContactsLine, RobotTouch, RobotTouchPart, robot_contacts_message,
};
use taxel_core::contact::Phase;

const ROBOT: &str = "name = \"two\"\n[[boards]]\nname = \"torso\"\nsource = \"sim:five\"\ngarment = \"reference\"\n\
                     [[boards]]\nname = \"hand\"\nsource = \"sim:press\"\ngarment = \"block-4x16\"\n";
const NOW_US: u64 = 1_700_000_000_250_000;

fn contact(id: u32, phase: Phase, newtons: Option<f64>) -> RobotContact {
    let part = |board, contact, total, age_us| RobotTouchPart { board, contact, total, age_us };
    let touch = RobotTouch {
        host_us: NOW_US - 5_000,
        board: 1,
        panel: 0,
        centroid: [3.5, -0.25],
        total: 900,
        newtons,
        peak: 300,
        area: 7,
        parts: vec![part(1, Some(4), 600, 0), part(0, None, 300, -2_000)],
    };
    RobotContact { id, phase, onset_us: NOW_US - 1_500_000, touch }
}

#[test]
fn the_message_says_what_the_line_says() {
    let robot = ReadRobot::parse("two.toml".into(), ROBOT.into(), Path::new(".")).unwrap();
    let contacts = [contact(3, Phase::Held, Some(4.5)), contact(9, Phase::Released, None)];
    let read =
        Definitions::of_package().read("RobotContacts", &robot_contacts_message(&robot, NOW_US, &contacts));
    let line = serde_json::to_value(RobotContactsLine::of(&robot, NOW_US, &contacts)).unwrap();
    assert_eq!(read["header"]["stamp"], json!({ "sec": 1_700_000_000, "nanosec": 250_000_000 }));
    let (told, lines) = (read["contacts"].as_array().unwrap(), line["contacts"].as_array().unwrap());
    assert_eq!(told.len(), 2);
    let near =
        |a: &Value, b: &Value, scale: f64| (a.as_f64().unwrap() - b.as_f64().unwrap() / scale).abs() < 1e-12;
    for (own, line) in told.iter().zip(lines) {
        for key in ["id", "board", "panel_name", "total", "peak", "area", "x", "y", "duration"] {
            assert_eq!(own[key], line[key], "{key}");
        }
        assert_eq!(own["force"], line.get("force_n").cloned().unwrap_or(Value::Null));
        assert!(
            near(&own["position"]["x"], &line["x_mm"], 1e3)
                && near(&own["position"]["y"], &line["y_mm"], 1e3)
        );
        assert!(near(&own["age"], &line["age_us"], 1e6));
        for (own, line) in own["parts"].as_array().unwrap().iter().zip(line["parts"].as_array().unwrap()) {
            assert_eq!((&own["board"], &own["total"]), (&line["board"], &line["total"]));
            assert_eq!(own["is_contact"].as_bool().unwrap(), line["contact"].is_u64());
            assert_eq!(own["contact"].as_u64().unwrap(), line["contact"].as_u64().unwrap_or(0));
            assert!(near(&own["age"], &line["age_us"], 1e6));
        }
        assert_eq!(own["parts"].as_array().unwrap().len(), 2);
    }
    assert_eq!((&told[0]["phase"], &told[1]["phase"]), (&json!(1), &json!(2)));
}
