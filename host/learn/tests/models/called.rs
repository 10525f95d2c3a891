//! The program, called in a folder of its own.

use std::path::{Path, PathBuf};
use std::process::Command;

/// A new empty folder.
pub fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("learn").join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

/// Standard output of a successful command, and its standard error.
pub fn done(folder: &Path, args: &[&str]) -> (String, String) {
    let program = env!("CARGO_BIN_EXE_taxel-learn");
    let output = Command::new(program).current_dir(folder).args(args).output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    let (out, err) = (text(output.stdout), text(output.stderr));
    assert!(output.status.success(), "{args:?}: {err}");
    (out, err)
}
