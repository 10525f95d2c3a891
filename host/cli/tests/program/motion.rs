//! `taxel motion` from outside: the demonstration, and a robot whose joints are told by lines.

use super::called::{answer, refused};
use super::robot::folder;
use crate::start::taxel;
use serde_json::Value;
use std::io::{BufRead, BufReader, Write};
use std::process::{Child, ChildStdin, Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

const ROBOT: &str = "name = \"one\"\nurdf = \"reference\"\n[[boards]]\nname = \"skin\"\nsource = \"sim:SCENE\"\n\
    garment = \"reference\"\nbody = \"reference\"\n";
/// A machine that has other work is late: a second is still in time here.
const BEHAVIOUR: &str = "name = \"patient\"\n[faults]\nposture_ms = 1000\nframe_ms = 1000\ncycle_ms = 1000\n\
    [[when]]\nnewtons = 1\ndo = \"retreat\"\n";
/// Longest time that a test waits for a line.
const PATIENCE: Duration = Duration::from_secs(60);

#[test]
fn the_demonstration_pats_pushes_clamps_and_leads() {
    let text = answer(&["motion", "--demo"]);
    let scenes: Vec<&str> = text.split("\n\n").collect();
    let [pat, push, clamp, lead, _] = scenes[..] else { panic!("{text}") };
    let moved = |scene: &str| -> f64 {
        let last = scene.trim().lines().last().unwrap().split_whitespace();
        last.rev().nth(1).unwrap().parse().unwrap()
    };
    assert!(pat.contains("slow") || pat.contains("speed 0.00"), "{pat}");
    assert_eq!((moved(pat), moved(clamp)), (0.0, 0.0), "{text}");
    assert!(push.contains("retreat") && moved(push) > 10.0, "{push}");
    assert!(clamp.contains("clamped"), "{clamp}");
    assert!(lead.contains("yield") && moved(lead) > 50.0, "{lead}");
}

#[test]
fn what_is_missing_is_said() {
    refused(2, &["motion", "sim:pat"], &["name a robot's file"]);
    let file = folder("motion-bare", "name = \"x\"\n[[boards]]\nname = \"a\"\nsource = \"sim:pat\"\n");
    let file = file.join("robot.toml").display().to_string();
    refused(2, &["motion", &file], &["the robot needs a `urdf`"]);
    let file = folder("motion-wrong", &ROBOT.replace("SCENE", "idle"));
    let file = file.join("robot.toml").display().to_string();
    refused(2, &["motion", &file, "--behaviour", "poeple"], &["did you mean \"people\""]);
}

/// A robot that is followed, with its joints at rest.
struct Followed {
    program: Child,
    joints: ChildStdin,
    lines: std::sync::mpsc::Receiver<Value>,
}

impl Followed {
    fn start(name: &str, scene: &str, more: &[&str]) -> Followed {
        let folder = folder(name, &ROBOT.replace("SCENE", scene));
        std::fs::write(folder.join("behaviour.toml"), BEHAVIOUR).unwrap();
        let args = ["motion", "robot.toml", "--behaviour", "behaviour.toml", "--requests", "-"];
        let mut program = Command::new(taxel())
            .current_dir(folder)
            .args(args)
            .args(more)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let (sender, lines) = std::sync::mpsc::channel();
        let output = BufReader::new(program.stdout.take().unwrap());
        thread::spawn(move || {
            let lines = output.lines().map_while(Result::ok);
            lines.for_each(|line| _ = sender.send(serde_json::from_str(&line).unwrap()));
        });
        let joints = program.stdin.take().unwrap();
        Followed { program, joints, lines }
    }

    /// The first line that is so, while the joints are told or not.
    fn until(&mut self, is_told: bool, is_so: impl Fn(&Value) -> bool) -> Value {
        let robot = taxel::body::robot::read("reference").unwrap();
        let names = robot.free().iter().map(|joint| format!("\"{}\": 0", robot.joints()[*joint].name));
        let line = format!("{{\"positions\": {{{}}}}}\n", names.collect::<Vec<_>>().join(", "));
        let begun = Instant::now();
        loop {
            if is_told {
                self.joints.write_all(line.as_bytes()).unwrap();
            }
            thread::sleep(Duration::from_millis(10));
            if let Some(line) = self.lines.try_iter().find(&is_so) {
                return line;
            }
            assert!(begun.elapsed() < PATIENCE, "no such line");
        }
    }
}

impl Drop for Followed {
    fn drop(&mut self) {
        let _ = self.program.kill();
        let _ = self.program.wait();
    }
}

fn moves(line: &Value) -> bool {
    line["velocities"].as_object().unwrap().values().any(|velocity| velocity != 0.0)
}

#[test]
fn a_robot_is_moved_and_stops_when_its_joints_are_told_no_more() {
    let mut robot = Followed::start("motion-five", "five", &["--arm"]);
    let line = robot.until(true, moves);
    assert_eq!(
        (&line["phase"], &line["deed"], &line["speed"]),
        (&"armed".into(), &"retreat".into(), &0.0.into())
    );
    let cause = &line["causes"][0];
    assert!(
        cause["do"] == "retreat" && cause["row"] == 0 && cause["newtons"].as_f64().unwrap() >= 1.0,
        "{line}"
    );
    let line = robot.until(false, |line| line["phase"] == "stopped");
    assert_eq!((&line["fault"], &line["speed"]), (&"stale_posture".into(), &0.0.into()));
    assert!(!moves(&line));
}

#[test]
fn a_robot_between_two_hands_is_clamped() {
    let mut robot = Followed::start("motion-hands", "two-hands", &["--arm"]);
    let line = robot.until(true, |line| line["deed"] == "clamped");
    assert!(!moves(&line) && line["causes"].as_array().unwrap().len() >= 2, "{line}");
}

#[test]
fn nobody_arms_it_unasked() {
    let mut robot = Followed::start("motion-unarmed", "five", &["--for", "2s"]);
    robot.until(true, |line| line["phase"] == "disarmed" && line["speed"].is_null());
    thread::sleep(Duration::from_secs(2));
    assert!(robot.lines.try_iter().all(|line| line["phase"] == "disarmed" && !moves(&line)));
}
