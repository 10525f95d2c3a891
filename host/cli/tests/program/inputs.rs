//! Every command reads through `input`: what is no file is refused in a sentence, and nobody waits for it.

use crate::outputs::{Folder, modules};
#[cfg(unix)]
use std::fs;

/// Modules that read without it, and what.
const ALLOWED: [(&str, &str); 6] = [
    ("taxel/src/files/input.rs", "the reader"),
    ("taxel/src/files/output/", "what it has written itself"),
    ("taxel/src/record/provenance.rs", "the machine's name"),
    ("taxel/src/source/port_table.rs", "a test's ports"),
    ("taxel/src/source/serial.rs", "the machine's groups"),
    ("cli/src/commands/board/flash.rs", "a board's drive, and where it is mounted"),
];
/// Calls that open a file.
const READS: [&str; 3] = ["File::open(", "fs::read(", "fs::read_to_string("];

#[test]
fn no_other_module_opens_files() {
    for (name, code) in modules(&["cli/src", "sim/src", "taxel/src", "python/src"], &ALLOWED) {
        let is_code = |line: &&str| !line.trim_start().starts_with("//");
        for line in code.lines().filter(is_code) {
            assert!(!READS.iter().any(|call| line.contains(call)), "{name} reads by itself: {line}");
        }
    }
}

/// Commands, and the file that each reads.
#[cfg(unix)]
const READERS: [&[&str]; 23] = [
    &["info", "no.mcap"],
    &["export", "no.mcap", "--to", "csv", "-o", "out.csv"],
    &["report", "no.mcap", "-o", "out.html"],
    &["live", "--source", "replay:no.mcap"],
    &["live", "--source", "sim:no.toml"],
    &["live", "--source", "sim:press", "--garment", "no.toml"],
    &["live", "--source", "sim:press", "--scene", "no.toml"],
    &["live", "--source", "sim:press", "--calibration", "no.toml"],
    &["live", "--source", "sim:press", "--body", "no.toml"],
    &["live", "--source", "sim:press", "--folds", "no.bin"],
    &["live", "--source", "sim:press", "--shapes", "no.json"],
    &[
        "live",
        "--source",
        "sim:press",
        "--body",
        "reference",
        "--robot",
        "reference",
        "--joint-states",
        "no.jsonl",
    ],
    &["process", "no.csv"],
    &["fcm", "no.toml"],
    &["fcm", "learn", "tactile", "--touches", "no.csv", "-o", "out.toml"],
    &["config", "check", "no.toml"],
    &["body", "show", "no.toml", "-o", "out.svg"],
    &["body", "drape", "no.obj", "--panel", "chest", "--at", "0,0,0", "-o", "out.txt"],
    &["body", "fit", "reference", "--touches", "no.csv", "-o", "out.toml"],
    &["shapes", "list", "no.json"],
    &["config", "check", "no.toml"],
    &["live", "robot.toml", "--requests", "no.jsonl"],
    &["flash", "no.uf2"],
];

/// Seconds after which a command counts as waiting.
#[cfg(unix)]
const WAITS: u32 = 60;

#[cfg(unix)]
#[test]
fn what_is_no_file_is_refused_by_every_command() {
    use std::process::{Command, Stdio};
    let folder = Folder::new("inputs");
    let robot = "name = \"one\"\n[[boards]]\nname = \"left\"\nsource = \"sim:press\"\n";
    fs::write(folder.0.join("robot.toml"), robot).unwrap();
    let names: Vec<&str> = READERS
        .iter()
        .map(|command| command.iter().find_map(|word| Some(&word[word.find("no.")?..])).unwrap())
        .collect();
    for what in ["a FIFO", "a device"] {
        for name in &names {
            let path = folder.0.join(name);
            _ = fs::remove_file(&path);
            match what {
                "a FIFO" => assert!(Command::new("mkfifo").arg(path).status().unwrap().success()),
                _ => std::os::unix::fs::symlink("/dev/null", path).unwrap(),
            }
        }
        // One place says what is no file.
        let commands = if what == "a FIFO" { &READERS[..] } else { &READERS[..1] };
        for command in commands {
            // `timeout` ends with 124.
            let mut program = Command::new("timeout");
            program.arg(WAITS.to_string()).arg(env!("CARGO_BIN_EXE_taxel")).args(*command);
            let done = program.current_dir(&folder.0).stdin(Stdio::null()).output().unwrap();
            let printed = String::from_utf8(done.stderr).unwrap();
            assert_ne!(done.status.code(), Some(124), "{command:?} waits");
            let error = printed.lines().find(|line| line.starts_with("error: ")).unwrap_or_default();
            assert!(error.contains(&format!("it is {what}")), "{command:?}: {printed}");
        }
    }
}
