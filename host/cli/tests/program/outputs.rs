//! Every command writes through `output`: no input and no other file is lost by a name.

use std::fs;
use std::io::Read;
use std::net::TcpListener;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// Modules that write to a disk without it, and why.
const ALLOWED: [(&str, &str); 2] = [
    ("taxel/src/files/output/", "the writer"),
    ("cli/src/commands/board/flash.rs", "a board's drive, which restarts the board at the last block"),
];
/// Calls that write, replace or remove a file.
const WRITES: [&str; 11] = [
    "File::create",
    "File::options",
    "OpenOptions",
    "fs::write",
    "fs::copy",
    "fs::rename",
    "fs::hard_link",
    "fs::remove_",
    "fs::create_dir",
    "create_new(",
    "fs::set_permissions",
];

/// Name and code, without unit tests, of each module in these folders below `host`; of none whose name begins like one of
/// `left_out`.
pub fn modules(folders: &[&str], left_out: &[(&str, &str)]) -> Vec<(String, String)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
    let mut all = Vec::new();
    folders.iter().for_each(|folder| sources(&root.join(folder), &mut all));
    assert!(all.len() > 100, "{} files", all.len());
    let mut modules = Vec::new();
    for path in all {
        let name = path.strip_prefix(root).unwrap().to_string_lossy().replace('\\', "/");
        if name.ends_with("tests.rs") || left_out.iter().any(|(begin, _)| name.starts_with(begin)) {
            continue;
        }
        let text = fs::read_to_string(&path).unwrap();
        // Unit tests are at the end of a module.
        modules.push((name, text.split("#[cfg(test)]").next().unwrap_or_default().into()));
    }
    modules
}

/// Source files below a folder.
fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
}

#[test]
fn no_other_module_writes_files() {
    for (name, code) in modules(&["cli/src", "sim/src", "taxel/src"], &ALLOWED) {
        for call in WRITES {
            // These do not create a file by themselves.
            let own = ["RecordingFile::create", "Ros2File::create"];
            let calls = |line: &str| line.contains(call) && !own.iter().any(|own| line.contains(own));
            let line = code.lines().position(calls);
            assert!(
                line.is_none(),
                "{name}, line {}: {call} goes through crate::output",
                line.unwrap_or(0) + 1
            );
        }
    }
}

/// A test's folder with a recording, deleted at its end.
pub struct Folder(pub PathBuf);

impl Folder {
    pub fn new(name: &str) -> Folder {
        let path = std::env::temp_dir().join(format!("taxel-outputs-{name}-{}", std::process::id()));
        fs::create_dir_all(&path).unwrap();
        let folder = Folder(path);
        let done = folder.run(&["record", "--source", "sim:press", "--frames", "40", "-o", "in.mcap"]);
        assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
        fs::write(folder.0.join("old"), "precious").unwrap();
        folder
    }

    fn run(&self, args: &[&str]) -> Output {
        let mut command = Command::new(env!("CARGO_BIN_EXE_taxel"));
        command.args(args).current_dir(&self.0).stdin(std::process::Stdio::null()).output().unwrap()
    }

    fn refused(&self, args: &[&str], words: &str) {
        let done = self.run(args);
        let error = String::from_utf8(done.stderr).unwrap();
        assert!(!done.status.success() && error.contains(words), "{args:?}: {error}");
    }

    fn bytes(&self, name: &str) -> Vec<u8> {
        fs::read(self.0.join(name)).unwrap()
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        fs::remove_dir_all(&self.0).unwrap();
    }
}

/// Commands that write, without the name of the output.
const WRITERS: [&[&str]; 10] = [
    &["record", "--source", "sim:press", "--frames", "5", "-o"],
    &["export", "in.mcap", "--to", "csv", "-o"],
    &["export", "in.mcap", "--to", "npz", "-o"],
    &["export", "in.mcap", "--to", "png", "-o"],
    &["report", "in.mcap", "-o"],
    &["fcm", "draw", "tactile", "-o"],
    &["fcm", "combine", "tactile", "tactile", "-o"],
    &["setup", "--simulate", "7", "-o"],
    &["calibrate", "--simulate", "7", "-o"],
    &["config", "new"],
];

#[test]
fn no_command_replaces_a_file_that_it_was_not_asked_to_replace() {
    let folder = Folder::new("replaced");
    for command in WRITERS {
        let words = if command.contains(&"png") { "is a file: name a folder" } else { "--force" };
        folder.refused(&[command, &["old"]].concat(), words);
        if !command.contains(&"png") {
            folder.refused(&[command, &["no-such-folder/new"]].concat(), "folder");
        }
        assert!(folder.bytes("old") == b"precious", "{command:?}");
    }
}

#[test]
fn no_command_replaces_its_input() {
    let folder = Folder::new("input");
    let before = folder.bytes("in.mcap");
    fs::hard_link(folder.0.join("in.mcap"), folder.0.join("hard.mcap")).unwrap();
    let readers: [&[&str]; 5] = [
        &["record", "--source", "replay:in.mcap@max", "--force", "-o"],
        &["export", "in.mcap", "--to", "csv", "--force", "-o"],
        &["export", "in.mcap", "--to", "npz", "--force", "-o"],
        &["report", "in.mcap", "--force", "-o"],
        &["fcm", "draw", "--source", "replay:in.mcap@max", "--force", "-o"],
    ];
    for (command, name) in readers.iter().flat_map(|c| ["in.mcap", "./in.mcap", "hard.mcap"].map(|n| (c, n)))
    {
        folder.refused(&[command, &[name][..]].concat(), "this command");
        assert!(folder.bytes("in.mcap") == before, "{command:?} {name}");
    }
    folder.refused(&["export", "in.mcap", "--to", "png", "--force", "-o", "."], "is the folder of");
}

#[test]
fn the_standard_output_takes_what_is_a_stream() {
    let folder = Folder::new("stream");
    let table = folder.run(&["export", "in.mcap", "--to", "csv", "-o", "-"]);
    assert!(table.status.success() && table.stdout.starts_with(b"time_us,panel_name,row"));
    let page = folder.run(&["report", "in.mcap", "-o", "-"]);
    assert!(page.stdout.trim_ascii_start().starts_with(b"<!"), "nothing but the page");
    let map = folder.run(&["fcm", "combine", "tactile", "tactile", "-o", "-"]);
    assert!(toml::from_str::<toml::Table>(std::str::from_utf8(&map.stdout).unwrap()).is_ok());
    for command in [
        &["export", "in.mcap", "--to", "npz", "-o", "-"][..],
        &["record", "--source", "sim:press", "-o", "-"],
    ] {
        folder.refused(command, "standard output");
    }
    folder.refused(&["export", "in.mcap", "--to", "png", "-o", "-"], "standard output");
    assert!(!folder.0.join("-").exists());
}

#[test]
fn a_recording_in_several_files_looks_for_all_its_names() {
    let folder = Folder::new("rotated");
    fs::write(folder.0.join("day-0003.mcap"), "precious").unwrap();
    let record = ["record", "--source", "sim:press", "--frames", "400", "--rotate", "1s", "-o", "day.mcap"];
    folder.refused(&record, "day-0003.mcap already exists");
    assert!(!folder.0.join("day.mcap").exists());
    assert_eq!(folder.bytes("day-0003.mcap"), b"precious");
}

#[test]
fn an_export_that_fails_names_its_recording_once() {
    let folder = Folder::new("once");
    fs::write(folder.0.join("torn.mcap"), &folder.bytes("in.mcap")[..40]).unwrap();
    for to in ["csv", "npz", "png"] {
        let done = folder.run(&["export", "torn.mcap", "--to", to, "-o", "out"]);
        let printed = String::from_utf8(done.stderr).unwrap();
        assert!(!done.status.success() && printed.contains("torn.mcap holds no image"), "{printed}");
        assert_eq!(printed.matches("torn.mcap").count(), 1, "{printed}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_named_and_a_calibration_is_printed_then() {
    let folder = Folder::new("full");
    folder.refused(&["report", "in.mcap", "-o", "/dev/full"], "/dev/full cannot be written");
    folder.refused(
        &["record", "--source", "sim:press", "--frames", "40", "-o", "/dev/full"],
        "its last record is incomplete: no space left on device",
    );
    let done = folder.run(&["calibrate", "--simulate", "7", "-o", "/dev/full"]);
    assert!(!done.status.success());
    assert!(String::from_utf8(done.stdout).unwrap().contains("[[panel"), "the numbers are printed");
    let done = folder.run(&["setup", "--simulate", "7", "-o", "/dev/full"]);
    assert!(!done.status.success());
    assert!(String::from_utf8(done.stdout).unwrap().contains("[[panel"), "the garment is printed");
}

/// A board that says nothing is recorded over a file, and the program is killed.
#[test]
fn a_recording_that_is_killed_before_a_frame_replaces_nothing() {
    let folder = Folder::new("killed");
    let board = TcpListener::bind("127.0.0.1:0").unwrap();
    let source = format!("tcp:{}", board.local_addr().unwrap());
    let robot = format!("name = \"one\"\n[[boards]]\nname = \"left\"\nsource = \"{source}\"\n");
    fs::write(folder.0.join("robot.toml"), robot).unwrap();
    let commands: [&[&str]; 2] = [
        &["record", "--source", &source, "--force", "-o", "old"],
        &["record", "robot.toml", "--force", "-o", "old"],
    ];
    for command in commands {
        let mut program = Command::new(env!("CARGO_BIN_EXE_taxel"));
        program.args(command).current_dir(&folder.0).stdin(Stdio::null());
        let mut program = program.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
        // Its first request is written once its output is begun.
        board.accept().unwrap().0.read_exact(&mut [0]).unwrap();
        assert!(folder.bytes("old") == b"precious", "{command:?}");
        program.kill().unwrap();
        program.wait().unwrap();
        assert!(folder.bytes("old") == b"precious", "{command:?}");
    }
}

/// Runs a command whose standard output or error is on a full disk.
#[cfg(target_os = "linux")]
fn on_full_disk(folder: &Folder, args: &[&str], is_error: bool) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_taxel"));
    command.args(args).current_dir(&folder.0).stdin(std::process::Stdio::null());
    let full = fs::File::options().write(true).open("/dev/full").unwrap();
    if is_error {
        command.stderr(full)
    } else {
        command.stdout(full)
    };
    command.output().unwrap()
}

#[cfg(target_os = "linux")]
#[test]
fn a_standard_output_on_a_full_disk_is_named() {
    let folder = Folder::new("output-full");
    fs::write(folder.0.join("frames.csv"), "0,0\n0,9\n").unwrap();
    let commands: [&[&str]; 7] = [
        &["info", "in.mcap"],
        &["config", "touches"],
        &["config", "schema"],
        &["process", "frames.csv", "--json"],
        &["live", "--source", "sim:press", "--frames", "5", "--json"],
        &["fcm", "tactile"],
        &["setup", "--simulate", "7"],
    ];
    for command in commands {
        let done = on_full_disk(&folder, command, false);
        let printed = String::from_utf8(done.stderr).unwrap();
        assert_eq!(done.status.code(), Some(1), "{command:?}: {printed}");
        let error = "error: the standard output cannot be written: no space left on device\n";
        assert!(printed.ends_with(error), "{command:?}: {printed}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_log_on_a_full_disk_ends_no_recording() {
    let folder = Folder::new("log-full");
    let record = ["-v", "record", "--source", "sim:press", "--frames", "40", "-o", "new.mcap"];
    let done = on_full_disk(&folder, &record, true);
    assert!(done.status.success(), "{}", done.status);
    assert!(taxel::recording::scan(&folder.0.join("new.mcap")).unwrap().whole);
    let done = on_full_disk(&folder, &["info", "no-such.mcap"], true);
    assert_eq!(done.status.code(), Some(1), "the error cannot be reported, its status can");
}
