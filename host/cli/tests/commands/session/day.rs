//! A day of a board's time, recorded and reported. No program's memory may grow.
//!
//! `cargo xtask campaign --only day` takes a whole day; by default it is two minutes.

use super::memory::Watched;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

/// Frames of the reference garment per second.
const RATE: f64 = 195.3;

/// Runs the program to its end. Returns its memory and its last line.
fn watched(name: &'static str, args: &[&str]) -> (Watched, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_taxel"));
    let mut run = command.arg(name).args(args).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
    let mut memory = Watched::of(name, run.id());
    while run.try_wait().unwrap().is_none() {
        memory.look();
        std::thread::sleep(Duration::from_millis(20));
    }
    let done = run.wait_with_output().unwrap();
    let words = String::from_utf8(done.stderr).unwrap();
    assert!(done.status.success(), "{name}: {words}");
    (memory, words.lines().last().unwrap_or("").to_string())
}

#[test]
fn a_day_is_recorded_and_reported_in_flat_memory() {
    let is_whole = std::env::var_os("TAXEL_CAMPAIGN").is_some();
    let seconds: u32 = if is_whole { 86_400 } else { 120 };
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("day-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let [file, page] = ["day.mcap", "day.html"].map(|name| folder.join(name).to_str().unwrap().to_string());
    let asked = format!("{seconds}s");
    let (recorder, words) = watched("record", &["--source", "sim:pat", "--for", &asked, "-o", &file]);
    let (reporter, _) = watched("report", &[&file, "-o", &page]);
    let bytes = std::fs::metadata(&file).unwrap().len();
    std::fs::remove_dir_all(&folder).unwrap();
    let (_, printed) = words.split_once(": ").unwrap();
    println!("{printed}; {:.1} MB an hour", bytes as f64 / 1e6 * 3600.0 / f64::from(seconds));
    let number = |unit| printed.split(", ").find_map(|part| part.strip_suffix(unit)).unwrap();
    let frames: f64 = number(" frames").parse().unwrap();
    assert!((frames - RATE * f64::from(seconds)).abs() < 0.001 * frames + 2.0, "{printed}");
    assert_eq!(number(" lost"), "0", "{printed}");
    println!("{recorder}\n{reporter}");
    // The last half minute is kept on purpose, so it must be there before memory is compared.
    for watched in [recorder, reporter].iter().filter(|_| is_whole) {
        assert!(watched.grown() <= 1 << 20, "{watched}");
    }
}
