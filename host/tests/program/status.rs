//! The exit status of the program: 0 done, 1 failed, 2 wrong use, 3 the board is at fault.

use std::path::PathBuf;
use std::process::{Command, Output, Stdio};

fn taxel(args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_taxel")).args(args).stdin(Stdio::null()).output().unwrap()
}

/// A scene in which this is faulty, as a source.
fn faulty(name: &str, faults: &str) -> String {
    let file = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("status-{name}.toml"));
    std::fs::write(&file, format!("duration_s = 2\n[faults]\n{faults}\n")).unwrap();
    format!("sim:{}", file.display())
}

/// The status, and one sentence on the standard error that holds these words.
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
    ends(&["scenes"], 0, "");
    ends(&["health", "--source", "sim:idle", "--frames", "40"], 0, "");
}

#[test]
fn what_failed_is_1() {
    ends(&["info", "no-such.mcap"], 1, "no-such.mcap cannot be read: no such file");
    ends(&["config", "check", "no-such.toml"], 1, "no-such.toml");
    ends(&["live", "--source", "file:/no/such/bytes"], 1, "/no/such/bytes");
    ends(&["setup", "--simulate", "7", "--garment", "block-4x16"], 1, "only binary addresses do");
}

#[test]
fn wrong_use_is_2() {
    ends(&["nothing"], 2, "unrecognized subcommand");
    ends(&["live", "--source", "sim:tickle"], 2, "there is no script of touches \"tickle\"");
    ends(&["live", "--source", "sum"], 2, "known are auto, usb, sim");
    ends(&["save", "--source", "sim:idle", "--garment", "shirt"], 2, "shirt");
    ends(&["process", "a.npy", "--rate", "0"], 2, "--rate 0: it must be above 0");
    ends(&["doctor", "--source", "sim:idle", "--seconds", "0"], 2, "--seconds must be a time above 0");
    ends(&["report", "-o", "a.html"], 2, "give a recording, or a --source");
    ends(
        &["live", "--frames", "many"],
        2,
        "'many' for '--frames <N>': it must be a whole number of 0 or more",
    );
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
fn the_table_is_in_the_help() {
    let help = String::from_utf8(taxel(&["--help"]).stdout).unwrap();
    for line in ["0  done", "1  failed", "2  wrong use", "3  the board is at fault"] {
        assert!(help.contains(line), "{help}");
    }
}
