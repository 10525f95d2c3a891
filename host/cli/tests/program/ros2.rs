//! `taxel ros2` from outside; what it publishes is tested with ROS (`cargo xtask ros2`).

mod calls;
mod lost;
mod peer;
mod quality;

use super::robot::folder;
use std::process::{Command, Output};

fn taxel(args: &[&str], domain: &str) -> Output {
    Command::new(env!("CARGO_BIN_EXE_taxel")).args(args).env("ROS_DOMAIN_ID", domain).output().unwrap()
}

#[test]
fn wrong_names_and_domains_are_wrong_use() {
    for (words, domain, why) in [
        (&["--domain", "233"][..], "", "must be a whole number from 0 to 232"),
        (&[], "many", "must be a whole number from 0 to 232"),
        (&["--namespace", "left"], "", "--namespace left: must be / or like /left/arm"),
        (&["--name", "a b"], "", "--name a b: must be letters, digits and single underscores"),
        (&["--image-hz", "-1"], "", "must be 0 to 1000"),
    ] {
        let output = taxel(&[&["ros2", "--source", "sim:pat"], words].concat(), domain);
        let error = String::from_utf8(output.stderr).unwrap();
        assert!(output.status.code() == Some(2) && error.contains(why), "{words:?}: {error}");
    }
}

/// Nobody listens: it is as quick.
#[test]
fn a_node_ends_with_its_source() {
    let output = taxel(&["ros2", "--source", "sim:pat", "--for", "1s", "--domain", "231"], "");
    let said = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert_eq!(said, "sim:pat as node /taxel in domain 231 (Ctrl-C ends)\n");
}

#[test]
fn the_nodes_of_a_robot_end_with_its_boards() {
    let robot = "name = \"two\"\n[[boards]]\nname = \"torso\"\nsource = \"sim:five\"\n\
                 [[boards]]\nname = \"left-hand\"\nsource = \"sim:press\"\ngarment = \"block-4x16\"\n";
    let folder = folder("ros2", robot);
    let file = folder.join("robot.toml").display().to_string();
    let words = ["ros2", &file, "--for", "1s", "--domain", "230", "--namespace", "/skin"];
    let output = taxel(&words, "");
    let said = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert_eq!(said, "robot two as node /skin/taxel in domain 230 (Ctrl-C ends)\n");
    std::fs::write(&file, robot.replace("torso", "left_hand")).unwrap();
    let output = taxel(&words, "");
    let error = String::from_utf8(output.stderr).unwrap();
    let why = "boards left_hand and left-hand are both left_hand in ROS";
    assert!(output.status.code() == Some(2) && error.contains(why), "{error}");
}

#[test]
fn the_launch_file_uses_options_that_there_are() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/ros2/taxel.launch.py");
    let text = std::fs::read_to_string(path).unwrap();
    let help = String::from_utf8(taxel(&["ros2", "--help"], "").stdout).unwrap();
    let options: Vec<&str> = text.split('"').filter(|word| word.starts_with("--")).collect();
    assert!(options.len() > 2);
    for option in options {
        assert!(help.contains(&format!("{option} <")), "{option}");
    }
}
