//! The program, called: what it answers, and how it refuses.

use crate::start::taxel;
use serde_json::Value;
use std::path::Path;
use std::process::{Command, Output, Stdio};

/// Path of this test's file in the build folder.
pub fn file(name: &str, bytes: &[u8]) -> String {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("called");
    std::fs::create_dir_all(&folder).unwrap();
    let path = folder.join(name);
    std::fs::write(&path, bytes).unwrap();
    path.to_str().unwrap().into()
}

pub fn run(args: &[&str]) -> Output {
    Command::new(taxel()).args(args).stdin(Stdio::null()).output().unwrap()
}

pub fn answer(args: &[&str]) -> String {
    let output = run(args);
    assert!(output.status.success(), "{args:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

pub fn json(args: &[&str]) -> Value {
    serde_json::from_str(&answer(args)).unwrap()
}

/// Checks bad input: this exit status, nothing on stdout, one line on stderr with each of `words`.
pub fn refused(status: i32, args: &[&str], words: &[&str]) {
    let output = run(args);
    let error = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(status), "{args:?}: {error}");
    assert!(output.stdout.is_empty(), "{args:?}");
    assert!(error.starts_with("error: ") && error.lines().count() == 1, "{args:?}: {error}");
    for word in words {
        assert!(error.contains(word), "{args:?}: {word} is not in: {error}");
    }
}

/// Standard error and standard output of a command.
pub fn said(args: &[&str]) -> (String, String) {
    let output = run(args);
    let [error, text] =
        [&output.stderr, &output.stdout].map(|bytes| String::from_utf8_lossy(bytes).into_owned());
    assert!(output.status.success(), "{args:?}: {error}");
    (error, text)
}
