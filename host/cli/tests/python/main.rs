//! The program's files and lines read by Python: recordings of every simulated scene, killed recordings, the
//! examples. `cargo xtask test` provides the interpreter with the readers (`TAXEL_PYTHON`).

mod examples;
mod killed;
mod scenes;
#[path = "../commands/record/stage.rs"]
mod stage;
#[path = "../program/start.rs"]
mod start;

use serde_json::Value;
use std::path::Path;
use std::process::Command;

/// The interpreter.
fn python() -> Command {
    Command::new(std::env::var_os("TAXEL_PYTHON").expect("TAXEL_PYTHON names no interpreter"))
}

/// Contents of a file, by a reader.
fn read(how: &str, file: &Path) -> Value {
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/python/read.py");
    let output = python().arg(script).arg(how).arg(file).output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{}: {said}", file.display());
    serde_json::from_slice(&output.stdout).unwrap()
}
