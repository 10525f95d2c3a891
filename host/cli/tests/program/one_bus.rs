//! `taxel doctor` of boards that report the starts of a USB's frames: who shares a controller.

use super::answering_board::answering_board;
use super::robot::folder;
use crate::start::taxel;
use serde_json::Value;
use std::process::{Command, Stdio};
use std::time::Instant;

/// Names of the boards, and the number of their controller's frame when the first one is made; none without a bus.
const BOARDS: [(&str, Option<u64>); 4] =
    [("left", Some(0)), ("right", Some(700)), ("back", Some(0)), ("away", None)];

#[test]
fn the_doctor_says_which_boards_share_a_controller() {
    let began = Instant::now();
    let mut robot = String::from("name = \"bus\"\n");
    for (name, first) in BOARDS {
        let address = answering_board(began, first);
        robot += &format!("[[boards]]\nname = \"{name}\"\nsource = \"tcp:{address}\"\n");
    }
    let folder = folder("bus", &robot);
    let mut doctor = Command::new(taxel());
    doctor.current_dir(&folder).args(["doctor", "robot.toml", "--for", "3s", "--json"]);
    let printed = doctor.stdin(Stdio::null()).output().unwrap();
    let printed: Value = serde_json::from_slice(&printed.stdout).unwrap();
    let controller = |at: usize| {
        let found = printed["boards"][at]["findings"].as_array().unwrap();
        let found = found.iter().find(|it| it["of"] == "controller");
        found.map(|it| it["what"].as_str().unwrap().to_string())
    };
    let shares = |at, with: &str| controller(at).is_some_and(|what| what.ends_with(&format!("with {with}")));
    assert!(shares(0, "back") && shares(2, "left"), "{printed}");
    assert!(controller(1).is_some_and(|what| what.starts_with("no other board")), "{printed}");
    assert_eq!(controller(3), None, "{printed}");
}
