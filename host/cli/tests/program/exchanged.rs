//! A board that is lost, and another one that answers in its place: what is reported, shown and recorded.

mod table;

use super::called::file;
use super::socket::Socket;
use crate::start::taxel;
use serde_json::Value;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};
use taxel::recording::Messages;

/// Longest wait for what a test expects.
const PATIENCE: Duration = Duration::from_secs(30);

fn start(args: &[&str]) -> Child {
    let mut command = Command::new(taxel());
    command.args(args).stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
    command.spawn().unwrap()
}

/// Waits until a file has bytes enough for images.
fn recorded(path: &Path) {
    let until = Instant::now() + PATIENCE;
    while path.metadata().map_or(0, |known| known.len()) < 150_000 {
        assert!(Instant::now() < until, "{} does not grow", path.display());
        std::thread::sleep(Duration::from_millis(10));
    }
}

/// Messages of a topic.
fn messages(path: &Path, name: &str) -> Vec<Value> {
    let mut messages = Messages::of_topic(path, &format!("/taxel/{name}")).unwrap();
    let mut all = Vec::new();
    while let Some(message) = messages.next_message().unwrap() {
        all.push(serde_json::from_slice(message.data).unwrap());
    }
    all
}

fn garments(path: &Path) -> Vec<String> {
    let mut all: Vec<String> =
        messages(path, "hello").iter().map(|line| line["garment"].as_str().unwrap().into()).collect();
    all.dedup();
    all
}

/// A path at which there is no file yet.
fn free(name: &str) -> PathBuf {
    let path = PathBuf::from(file(name, b""));
    std::fs::remove_file(&path).unwrap();
    _ = std::fs::remove_file(path.with_file_name(name.replace(".mcap", "-0002.mcap")));
    path
}

/// Exit status 3, and one sentence that says which board answers.
fn is_refused(done: &Output, address: &str) {
    let error = String::from_utf8_lossy(&done.stderr);
    let why = format!(
        "error: tcp:{address} answers with another board: it has the garment block-4x16, not reference"
    );
    assert_eq!(done.status.code(), Some(3), "{error}");
    assert!(error.lines().any(|line| line == why), "{error}");
}

#[test]
fn lines_say_what_ends_with_a_lost_board_and_go_on_with_another() {
    let socket = Socket::new("reference");
    let mut program = start(&["live", "--source", &format!("tcp:{}", socket.address), "--json"]);
    let mut lines = BufReader::new(program.stdout.take().unwrap()).lines();
    let mut next = || serde_json::from_str::<Value>(&lines.next().expect("it goes on").unwrap()).unwrap();
    let mut present = Vec::new();
    while present.is_empty() {
        let line = next();
        if line["type"] == "contacts" {
            present = line["contacts"].as_array().unwrap().iter().map(|it| it["id"].clone()).collect();
        }
    }
    socket.plug(None);
    let mut last = Value::Null;
    loop {
        let line = next();
        match line["type"].as_str().unwrap() {
            "contacts" => last = line,
            "lost" => break,
            _ => {}
        }
    }
    assert!(
        last["contacts"].as_array().unwrap().is_empty() && !last["released"].as_array().unwrap().is_empty()
    );
    socket.plug(Some("block-4x16"));
    let other = next();
    assert_eq!(other["type"], "other", "{other}");
    let hello = next();
    assert_eq!((&hello["type"], &hello["garment"]), (&"hello".into(), &"block-4x16".into()));
    while next()["type"] != "frame" {}
    program.kill().unwrap();
    program.wait().unwrap();
}

#[test]
fn a_recording_ends_with_its_board() {
    let (socket, path) = (Socket::new("reference"), free("exchanged.mcap"));
    let source = format!("tcp:{}", socket.address);
    // The garment that the user has sent is not sent to the other board.
    let output = path.to_str().unwrap();
    let program = start(&["record", "--source", &source, "-o", output, "--garment", "reference"]);
    recorded(&path);
    socket.plug(Some("block-4x16"));
    is_refused(&program.wait_with_output().unwrap(), &socket.address);
    assert_eq!(garments(&path), ["reference"]);
    assert_eq!([messages(&path, "lost").len(), messages(&path, "other").len()], [1, 1]);
    assert!(messages(&path, "back").is_empty());
}

#[test]
#[cfg(unix)]
fn with_rotate_another_board_is_in_another_file() {
    let (socket, path) = (Socket::new("reference"), free("rotated.mcap"));
    let source = format!("tcp:{}", socket.address);
    let output = path.to_str().unwrap();
    let program = start(&["record", "--source", &source, "-o", output, "--rotate", "1h"]);
    recorded(&path);
    socket.plug(Some("block-4x16"));
    let second = path.with_file_name("rotated-0002.mcap");
    recorded(&second);
    Command::new("kill").args(["-INT", &program.id().to_string()]).status().unwrap();
    let done = program.wait_with_output().unwrap();
    assert_eq!(done.status.code(), Some(0), "{}", String::from_utf8_lossy(&done.stderr));
    assert_eq!([garments(&path), garments(&second)], [["reference"], ["block-4x16"]]);
    assert_eq!([messages(&path, "other").len(), messages(&second, "other").len()], [1, 0]);
}
