//! All pages share one player; a later page gets the whole state, and nonsense is ignored.

use super::stage::{PageMessage, View, moments, recorded};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::ops::Range;

#[test]
fn a_page_that_comes_late_sees_the_whole_recording_and_the_moment() {
    let path = recorded("late.mcap", "sim:pat", 6, &[]);
    let view = View::start(&["--source", &format!("replay:{}", path.display())]);
    let mut early = view.page();
    let mut seeks = early.stand();
    early.overview();
    let (shown, ..) = early.seek(0.64, &mut seeks);
    let (mut late, mut printed) = (view.page(), BTreeMap::new());
    let image = loop {
        match late.next() {
            PageMessage::Line(line) => _ = printed.insert(line["type"].as_str().unwrap().to_string(), line),
            PageMessage::Image(line, _) => break line,
        }
    };
    assert_eq!(image, shown);
    let player = &printed["player"];
    assert_eq!((&player["playing"], &player["at"]), (&json!(false), &json!(0.64)));
    assert_eq!(printed["hello"]["counts_per_newton"], 1000.0);
    let overview = &printed["overview"];
    assert_eq!(overview["known_us"], overview["duration_us"]);
    // Each touch has its mark at its time, and its force on the line.
    let onsets = |all: &Value| all.as_array().unwrap().iter().filter(|line| line[1] == "onset").count();
    let mut ids: Vec<u64> = moments(&path)
        .iter()
        .flat_map(|moment| moment.line["contacts"].as_array().unwrap().clone())
        .map(|contact| contact["id"].as_u64().unwrap())
        .collect();
    ids.sort_unstable();
    ids.dedup();
    assert_eq!((onsets(&overview["said"]), ids.len()), (3, 3));
    assert!(overview["intentions"].as_array().unwrap().iter().any(|change| change[1] == "kindness"));
    let most = moments(&path).iter().map(|moment| total(&moment.line)).max().unwrap();
    let drawn = overview["totals"].as_array().unwrap().iter().filter_map(Value::as_u64).max().unwrap();
    assert_eq!(drawn, most);
    // Requests of one page affect the others.
    late.ask(json!({ "seek": 1.5 }));
    early.line("player", |line| line["at"] == 1.5);
}

fn total(line: &Value) -> u64 {
    line["contacts"].as_array().unwrap().iter().map(|contact| contact["total"].as_u64().unwrap()).sum()
}

#[test]
fn nonsense_moves_nothing() {
    let path = recorded("nonsense.mcap", "sim:idle", 2, &[]);
    let view = View::start(&[path.to_str().unwrap()]);
    let mut page = view.page();
    let mut seeks = page.stand();
    page.seek(1.0, &mut seeks);
    for nonsense in [
        r#"{"seek": 1e999}"#,
        r#"{"seek": NaN}"#,
        r#"{"seek": "1"}"#,
        r#"{"speed": 0}"#,
        r#"{"speed": -1}"#,
        r#"{"step": 0}"#,
        r#"{"step": 99999999999}"#,
        r#"{"range": [0]}"#,
        r#"{"range": [0.5, 0.5]}"#,
        r#"{"play": "yes"}"#,
        "{",
    ] {
        page.say(nonsense);
    }
    page.ask(json!({ "loop": true }));
    let player = page.line("player", |line| line["loop"] == true);
    assert_eq!(
        (&player["at"], &player["speed"], &player["seeks"]),
        (&json!(1.0), &json!(1.0), &json!(seeks))
    );
    assert_eq!(player["range"], json!([0.0, player["duration"]]));
    page.ask(json!({ "seek": -7 }));
    assert_eq!(page.line("player", |line| line["seeks"] == seeks + 1)["at"], 0.0);
    page.ask(json!({ "seek": 1e9 }));
    let player = page.line("player", |line| line["seeks"] == seeks + 2);
    assert_eq!(player["at"], player["duration"]);
    page.ask(json!({ "speed": 1e9 }));
    page.line("player", |line| line["speed"] == 64.0);
}

/// Ranges of the contents of an MCAP file's chunks.
fn chunks(bytes: &[u8]) -> Vec<Range<usize>> {
    const CHUNK: u8 = 6;
    let (mut at, mut found) = (8, Vec::new());
    while let Some(length) = bytes.get(at + 1..at + 9) {
        let length = u64::from_le_bytes(length.try_into().unwrap()) as usize;
        if bytes[at] == CHUNK {
            found.push(at + 9..at + 9 + length);
        }
        at += 9 + length;
    }
    found
}

#[test]
fn a_damaged_part_is_a_gap_and_what_is_no_recording_is_named() {
    let path = recorded("damaged.mcap", "sim:pat", 8, &[]);
    let mut bytes = std::fs::read(&path).unwrap();
    // In the middle of a middle chunk of the wire, before those of JSON and of images: indexes and attachments
    // elsewhere are not missed.
    let chunks = chunks(&bytes);
    let chunk = chunks[chunks.len() / 2 / 3 * 3].clone();
    let middle = (chunk.start + chunk.end) / 2;
    bytes[middle..middle + 64].fill(0x5a);
    std::fs::write(&path, &bytes).unwrap();
    let view = View::start(&[path.to_str().unwrap()]);
    let mut page = view.page();
    let overview = page.overview();
    let gaps = |line: &Value| line["said"].as_array().unwrap().iter().filter(|said| said[1] == "gap").count();
    assert!(gaps(&overview) >= 1, "{}", overview["said"]);
    let mut seeks = page.stand();
    let (line, ..) = page.seek(7.5, &mut seeks);
    assert!(line["at_us"].as_u64().is_some_and(|at| at > 7_000_000), "{line}");
    std::fs::write(&path, "no recording").unwrap();
    let mut view = std::process::Command::new(super::stage::PROGRAM);
    let output = view.args(["view", "--port", "0"]).arg(&path).output().unwrap();
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(!output.status.success() && said.contains("damaged.mcap") && said.lines().count() == 1, "{said}");
}

#[test]
fn a_page_that_is_loaded_again_has_the_live_half_minute() {
    let view = View::start(&["--source", "sim:pat"]);
    let mut first = view.page();
    let (line, _) = first.image(|line| line["time_us"].as_u64().is_some_and(|time| time > 3_000_000));
    let mut again = view.page();
    let (mut past, mut touched, mut last) = (0, 0, 0);
    let newest = loop {
        let PageMessage::Image(line, _) = again.next() else { continue };
        let time = line["time_us"].as_u64().unwrap();
        if line["past"] != true {
            break time;
        }
        assert!(time > last, "{time} after {last}");
        (past, last) = (past + 1, time);
        touched += usize::from(line["contacts"].as_array().is_some_and(|contacts| !contacts.is_empty()));
    };
    let known = line["time_us"].as_u64().unwrap();
    assert!(last + 500_000 > known && newest + 500_000 > last, "{last}, {newest} of {known}");
    // Sixty per second, including the pats.
    assert!(past > 100 && touched > 20, "{past} images, {touched} of touches");
}
