//! Recordings as Python's readers find them: every simulated scene, and what a kill leaves. `cargo xtask test` gives the
//! interpreter (`TAXEL_PYTHON`) and the program (`TAXEL_PROGRAM`).

mod killed;
mod lerobot;
mod scenes;
#[path = "../record/stage.rs"]
mod stage;

use serde_json::Value;
use std::path::Path;
use std::process::Command;

/// What a reader found in a file.
fn read(how: &str, file: &Path) -> Value {
    let python = std::env::var_os("TAXEL_PYTHON").expect("TAXEL_PYTHON names the interpreter");
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("record_python/read.py");
    let output = Command::new(python).arg(script).arg(how).arg(file).output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{}: {said}", file.display());
    serde_json::from_slice(&output.stdout).unwrap()
}
