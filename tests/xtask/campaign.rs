//! `cargo xtask campaign`: long runs, each of which prints a table.

use crate::guests::{self, Guest};
use crate::{boards, browser, given, paths, physics, python, ros2, targets, ways, wheels, zenoh};
use std::path::{Path, PathBuf};

/// Kind of a run.
#[derive(Debug, Clone, Copy)]
enum Run {
    /// Tests of the core whose names contain this.
    Core(&'static str),
    /// Tests of the commands whose names contain this.
    Commands(&'static str),
    /// Tests of the library whose names contain this.
    Library(&'static str),
    /// Tests of the program whose names contain this.
    Program(&'static str),
    /// A module of the tests of the firmware image.
    Image(&'static str),
    /// A file of the tests of the page.
    Browser(&'static str),
    /// Python tests whose names contain this.
    Python(&'static str),
    /// The Python package with each CPython.
    Wheels,
    /// The Python package for another machine, and as its source.
    OtherWheels,
    /// The ROS 2 node with each distribution.
    Ros2,
    /// The Python package beside a program of other people.
    Beside(Guest),
    /// Many boards recorded by the program itself.
    Boards,
    /// MuJoCo's judgement of places and forces.
    Physics,
    /// Boards between machines.
    Zenoh,
    /// Tests of files on a failing disk.
    Disk,
    /// The core beside imageproc.
    Peers,
    /// The image by each toolchain.
    Ways,
    /// What is given away.
    Release,
}

/// The runs. Tests print more if TAXEL_CAMPAIGN is set.
const RUNS: &[(&str, Run, &str)] = &[
    (
        "emulator-scan",
        Run::Image("scan"),
        "every code of 1,000 frames, as they are scanned; the time of a frame by settling and depth (emulated)",
    ),
    ("emulator", Run::Image("contacts"), "five moving contacts at full speed for 4.1 s (emulated)"),
    (
        "emulator-usb",
        Run::Image("usb"),
        "frames over USB: every scene of the bench, 400 scans each (emulated)",
    ),
    (
        "emulator-latency",
        Run::Image("latency"),
        "onset and reflex: 500 touches of one to five contacts (emulated)",
    ),
    (
        "emulator-health",
        Run::Image("health"),
        "health: 1,000 healthy frames, then one of each fault (emulated)",
    ),
    ("outputs", Run::Core("outputs::"), "outputs: 100,000 random sequences of requests, faults and touches"),
    (
        "emulator-outputs",
        Run::Image("outputs"),
        "outputs: levels from the first instructions on, a converter that stands still, 100 random sequences (emulated)",
    ),
    (
        "base",
        Run::Core("a_generator_that_was_left_out"),
        "shapes: each generator by a base that was learned without it (drawn)",
    ),
    (
        "baseline",
        Run::Core("baseline::"),
        "the core alone: an hour of drift, idle and with a touch that is held (simulated)",
    ),
    (
        "impulses",
        Run::Core("impulses"),
        "the core alone: impulses of one frame, 100,000 frames each (simulated)",
    ),
    ("link", Run::Library("link::"), "link: 10,000,000 messages through each kind of fault"),
    ("health", Run::Library("health::"), "health: every fault, and 10,000 healthy frames (simulated)"),
    ("setup", Run::Commands("setup::"), "setup by touch: 1,000 random wirings (simulated)"),
    (
        "calibrate",
        Run::Commands("calibrate::forces"),
        "calibration: forces of other touches on ten garments with unequal gains, hysteresis and noise (simulated)",
    ),
    (
        "people",
        Run::Library("people::"),
        "intentions: 4,000 touches by 20 people, of each of two families (simulated)",
    ),
    (
        "families",
        Run::Library("families_are_understood"),
        "intentions: 200 touches of 40 families against what a person would say (simulated)",
    ),
    (
        "garments",
        Run::Library("meaning::garments"),
        "1,000 touches on random garments at random rates, beside the reference garment (simulated)",
    ),
    (
        "drift",
        Run::Library("drift::chart"),
        "drift: palms on a mat and on a block that drift, kept or lost (simulated)",
    ),
    (
        "fit",
        Run::Library("body::fit::simulated"),
        "a garment displaced by up to 20 mm and 5 degrees, found by 100 touches on six bodies, 40 times each (simulated)",
    ),
    (
        "meaning",
        Run::Library("meaning::a_"),
        "intentions: 500 variants of the pat and of the lash (simulated)",
    ),
    ("hours", Run::Library("drift::hours"), "drift: ten hours of drift, breath and noise (simulated)"),
    (
        "held",
        Run::Library("drift::held"),
        "drift: touches held for an hour on garments that drift, 32 of each (simulated)",
    ),
    (
        "limits",
        Run::Library("drift::limits"),
        "drift: every garment at every rate, and 40 at random (simulated)",
    ),
    (
        "folds",
        Run::Library("folds::a_bulge_that_appears"),
        "folds: bulges that appear at once, up to 16 degrees off where they did (simulated)",
    ),
    (
        "sessions",
        Run::Library("session::"),
        "sessions: 1,000 disconnects and restarts by each kind of link, everything set again (simulated)",
    ),
    (
        "day",
        Run::Commands("session::day"),
        "a day of a board's time, recorded and reported: memory (simulated)",
    ),
    ("python", Run::Python("killed::"), "recordings: kill -9 while 50 of them are made"),
    (
        "python-wheels",
        Run::Wheels,
        "Python: the wheel with each CPython, a million frames of five contacts, from pip install to the first frame",
    ),
    (
        "python-others",
        Run::OtherWheels,
        "Python: the wheel for aarch64, imported on this machine, and the source distribution, installed by pip",
    ),
    (
        "lerobot",
        Run::Beside(guests::LEROBOT),
        "LeRobot itself: a minute of simulated touch beside a camera, every scan once (simulated)",
    ),
    (
        "ros2",
        Run::Ros2,
        "ROS 2: the node with rclpy of each distribution: 10,000 lists of five contacts, slow and killed ends",
    ),
    (
        "physics",
        Run::Physics,
        "physics: random presses on two bodies in MuJoCo, against places and forces, before noise and on the board",
    ),
    (
        "zenoh",
        Run::Zenoh,
        "Zenoh: a board of 2,048 taxels between machines with routers, by the build of the tests (simulated, network namespaces)",
    ),
    ("disk", Run::Disk, "files: every command that writes, each fault of a disk at each call"),
    (
        "view",
        Run::Browser("stream.test.mjs"),
        "taxel view: ten minutes of five contacts at full speed (simulated)",
    ),
    (
        "one-time",
        Run::Library("one_time"),
        "boards of a robot on one time: skew by round trips, two hours of six clocks and links (simulated)",
    ),
    (
        "losses",
        Run::Library("robot::losses"),
        "boards of a robot: 1,000 losses and returns in random order (simulated)",
    ),
    (
        "mind",
        Run::Library("mind::families"),
        "the mind of a robot: 40 touches of each family over two boards, beside each of its sources (simulated)",
    ),
    (
        "probes",
        Run::Library("mind::probes"),
        "active touch: 400 probes of objects on which it was not tuned (simulated)",
    ),
    (
        "boards",
        Run::Boards,
        "taxel record --view: 1 to 100 boards that other processes play, two moving contacts each, the release program (simulated)",
    ),
    (
        "absent",
        Run::Program("table::"),
        "every command without a board, with one that hangs, is busy or not permitted, is lost or another one, and with two: what is reported, and when",
    ),
    (
        "fleet",
        Run::Beside(guests::RAY),
        "the example of many recordings: 1,000 of them in one process, and by Ray (simulated)",
    ),
    ("peers", Run::Peers, "the core beside imageproc: the same contacts with the same sums"),
    ("compilers", Run::Ways, "the image by each compiler: sizes, and cycles of a frame (emulated)"),
    (
        "release",
        Run::Release,
        "what is given away: the program of each system, by qemu-user and Wine, and the wheel with each CPython, from the command to a repaired recording",
    ),
];

/// Title of the table.
const TITLE: &str =
    "Long runs on the emulated and the simulated board; `cargo xtask campaign --write` writes this.";

/// Runs all of them, or `--only` one; `--write` also writes their output to the table.
pub fn run(args: &[String]) -> Result<(), String> {
    let args: Vec<&str> = args.iter().map(String::as_str).collect();
    let (only, write) = match args[..] {
        [] => (None, false),
        ["--write"] => (None, true),
        ["--only", name] => (Some(name), false),
        ["--only", name, "--write"] => (Some(name), true),
        _ => return Err(crate::USAGE.into()),
    };
    let chosen: Vec<_> = RUNS.iter().filter(|(name, ..)| only.is_none_or(|only| only == *name)).collect();
    if chosen.is_empty() {
        let names: Vec<&str> = RUNS.iter().map(|(name, ..)| *name).collect();
        return Err(format!("there is no such run; there are {}", names.join(", ")));
    }
    let logs = paths::target().join("xtask");
    std::fs::create_dir_all(&logs).map_err(|error| format!("{}: {error}", logs.display()))?;
    for (name, run, what) in chosen {
        println!("{what} ...");
        let lines = measured(*run, &logs.join(format!("campaign-{name}.log")))?;
        println!("{lines}");
        if write {
            note(what, &lines).map_err(|error| format!("{}: {error}", written().display()))?;
            if matches!(run, Run::Boards) {
                boards::keep_chart()?;
            }
        }
    }
    Ok(())
}

/// Output of a run.
fn measured(run: Run, log: &Path) -> Result<String, String> {
    let _ = std::fs::remove_file(log);
    let longer = [("TAXEL_CAMPAIGN", "1")];
    let end = match run {
        Run::Core(names) => targets::printed("core", &[names], log, &longer),
        Run::Commands(names) => targets::printed("commands", &[names], log, &longer),
        Run::Program(names) => targets::printed("program", &[names], log, &longer),
        Run::Library(names) => targets::printed("library", &[names], log, &longer),
        Run::Image(module) => targets::measured(module, log, &longer)?,
        Run::Browser(file) => browser::measured(&[file], log, &longer)?,
        Run::Python(names) => targets::read_by_python(&[names], log, &longer)?,
        Run::Wheels => python::campaign(log, &longer)?,
        Run::Ros2 => ros2::campaign(log, &longer)?,
        Run::OtherWheels => wheels::campaign(log)?,
        Run::Beside(guest) => guests::campaign(guest, log, &longer)?,
        Run::Boards => boards::campaign(log),
        Run::Physics => physics::campaign(log, &longer)?,
        Run::Zenoh => zenoh::campaign(log)?,
        Run::Disk => targets::on_failing_disk(log, &longer)?,
        Run::Peers => targets::equal_to_peers(log),
        Run::Ways => ways::measured(log),
        Run::Release => given::campaign(log)?,
    };
    let lines = end.map_err(|why| format!("{why}, see {}", log.display()))?;
    // Paths of written files do not belong into the table.
    let file = paths::target().display().to_string();
    let said = lines.iter().filter(|line| !line.is_empty() && !line.starts_with(&file));
    Ok(said.map(|line| format!("  {line}")).collect::<Vec<_>>().join("\n"))
}

/// Replaces the output of a run in the table.
fn note(what: &str, lines: &str) -> std::io::Result<()> {
    let before = std::fs::read_to_string(written())?;
    let mut table = TITLE.to_string();
    for (.., of) in RUNS.iter().copied() {
        let kept =
            before.split("\n\n").find_map(|section| section.trim_end().strip_prefix(of)?.strip_prefix('\n'));
        let lines = if of == what { Some(lines) } else { kept };
        let Some(lines) = lines else { continue };
        table += &format!("\n\n{of}\n{lines}");
    }
    std::fs::write(written(), table + "\n")
}

fn written() -> PathBuf {
    paths::root().join("docs/evidence/bench/campaign.txt")
}
