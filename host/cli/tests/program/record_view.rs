//! `taxel record --view`, from outside.

use super::robot::folder;
use super::robot_view::{Viewed, held, line};
use crate::start::taxel;
use std::process::Command;
use tungstenite::Message;

#[test]
fn a_board_is_watched_while_it_is_recorded_and_the_recording_is_the_same() {
    let folder = folder("board-record-view", "");
    let record = |file: &'static str| {
        ["record", "--source", "sim:five", "--realtime", "--for", "3s", "--force", "-o", file]
    };
    let args = [&record("watched.mcap")[..], &["--view"]].concat();
    let mut viewed = Viewed::run(&folder, &args, "sim:five");
    let [mut page, _asleep] = ["/socket", "/socket"].map(|path| viewed.page(path));
    page.send(Message::text("{\"hover\": 9}")).unwrap();
    line(&mut page, "hello", |line| line["garment"] == "reference");
    while !page.read().unwrap().is_binary() {}
    assert!(viewed.0.wait().unwrap().success());
    let alone = Command::new(taxel()).current_dir(&folder).args(record("alone.mcap")).output().unwrap();
    assert!(alone.status.success());
    let [watched, alone] = ["watched.mcap", "alone.mcap"].map(|file| held(&folder.join(file), &["/taxel/"]));
    let counted = |held: &[(String, Vec<Vec<u8>>)]| {
        held.iter().map(|(topic, all)| (topic.clone(), all.len())).collect::<Vec<_>>()
    };
    assert_eq!(counted(&watched), counted(&alone));
    assert!(watched == alone);
    assert!(alone.iter().any(|(topic, all)| topic == "/taxel/frames" && all.len() > 500));
}

#[test]
fn what_is_said_of_a_page_needs_one() {
    let folder = folder("board-record-unseen", "");
    let args = ["record", "--source", "sim:five", "-o", "out.mcap", "--port", "0"];
    let done = Command::new(taxel()).current_dir(&folder).args(args).output().unwrap();
    assert_eq!(done.status.code(), Some(2));
    assert!(String::from_utf8(done.stderr).unwrap().contains("--view"));
    assert!(!folder.join("out.mcap").exists());
}
