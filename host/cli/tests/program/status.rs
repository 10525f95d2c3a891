//! The exit status of the program: 0 done, 1 failed, 2 wrong use, 3 the board is at fault.

use std::path::PathBuf;
use std::process::{Command, Output, Stdio};

fn taxel(args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_taxel")).args(args).stdin(Stdio::null()).output().unwrap()
}

/// A source of a scene with these faults.
fn faulty(name: &str, faults: &str) -> String {
    let file = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("status-{name}.toml"));
    std::fs::write(&file, format!("duration_s = 2\n[faults]\n{faults}\n")).unwrap();
    format!("sim:{}", file.display())
}

/// Checks the status, and for one sentence on standard error that contains these words.
#[track_caller]
fn ends(args: &[&str], status: i32, words: &str) {
    let output = taxel(args);
    let error = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(status), "{args:?}: {error}");
    assert!(error.contains(words), "{args:?}: {words:?} is not in: {error}");
    assert!(!error.contains("os error") && !error.contains("invalid digit"), "{args:?}: {error}");
}

#[test]
fn what_is_done_is_0() {
    ends(&["config", "touches"], 0, "");
    ends(&["health", "--source", "sim:idle", "--frames", "40"], 0, "");
}

#[test]
fn what_failed_is_1() {
    ends(&["info", "no-such.mcap"], 1, "no-such.mcap cannot be read: no such file");
    ends(&["config", "check", "no-such.toml"], 1, "no-such.toml");
    ends(&["live", "--source", "replay:/no/such/bytes"], 1, "/no/such/bytes");
    ends(&["setup", "--simulate", "7", "--garment", "block-4x16"], 1, "only binary addresses do");
}

#[test]
fn wrong_use_is_2() {
    ends(&["nothing"], 2, "unrecognized subcommand");
    ends(&["live", "--source", "sim:tickle"], 2, "there is no script of touches \"tickle\"");
    ends(&["live", "--source", "sum"], 2, "known are auto, usb[:SERIAL], sim");
    ends(&["save", "--source", "sim:idle", "--garment", "shirt"], 2, "shirt");
    ends(&["process", "a.npy", "--rate", "0"], 2, "--rate 0: it must be above 0");
    ends(&["doctor", "--source", "sim:idle", "--for", "0s"], 2, "--for must be a time above 0");
    ends(&["report", "-o", "a.html"], 2, "give a recording, or a --source");
    ends(
        &["live", "--frames", "many"],
        2,
        "'many' for '--frames <N>': it must be a whole number of 0 or more",
    );
}

#[test]
fn mistakes_are_reported_in_plain_words() {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR"));
    let binary = folder.join("status-binary.toml");
    std::fs::write(&binary, [0xff, 0xfe, 0x80]).unwrap();
    let binary = binary.to_str().unwrap();
    let live = |option: &str, value: &str, status: i32, words: &str| {
        ends(&["live", "--source", "sim:pat", option, value], status, words);
    };
    ends(&["live", "--source", &format!("sim:{binary}")], 1, "cannot be read: it is not text (UTF-8)");
    live("--scene", binary, 1, "cannot be read: it is not text (UTF-8)");
    live("--scene", "no-such.toml", 1, "no-such.toml cannot be read: no such file or directory");
    live("--for", "-1", 2, "'-1' for '--for <TIME>': must be a time such as 500ms, 2s or 10min");
    live("--tare", "99999", 2, "'99999' for '--tare <N>': it must be 0 to 4096");
    live("--taxel", "9,0,0", 2, "--taxel: the garment has no panel 9; known are chest");
    live("--taxel", "0,32,0", 2, "--taxel: panel chest has 32 rows and 16 columns, from 0");
    ends(&["view", "--port", "99999"], 2, "'99999' for '--port <N>': it must be 0 to 65535");
    ends(
        &["export", "a", "--to", "csv", "-o", "b", "--every", "0"],
        2,
        "'0' for '--every <N>': it must be 1",
    );
    #[cfg(unix)]
    ends(
        &["live", "--source", "serial:/dev/null"],
        3,
        "/dev/null at 921600 Bd cannot be opened: it is not a serial",
    );
    ends(&["live", "--source", "serial:/dev/no-such"], 3, "there is no such port; `taxel ports` lists");
    ends(&["live", "--source", "tcp:no-such.invalid:80"], 3, "cannot be reached: its name has no address");
}

#[test]
fn a_board_at_fault_is_3() {
    ends(&["live", "--source", "serial:/dev/no-such-port"], 3, "/dev/no-such-port");
    ends(
        &["live", "--source", "tcp:127.0.0.1:1"],
        3,
        "tcp:127.0.0.1:1 cannot be reached: connection refused",
    );
    let line = faulty("line", "pins = [{ pin = 8, fault = \"stuck-high\" }]");
    ends(&["health", "--source", &line], 3, "faults of lines and inputs: 1");
    let taxel = faulty("taxel", "stuck = [{ taxel = 77, code = 300 }]");
    ends(&["health", "--source", &taxel, "--tare", "16"], 3, "faulty taxels: 1");
}

#[test]
fn a_board_that_refuses_what_was_asked_for_ends_the_command() {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR"));
    let scene = folder.join("status-too-fast.toml");
    std::fs::write(&scene, "[stream]\ncontacts_hz = 20000\n").unwrap();
    let (scene, recording) = (scene.to_str().unwrap(), folder.join("status-refused.mcap"));
    let why = "sim:pat: the board refuses set-scene: scene: stream.contacts_hz must be lower";
    let asks = ["--source", "sim:pat", "--scene", scene];
    ends(&[&["live"][..], &asks].concat(), 3, why);
    ends(&[&["view", "--port", "0"][..], &asks].concat(), 3, why);
    let record = ["record", "--force", "-o", recording.to_str().unwrap()];
    ends(&[&record[..], &asks].concat(), 3, why);
    // The data recorded until then is intact; refusals by a recorded board are no fault of the replay.
    ends(&["info", recording.to_str().unwrap()], 0, "");
    let source = format!("replay:{}", recording.display());
    ends(&["live", "--source", &source], 0, "");
    ends(&["live", "--source", &source, "--scene", scene], 2, "is a recording, whose board does not listen");
}

#[test]
fn the_table_is_in_the_help() {
    let help = String::from_utf8(taxel(&["--help"]).stdout).unwrap();
    for line in ["0  done", "1  failed", "2  wrong use", "3  the board is at fault"] {
        assert!(help.contains(line), "{help}");
    }
}
