//! Every loop of the program, and what is plugged in: what is reported, with which status, and within which time. None
//! simulates unasked.

use super::stage::{boards, command, ended, folder};
use std::thread;

/// Longest time until a command says that there is no board, s; on a machine that does a lot besides.
const SECONDS: f64 = if cfg!(debug_assertions) { 12.0 } else { 3.0 };

/// Command lines that follow, set or examine a board; `{}` is a folder of their own.
const LOOPS: &[&str] = &[
    "live --source auto",
    "live",
    "view --port 0",
    "record -o {}/a.mcap",
    "save",
    "health",
    "doctor",
    "calibrate -o {}/a.toml",
    "setup",
    "doctor {}/robot.toml",
    #[cfg(feature = "ros2")]
    "ros2 --domain 229",
    #[cfg(feature = "foxglove")]
    "foxglove --port 0",
    #[cfg(feature = "zenoh")]
    "serve",
];

/// All others that have a source.
const REST: &[&str] = &[
    "live --json",
    "live --tare 8",
    "view --source auto --port 0",
    "record --view --port 0 -o {}/b.mcap",
    "reset-settings",
    "calibrate settle",
    "calibrate check {}/calibration.toml",
    "shapes install drawn",
    "shapes learn ball -o {}/base.json",
    "report --source auto -o {}/a.html",
    "fcm why --source auto",
    "body fit reference --pick 3 -o {}/body.toml",
];

/// What is plugged in, the boards with how their ports open, and what is reported.
type State = (&'static str, &'static [(&'static str, &'static str)], &'static str);

/// The columns of the table.
const STATES: [State; 5] = [
    ("none", &[], "no board is plugged in: no serial port has the USB id of a board, 1209:0001"),
    ("hung", &[("A1", "hung")], "usb:/dev/ttyTAXEL0 is silent: it sends no Hello of a taxel board in 1.5 s"),
    (
        "busy",
        &[("A1", "busy")],
        "serial port /dev/ttyTAXEL0 at 921600 Bd cannot be opened: another program has it open",
    ),
    (
        "not permitted",
        &[("A1", "not permitted")],
        "this user may not: `sudo usermod -aG dialout $USER` permits it, then log in again",
    ),
    (
        "two",
        &[("A1", "hung"), ("B2", "hung")],
        "2 boards are plugged in: name one of usb:A1 (/dev/ttyTAXEL0), usb:B2 (/dev/ttyTAXEL1)",
    ),
];

/// Runs a cell of the table. Returns its line.
fn cell(line: &str, number: usize, (state, plugged, words): State) -> String {
    let folder = folder(&format!("{number}-{}", state.replace(' ', "-")));
    std::fs::write(
        folder.join("robot.toml"),
        "name = \"one\"\n[[boards]]\nname = \"hand\"\nsource = \"auto\"\n",
    )
    .unwrap();
    let here = folder.to_str().unwrap();
    if line.contains("calibration.toml") {
        let made = ended(command(&folder, "", &["calibrate", "--simulate", "7", "-o", "calibration.toml"]));
        assert_eq!(made.status, Some(0), "{}", made.error);
    }
    let args: Vec<String> = line.split(' ').map(|word| word.replace("{}", here)).collect();
    let args: Vec<&str> = args.iter().map(String::as_str).collect();
    let end = ended(command(&folder, &boards(plugged), &args));
    // Whoever only shows takes the first of two: here, both hang.
    let shows = state == "two" && matches!(args[0], "live" | "view") && !args.contains(&"--tare");
    let words = if shows { "usb:/dev/ttyTAXEL0 is silent: " } else { words };
    let (error, output) = (&end.error, &end.output);
    assert_eq!(end.status, Some(3), "{line}, {state}: {output}{error}");
    assert!(error.contains(words) || output.contains(words), "{line}, {state}: {output}{error}");
    assert!(!error.contains("sim:pat") && !output.contains("sim:pat"), "{line}, {state}: {output}{error}");
    assert!(end.seconds < SECONDS, "{line}, {state}: {:.1} s", end.seconds);
    assert!(!folder.join("a.mcap").exists() && !folder.join("a.toml").exists(), "{line}, {state}");
    format!("{line:<40} {state:<14} {:>4.1} s", end.seconds)
}

/// Runs all cells at once. Returns their lines.
fn table(lines: &[&'static str]) -> Vec<String> {
    let cells =
        lines.iter().enumerate().flat_map(|(number, line)| STATES.map(|state| (number, *line, state)));
    let threads: Vec<_> =
        cells.map(|(number, line, state)| thread::spawn(move || cell(line, number, state))).collect();
    threads.into_iter().map(|thread| thread.join().unwrap()).collect()
}

#[test]
fn nothing_is_simulated_in_place_of_a_board() {
    let is_campaign = std::env::var_os("TAXEL_CAMPAIGN").is_some();
    let mut lines = LOOPS.to_vec();
    if is_campaign {
        lines.extend(REST);
    }
    let printed = table(&lines);
    if is_campaign {
        printed.iter().for_each(|line| println!("absent: {line}"));
    }
}
