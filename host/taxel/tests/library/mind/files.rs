//! Maps of a robot as files.

use super::touched::robot;
use serde_json::json;
use std::path::Path;
use taxel::fcm::{load, scene};
use taxel::mind::{HostInputLine, RobotMind, Senses};
use taxel::robot::ReadRobot;

const MAP: &str = "name = \"m\"\n[[concept]]\nname = \"x\"\n[[concept]]\nname = \"kindness\"\n\
                   [[edge]]\nfrom = \"x\"\nto = \"kindness\"\nweight = 1\n[[input]]\nconcept = \"x\"\n";

fn refused(input: &str) -> String {
    let map = load::parse(&format!("{MAP}{input}\n"), "map.toml");
    map.and_then(|map| RobotMind::with(map, Senses::new(1, None))).unwrap_err().to_string()
}

#[test]
fn mistakes_in_a_map_of_a_robot_are_named() {
    for (input, why) in [
        ("rise = [0, 1]", "input x: source is missing"),
        ("source = \"press\"\nrise = [0, 1]", "input x is of one board"),
        (
            "source = \"press\"\nrobot = { host_input = \"voice\" }\nrise = [0, 1]",
            "input x: give either source or robot",
        ),
        (
            "robot = { load = \"chest\" }\nrise = [0, 1]",
            "map.toml, line 12, `load`: must be a list, not \"chest\"",
        ),
        ("robot = { lode = [] }\nrise = [0, 1]", "lode"),
        ("robot = { intent = \"none\" }\nrise = [0, 1]", "input x: no board's intention is none"),
        (
            "source = \"press\"\ntimeout_ms = 3\nrise = [0, 1]",
            "timeout_ms and default are for what a robot knows",
        ),
        ("robot = { host_input = \"voice\" }", "give exactly one of rise, fall, triangle and trapezoid"),
    ] {
        let reported = refused(input);
        assert!(reported.contains(why), "{input}: {reported}");
    }
}

#[test]
fn a_map_of_a_robot_survives_being_read_and_written_and_no_board_takes_it() {
    let map = load::map("robot").unwrap();
    assert_eq!(load::parse(&toml::to_string(&map).unwrap(), "robot.toml").unwrap(), map);
    assert!(map.concept.iter().all(|c| !c.note.is_empty()) && map.edge.iter().all(|e| !e.note.is_empty()));
    let mut board = json!({ "intent": { "map": "robot" } });
    let reported = scene::resolve(&mut board, Path::new(".")).unwrap_err().to_string();
    assert_eq!(reported, "intent.map: input board kindness is of a robot, which no board knows");
}

#[test]
fn a_robot_s_file_names_its_map() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    std::fs::write(
        folder.join("own.toml"),
        format!("{MAP}robot = {{ host_input = \"voice\" }}\nrise = [0, 32768]\n"),
    )
    .unwrap();
    let text = |map: &str| {
        format!("name = \"r\"\nmaps = [\"{map}\"]\n[[boards]]\nname = \"b\"\nsource = \"sim:idle\"\n")
    };
    let read = |map: &str| ReadRobot::parse("r.toml".into(), text(map), folder);
    let own = read("own.toml").unwrap().map;
    assert!(own.name == "robot" && own.find("x") == Some(0) && own.concept.len() == 2);
    let both = read("robot\", \"probe").unwrap().map;
    assert_eq!(
        both,
        ReadRobot::parse("r.toml".into(), text("robot").replacen("maps", "#", 1), folder).unwrap().map
    );
    let two = load::map("robot").unwrap().concept.len() + load::map("probe").unwrap().concept.len();
    // Own, kindness, threat and attack are those of both.
    assert_eq!(both.concept.len(), two - 4);
    std::fs::write(
        folder.join("other.toml"),
        format!("{MAP}robot = {{ host_input = \"vision\" }}\nrise = [0, 9]\n"),
    )
    .unwrap();
    let reported = format!("{:#}", read("own.toml\", \"other.toml").unwrap_err());
    assert!(reported.contains("the input of x in m differs from that of the map before"), "{reported}");
    let reported = format!("{:#}", read("robto").unwrap_err());
    assert_eq!(
        reported,
        "r.toml, line 2, `maps`: the map of the robot: there is no map \"robto\": did you mean \"robot\"? \
         Known are tactile, shape, robot, probe, or give a .toml file"
    );
}

#[test]
fn what_no_host_input_can_be_is_named() {
    let mut mind = RobotMind::new(&robot([None; 2])).unwrap();
    let mut reported = |line: &str| {
        HostInputLine::parse(line)
            .and_then(|line| mind.take_input(&line, 1).map(drop))
            .unwrap_err()
            .to_string()
    };
    assert_eq!(
        reported("{\"host_input\": {\"vison\": 0.8}}"),
        "there is no name of a host input \"vison\": did you mean \"vision\"? Known are vision, voice, plan"
    );
    assert_eq!(reported("{\"host_input\": {\"vision\": 1.8}}"), "vision is 1.8, and must be -1 to 1");
    assert!(reported("{\"positions\": {\"elbow\": 1}}").contains("there is no joint \"elbow\""));
    assert!(reported("{\"tolled\": 3}").starts_with("no host input: unknown field `tolled`"));
}
