//! What a frame of a board costs by the number of boards: `taxel record` and `taxel live --json` of
//! streams that were made before. Nothing is lost, whatever their number.
//!
//! The time of the processor is that of the program's whole run; it is reported where the system has `/proc`, and of
//! use only if nothing else runs in this process. A campaign judges it (`cargo xtask campaign --only boards`).

use super::robot::folder;
use crate::start::taxel;
use std::path::Path;
use std::process::{Command, Stdio};
use std::thread;
use std::time::Duration;
use taxel::recording::Overview;

/// Numbers of boards.
const BOARDS: [usize; 2] = [1, 4];
/// Two touches that move.
const TWO: &str = include_str!("../../../../tests/bench/src/boards/two.toml");

/// What a run has taken.
struct Taken {
    /// Time of the processor, s; none if the system does not report it.
    cpu_s: Option<f64>,
    /// Most memory, MB.
    memory_mb: Option<f64>,
}

/// Runs the program to its end.
fn run(folder: &Path, args: &[&str]) -> Taken {
    let before = children_s();
    let mut program = Command::new(taxel())
        .current_dir(folder)
        .args(args)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let mut memory_mb = None;
    let status = loop {
        if let Some(status) = program.try_wait().unwrap() {
            break status;
        }
        memory_mb = most_mb(program.id()).or(memory_mb);
        thread::sleep(Duration::from_millis(20));
    };
    assert!(status.success(), "{args:?}");
    Taken { cpu_s: children_s().zip(before).map(|(after, before)| after - before), memory_mb }
}

/// Time of the processor of all processes that this one has waited for, s.
fn children_s() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/self/stat").ok()?;
    // Behind the name: the 14th and 15th words are hundredths of seconds, of the program and of the system.
    let words: Vec<&str> = text.rsplit(')').next()?.split_whitespace().collect();
    let ticks = words.get(13..15)?.iter().map(|word| word.parse::<f64>().ok()).sum::<Option<f64>>()?;
    Some(ticks / 100.0)
}

/// Most memory that a process has had so far, MB.
fn most_mb(id: u32) -> Option<f64> {
    let text = std::fs::read_to_string(format!("/proc/{id}/status")).ok()?;
    let line = text.lines().find(|line| line.starts_with("VmHWM:"))?;
    Some(line.split_whitespace().nth(1)?.parse::<f64>().ok()? / 1024.0)
}

#[test]
fn robot_cost_by_number_of_boards() {
    let folder = folder("cost", "");
    std::fs::write(folder.join("two.toml"), TWO).unwrap();
    run(&folder, &["record", "--source", "sim:two.toml", "--for", "0.5s", "-o", "two.mcap", "--force"]);
    println!("boards  frames   record: us a frame     MB   live --json: us a frame     MB");
    let mut alone = None;
    for number in BOARDS {
        let board = |at: usize| format!("[[boards]]\nname = \"b{at}\"\nsource = \"replay:two.mcap@max\"\n");
        let robot: String = (0..number).map(board).collect();
        std::fs::write(folder.join("robot.toml"), format!("name = \"many\"\n{robot}")).unwrap();
        let record = run(&folder, &["record", "robot.toml", "-o", "out.mcap", "--force"]);
        let live = run(&folder, &["live", "robot.toml", "--json"]);
        let overview = Overview::of(&folder.join("out.mcap")).unwrap();
        let count = |at: usize, topic: &str| overview.messages(&format!("/taxel/b{at}/{topic}"));
        let printed = [count(0, "frames"), count(0, "contacts"), count(0, "wire")];
        assert_eq!(*alone.get_or_insert(printed), printed);
        for at in 0..number {
            assert_eq!(
                [count(at, "frames"), count(at, "contacts"), count(at, "wire")],
                printed,
                "board {at}"
            );
        }
        assert!(printed[0] > 50 && printed[1] > 50, "{printed:?}");
        let frames = printed[0] * number as u64;
        let cost =
            |taken: &Taken| taken.cpu_s.map_or("-".into(), |s| format!("{:.1}", s * 1e6 / frames as f64));
        let memory = |taken: &Taken| taken.memory_mb.map_or("-".into(), |mb| format!("{mb:.0}"));
        println!(
            "{number:6}  {frames:6}  {:>19}  {:>5}  {:>24}  {:>5}",
            cost(&record),
            memory(&record),
            cost(&live),
            memory(&live)
        );
    }
    std::fs::remove_file(folder.join("out.mcap")).unwrap();
}
