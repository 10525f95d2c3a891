//! Recordings saved from the page work with every other command, including newtons.

use super::stage::{PROGRAM, View, file, moments, recorded};
use crate::mat::{box_for, knee};
use serde_json::{Value, json};
use std::path::Path;
use std::process::Command;

fn info(path: &Path) -> Value {
    let output = Command::new(PROGRAM).args(["info", "--json"]).arg(path).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

#[test]
fn a_range_is_saved_to_the_image_and_every_command_reads_it() {
    let path = recorded("range.mcap", "sim:pat", 8, &[]);
    let (all, view) = (moments(&path), View::start(&[path.to_str().unwrap()]));
    let mut page = view.page();
    page.stand();
    // During the second pat.
    page.ask(json!({ "range": [0.55, 6.25] }));
    page.line("player", |line| line["range"] == json!([0.55, 6.25]));
    let saved = view.save("saved.mcap");
    let first = all.iter().rposition(|moment| moment.at <= 550_000).unwrap();
    let wanted: Vec<_> = all[first..].iter().take_while(|moment| moment.at <= 6_250_000).collect();
    let found = moments(&saved);
    assert_eq!(found.len(), wanted.len());
    for (found, wanted) in found.iter().zip(wanted) {
        assert_eq!(found.image, wanted.image);
        assert_eq!(found.line["time_us"], wanted.line["time_us"]);
        assert_eq!(found.line["contacts"], wanted.line["contacts"]);
        assert_eq!(found.line["intent"], wanted.line["intent"]);
    }
    let printed = info(&saved);
    assert_eq!(
        (&printed["whole"], &printed["lost"], &printed["undecoded"]),
        (&json!(true), &json!(0), &json!(0))
    );
    assert_eq!(printed["metadata"]["taxel"]["counts_per_newton"], "1000");
    let (first, of) = (&printed["start_us"], &info(&path)["start_us"]);
    let later = first.as_u64().unwrap() - of.as_u64().unwrap();
    assert!((540_000..=550_000).contains(&later), "it begins {later} us later");
    for arguments in [
        vec!["live", saved.to_str().unwrap(), "--json"],
        vec!["report", saved.to_str().unwrap(), "-o", file("saved.html").to_str().unwrap()],
        vec!["export", saved.to_str().unwrap(), "--to", "csv", "-o", file("saved.csv").to_str().unwrap()],
    ] {
        let output = Command::new(PROGRAM).args(&arguments).output().unwrap();
        assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    }
}

#[test]
fn the_calibration_stays_with_what_is_saved() {
    let (scene, certificate) = (file("block.toml"), file("block.calibration.toml"));
    std::fs::write(&scene, box_for(4)).unwrap();
    knee().write(&certificate).unwrap();
    let calibration = ["--calibration", certificate.to_str().unwrap()];
    let source = format!("sim:{}", scene.display());
    let path = recorded("calibrated.mcap", &source, 4, &calibration);
    // Cut from a recording, and from a live board.
    let view = View::start(&[path.to_str().unwrap()]);
    let mut page = view.page();
    page.stand();
    page.ask(json!({ "range": [1, 2] }));
    page.line("player", |line| line["range"] == json!([1.0, 2.0]));
    let cut = view.save("cut.mcap");
    let live = View::start(&["--source", &source, calibration[0], calibration[1]]);
    live.page().image(|line| line["time_us"].as_u64().is_some_and(|time| time > 1_500_000));
    let kept = live.save("kept.mcap");
    for (index, saved) in [cut, kept].iter().enumerate() {
        let printed = info(saved);
        let words = &printed["metadata"]["taxel"];
        assert_eq!((&words["calibration_by"], &printed["lost"]), (&json!("Anna"), &json!(0)), "{printed}");
        assert!(printed["attachments"].as_array().unwrap().contains(&json!("calibration.toml")));
        assert!(printed["frames"].as_u64().is_some_and(|frames| frames > 100), "{printed}");
        let table = file(&format!("kept-{index}.csv"));
        let mut export = Command::new(PROGRAM);
        export.args(["export", "--to", "csv", "-o"]).arg(&table).arg(saved);
        let output = export.output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        assert!(std::fs::read_to_string(&table).unwrap().contains("kPa"));
    }
}

#[test]
fn only_the_page_may_save() {
    let path = recorded("guarded.mcap", "sim:idle", 1, &[]);
    let view = View::start(&[path.to_str().unwrap()]);
    let (head, _) = view.get("/recording.mcap", "Origin: http://evil.example\r\n");
    assert!(head.starts_with("HTTP/1.1 403"), "{head}");
    let (head, _) = view.get("/recording.mcap?x=../y", "");
    assert!(head.starts_with("HTTP/1.1 200"), "{head}");
}
