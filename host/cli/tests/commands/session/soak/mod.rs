//! A soak test: boards are touched, break and come back while they are recorded, watched and reconfigured. No
//! program's memory may grow, and only faults may explain losses.
//!
//! `cargo xtask soak --minutes N` runs it for long; `TAXEL_SOAK_MINUTES` sets its duration, by default a
//! quarter of a minute.

mod loss;
mod served;
mod visitors;

use super::memory::Watched;
use served::Served;
use std::fs::File;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};
use taxel::recording::{LinkRecord, WireReader};

/// Least duration that shows growth of memory.
const LONG: Duration = Duration::from_secs(300);

/// Duration.
fn length() -> Duration {
    let minutes = std::env::var("TAXEL_SOAK_MINUTES").ok().and_then(|minutes| minutes.parse::<f64>().ok());
    Duration::from_secs_f64(60.0 * minutes.unwrap_or(0.25))
}

/// Starts the program on a board, with its standard error in a file.
fn program(args: &[&str], words: &Path) -> Child {
    let mut command = Command::new(env!("CARGO_BIN_EXE_taxel"));
    command.args(args).stdout(Stdio::piped()).stderr(File::create(words).unwrap()).spawn().unwrap()
}

/// Seconds of a recording by the recorder's last line: `FILE: 12.3 s, ...`.
fn printed_seconds(words: &str) -> f64 {
    let line = words.lines().last().unwrap();
    let seconds = line.split(' ').zip(line.split(' ').skip(1)).find(|(_, unit)| *unit == "s,");
    seconds.unwrap().0.parse().unwrap()
}

#[test]
fn nothing_grows_and_nothing_is_lost_unexplained() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("soak-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let file = folder.join("soak.mcap");
    let path = file.to_str().unwrap();
    let words = ["record", "view", "live"].map(|name| folder.join(name));
    let [recorded, viewed, printed, set] = [1, 2, 3, 4].map(Served::begin);
    let mut recorder = program(&["record", "--source", &recorded.spec(), "-o", path], &words[0]);
    let mut viewer = program(&["view", "--source", &viewed.spec(), "--port", "0"], &words[1]);
    let mut printer = program(&["live", "--source", &printed.spec(), "--json", "--pixels"], &words[2]);
    let page = visitors::Page::visit(&mut viewer);
    let lines = visitors::listen(&mut printer);
    let setter = visitors::Setter::begin(&set);
    let mut watched = [("record", &recorder), ("view", &viewer), ("live", &printer)]
        .map(|(name, child)| Watched::of(name, child.id()));
    let begun = Instant::now();
    while begun.elapsed() < length() {
        std::thread::sleep(Duration::from_secs(1));
        for (program, words) in [&mut recorder, &mut viewer, &mut printer].into_iter().zip(&words) {
            let words = || std::fs::read_to_string(words).unwrap();
            assert!(program.try_wait().unwrap().is_none(), "it has ended: {}", words());
        }
        watched.iter_mut().for_each(Watched::look);
    }
    let (messages, sets) = (page.leave(), setter.end());
    assert!(Command::new("kill").args(["-INT", &recorder.id().to_string()]).status().unwrap().success());
    assert!(recorder.wait().unwrap().success());
    for child in [&mut viewer, &mut printer] {
        child.kill().unwrap();
        child.wait().unwrap();
    }
    let lines = lines.join().unwrap();
    let mut reader = WireReader::open(&file.as_path().into()).unwrap();
    let mut kept = Vec::new();
    while let Some((_, record)) = reader.next_record().unwrap() {
        if let LinkRecord::Frame(bytes) = record {
            kept.push(bytes.to_vec());
        }
    }
    let sent = recorded.sent();
    let loss = loss::judge(&sent, &kept);
    println!(
        "{:.1} min: {} breaks and restarts of four boards",
        length().as_secs_f64() / 60.0,
        served::breaks()
    );
    println!("recorded: {loss}");
    println!("viewed: {messages} messages of the page");
    println!("reported: {lines} lines of JSON");
    println!("set: {sets} times something new, each answered");
    for watched in &watched {
        println!("{watched}");
    }
    let seconds = printed_seconds(&std::fs::read_to_string(&words[0]).unwrap());
    std::fs::remove_dir_all(&folder).unwrap();
    // No time is recorded during the start and while waiting for a link.
    assert!(seconds > 0.8 * length().as_secs_f64() - 2.0, "{seconds} s are said to be recorded");
    assert_eq!(loss.unexplained, 0, "{loss}");
    assert!(messages > 100 && lines > 100 && sets > 10);
    // The last half minute is kept on purpose, so it must be there before memory is compared.
    for watched in watched.iter().filter(|_| length() >= LONG) {
        assert!(watched.grown() <= 1 << 20, "{watched}");
    }
}
