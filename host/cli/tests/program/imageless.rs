//! A board that sends no image, because its scene asks for none or its scan fails, ends a run of limited time.

use super::answering_board::answering_board;
use super::robot::folder;
use crate::start::taxel;
use serde_json::Value;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::thread;
use std::time::Instant;

fn run(folder: &Path, args: &[&str]) -> Output {
    Command::new(taxel()).current_dir(folder).args(args).stdin(Stdio::null()).output().unwrap()
}

#[test]
fn a_run_of_limited_time_ends_without_images() {
    let source = || format!("tcp:{}", answering_board(Instant::now(), None));
    let folder = folder(
        "imageless",
        &format!("name = \"one\"\n[[boards]]\nname = \"a\"\nsource = \"{}\"\n", source()),
    );
    let [for_seconds, for_frames, doctor, recorded, why] = [source(), source(), source(), source(), source()];
    _ = std::fs::remove_file(folder.join("r.mcap"));
    let runs: [(&[&str], i32, &str); 6] = [
        (&["live", "--source", &for_seconds, "--for", "1s"], 0, "no image came for 10 s"),
        (&["live", "--source", &for_frames, "--frames", "3"], 3, "no image came for 10 s"),
        (&["doctor", "--source", &doctor, "--for", "1s"], 3, "the scan fails"),
        (
            &["record", "--source", &recorded, "--garment", "reference", "--for", "1s", "-o", "r.mcap"],
            0,
            "0 frames",
        ),
        (&["fcm", "why", "--source", &why, "--at", "1s"], 1, "no intention was reported in the first 1 s"),
        (&["live", "robot.toml", "--for", "1s"], 0, "no image came for 10 s"),
    ];
    thread::scope(|scope| {
        for (args, status, says) in runs {
            let folder = &folder;
            scope.spawn(move || {
                let done = run(folder, args);
                let said = String::from_utf8_lossy(&done.stderr) + String::from_utf8_lossy(&done.stdout);
                assert_eq!(done.status.code(), Some(status), "{args:?}: {said}");
                assert!(said.contains(says), "{args:?}: {said}");
            });
        }
    });
    let info = run(&folder, &["info", "r.mcap", "--json"]);
    let printed: Value = serde_json::from_slice(&info.stdout).unwrap();
    assert!(printed["seconds"].as_f64().is_some_and(|seconds| seconds < 60.0), "{printed}");
}
