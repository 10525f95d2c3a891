//! A robot's joints as lines of a file and of the standard input: poses, recordings, wrong lines.

use serde_json::Value;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use taxel::recording::Messages;

const JOINTS: [&str; 7] = [
    "waist",
    "left_shoulder_pitch",
    "left_shoulder_roll",
    "left_shoulder_yaw",
    "right_shoulder_pitch",
    "right_shoulder_roll",
    "right_shoulder_yaw",
];
const ROBOT: [&str; 6] = ["--source", "sim:five", "--body", "reference", "--robot", "reference"];

fn file(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("joints");
    std::fs::create_dir_all(&folder).unwrap();
    folder.join(name)
}

/// Runs the program with this standard input.
fn run(args: &[&str], input: &str) -> Output {
    let mut program = Command::new(env!("CARGO_BIN_EXE_taxel"));
    program.args(args).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut running = program.spawn().unwrap();
    // It may have ended already, over its arguments.
    let _ = running.stdin.take().unwrap().write_all(input.as_bytes());
    running.wait_with_output().unwrap()
}

/// A line of all joints at this position.
fn line(time: &str, position: f64) -> String {
    let positions: Vec<String> = JOINTS.iter().map(|joint| format!("\"{joint}\": {position}")).collect();
    format!("{{{time}\"positions\": {{{}}}}}\n", positions.join(", "))
}

/// Messages of a recording's topic.
fn messages(path: &Path, topic: &'static str) -> Vec<Value> {
    let mut messages = Messages::of_topic(path, topic).unwrap();
    let mut all = Vec::new();
    while let Some(message) = messages.next_message().unwrap() {
        all.push(serde_json::from_slice(message.data).unwrap());
    }
    all
}

#[test]
fn a_recording_holds_joints_poses_and_what_presses() {
    let (states, recording) = (file("states.jsonl"), file("posed.mcap"));
    let lines: String =
        (0..200).map(|number| line(&format!("\"time_us\": {}, ", number * 20_000), 0.3)).collect();
    std::fs::write(&states, lines).unwrap();
    let (states, output) = (states.to_str().unwrap(), recording.to_str().unwrap());
    let more = ["--joint-states", states, "--realtime", "--for", "3s", "--ros2", "--force", "-o", output];
    let done = run(&[&["record"][..], &ROBOT, &more].concat(), "");
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    let joints = messages(&recording, "/taxel/joints");
    assert!(joints.len() > 50, "{}", joints.len());
    for (number, joint) in joints.iter().enumerate() {
        assert_eq!(
            (&joint["time_us"], &joint["positions"]["waist"]),
            (&(number * 20_000).into(), &0.3.into())
        );
    }
    let poses = messages(&recording, "/taxel/poses");
    let torso = poses[0]["links"].as_array().unwrap().iter().find(|pose| pose["link"] == "torso").unwrap();
    assert!(poses.len() > 20 && (torso["turn"][2].as_f64().unwrap() - 0.15f64.sin()).abs() < 1e-8, "{torso}");
    let posed = messages(&recording, "/taxel/pressing");
    let posed: Vec<&Value> = posed.iter().filter(|report| report["pose_age_us"].is_i64()).collect();
    assert!(
        posed.len() > 20 && posed.iter().any(|report| report["pose_error_m"].is_f64()),
        "{}",
        posed.len()
    );
    let bag = taxel::recording::scan(&recording.with_extension("ros2.mcap")).unwrap().contents;
    assert!(bag.messages("/tactile/links/torso/wrench") > 20);
    // The recording's lines are of the form that is read.
    std::fs::write(states, joints.iter().map(|joint| format!("{joint}\n")).collect::<String>()).unwrap();
    let more = ["--joint-states", states, "--realtime", "--for", "2s", "--json"];
    let done = run(&[&["live"][..], &ROBOT, &more].concat(), "");
    let printed = String::from_utf8(done.stdout).unwrap();
    assert!(
        done.status.success()
            && printed.lines().filter(|line| line.contains("\"pose_error_m\":0.")).count() > 20
    );
    // No output replaces the file of the joints.
    let over =
        run(&[&["record"][..], &ROBOT, &["--joint-states", states, "--force", "-o", states]].concat(), "");
    assert!(!over.status.success() && std::fs::read_to_string(states).unwrap().starts_with('{'));
}

#[test]
fn joints_come_on_the_standard_input() {
    let more = ["--joint-states", "-", "--realtime", "--for", "2s", "--json"];
    let times =
        ["\"time_us\": 300000, ", "\"time_us\": 400000, ", "\"time_us\": 500000, ", "\"time_us\": 600000, "];
    let input: String = times.iter().map(|time| line(time, 0.0)).collect();
    let done = run(&[&["live"][..], &ROBOT, &more].concat(), &input);
    let printed = String::from_utf8(done.stdout).unwrap();
    let posed =
        printed.lines().filter(|line| line.contains("\"request\":\"set-poses\",\"refusal\":null")).count();
    assert!(done.status.success() && (2..100).contains(&posed), "{posed}");
}

#[test]
fn wrong_joints_are_one_sentence_and_wrong_use() {
    let live = [&["live"][..], &ROBOT, &["--joint-states", "-", "--for", "9s", "--json"]].concat();
    let done = run(&live, "{\"positions\": {\"wast\": 1}}\n");
    let error = String::from_utf8(done.stderr).unwrap();
    let why = "standard input, line 1: reference: there is no joint \"wast\": did you mean \"waist\"?";
    assert!(!done.status.success() && error.contains(why) && error.lines().count() == 1, "{error}");
    let pat = ["live", "--source", "sim:pat"];
    let robot = ["--body", "reference", "--robot", "reference"];
    for (words, why) in [
        (&["--robot", "reference"][..], "--body <BODY>"),
        (&["--body", "reference", "--joint-states", "-"], "--robot <URDF>"),
        (&[&robot[..], &["--poses", "0"]].concat(), "must be 0.1 to 1000"),
        (&[&robot[..], &["--motion", "fast=1"]].concat(), "\"fast=1\": the name must be angular, linear"),
    ] {
        let done = run(&[&pat[..], words].concat(), "");
        let error = String::from_utf8(done.stderr).unwrap();
        assert!(done.status.code() == Some(2) && error.contains(why), "{words:?}: {error}");
    }
}
