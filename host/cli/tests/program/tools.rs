//! Commands about a board, an example, and the documents for other programs, tested from outside.

use crate::start::{example, root, taxel};
use serde_json::Value;
use std::io::{BufRead, BufReader, ErrorKind, Read, Write};
use std::net::TcpListener;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::sync::LazyLock;
use std::time::Duration;
use taxel::source::{self, SourceOptions};
use taxel_cli::watch::raw::RawBoard;
use taxel_core::garment::Garment;
use taxel_core::scene::Scene;
use taxel_core::wire::{LONGEST_REQUEST, REPORTS, REQUESTS, Receiver, Report, Request, decode, open};

pub fn run(args: &[&str]) -> Output {
    Command::new(taxel()).args(args).output().unwrap()
}

pub fn said(args: &[&str]) -> String {
    let output = run(args);
    assert!(output.status.success(), "{args:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

pub fn refused(status: i32, args: &[&str]) -> String {
    let output = run(args);
    assert_eq!(output.status.code(), Some(status), "{args:?}");
    String::from_utf8(output.stderr).unwrap()
}

/// Path of a new file of these tests.
pub fn file(name: &str) -> PathBuf {
    // Without the files of an earlier run: a schema of then would not be replaced.
    static FOLDER: LazyLock<PathBuf> = LazyLock::new(|| {
        let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("tools");
        _ = std::fs::remove_dir_all(&folder);
        std::fs::create_dir_all(&folder).unwrap();
        folder
    });
    let path = FOLDER.join(name);
    let _ = std::fs::remove_file(&path);
    path
}

#[test]
fn a_simulated_board_is_examined() {
    let line: Value =
        serde_json::from_str(&said(&["doctor", "--source", "sim:idle", "--for", "2s", "--json"])).unwrap();
    assert_eq!(line["verdict"], "weak", "{line}");
    let found = line["findings"].as_array().unwrap();
    let of = |name: &str| found.iter().rfind(|finding| finding["of"] == name).unwrap();
    for name in ["version", "images", "scan", "taxels"] {
        assert_eq!(of(name)["grade"], "good", "{line}");
    }
    assert!(of("images")["what"].as_str().unwrap().starts_with("195."), "{line}");
    assert_eq!(of("calibration")["grade"], "weak");
    assert!(said(&["doctor", "--source", "sim:idle", "--for", "1s"]).ends_with("marked with !\n"));
    let nobody = refused(3, &["doctor", "--source", "serial:/dev/no-such-port"]);
    assert!(nobody.contains("taxel ports"), "{nobody}");
}

#[test]
fn ports_are_listed_and_a_wrong_firmware_is_refused() {
    let ports: Value = serde_json::from_str(&said(&["ports", "--json"])).unwrap();
    assert!(ports.is_array());
    let text = file("firmware.uf2");
    std::fs::write(&text, "not a firmware").unwrap();
    assert!(refused(1, &["flash", text.to_str().unwrap()]).contains("neither an ELF nor a UF2"));
    assert!(refused(1, &["flash", "no-such-file.uf2"]).contains("no-such-file.uf2 cannot be read"));
}

#[test]
fn a_garment_file_is_begun_and_checked() {
    let garment = file("mine.toml");
    let name = garment.to_str().unwrap();
    said(&["config", "new", name, "--like", "reference"]);
    assert!(refused(1, &["config", "new", name]).contains("already exists"));
    let text = std::fs::read_to_string(&garment).unwrap();
    assert!(text.starts_with("#:schema ./taxel-garment.schema.json\n"), "{text}");
    let schema = std::fs::read_to_string(garment.with_file_name("taxel-garment.schema.json")).unwrap();
    assert_eq!(schema, said(&["config", "schema"]));
    assert_eq!(schema, said(&["config", "schema", "garment"]));
    assert!(said(&["config", "check", name]).contains("2048 taxels in 4 panels and 32 blocks: fits."));
    let scene = file("scene.toml");
    std::fs::write(&scene, "name = \"calm\"\nrate_hz = 50\n").unwrap();
    assert!(
        said(&["config", "check", name, "--scene", scene.to_str().unwrap()])
            .contains("scene calm can be played")
    );
    std::fs::write(&garment, text.replacen("rows = 32", "rows = 31", 1)).unwrap();
    let why = refused(1, &["config", "check", name]);
    assert!(why.contains("mine.toml, line ") && why.contains("panel chest"), "{why}");
}

#[test]
fn a_simulated_garment_is_calibrated_and_checked() {
    let calibration = file("calibration.toml");
    let name = calibration.to_str().unwrap();
    let lines = said(&["calibrate", "--simulate", "11", "--by", "Anna", "--json", "-o", name]);
    let last: Value = serde_json::from_str(lines.lines().last().unwrap()).unwrap();
    assert!(last["type"] == "calibrated" && last["fit"]["error"].as_f64().unwrap() < 0.03, "{last}");
    assert_eq!(lines.lines().filter(|line| line.contains("\"reading\"")).count(), 9);
    let text = std::fs::read_to_string(&calibration).unwrap();
    assert!(text.contains("by = \"Anna\"") && text.contains("a plate on each panel (1)"), "{text}");
    // Another board, which was never calibrated, and another garment.
    let check = run(&["calibrate", "check", name, "--source", "sim:idle", "--json"]);
    assert_eq!(check.status.code(), Some(1), "it does not hold");
    let check = String::from_utf8(check.stdout).unwrap();
    let check: Value = serde_json::from_str(check.lines().last().unwrap()).unwrap();
    assert_eq!(check["holds"], false);
    let why = check["why"].to_string();
    assert!(why.contains("no calibration") && why.contains("2048 taxels"), "{why}");
    assert!(
        refused(2, &["calibrate", "--weights", "1,0", "--simulate", "1"])
            .contains("--weights must be above 0")
    );
}

/// Serves a simulated board over TCP until the client is gone. Returns the garments and the scenes that it
/// received.
fn serve(listener: &TcpListener) -> [Vec<Vec<u8>>; 2] {
    let options = SourceOptions { realtime: true, ..RawBoard::options() };
    let mut board = source::open(&"sim:idle".parse().unwrap(), &options).unwrap();
    let mut socket = listener.accept().unwrap().0;
    socket.set_read_timeout(Some(Duration::from_millis(1))).unwrap();
    let mut receiver = Receiver::<LONGEST_REQUEST>::new();
    let (mut received, mut buffer) = ([Vec::new(), Vec::new()], [0; 4096]);
    loop {
        match socket.read(&mut buffer) {
            Ok(0) => return received,
            Ok(count) => {
                board.port.write(&buffer[..count]).unwrap();
                for byte in &buffer[..count] {
                    match receiver.push(*byte).map(|bytes| decode::<Request>(bytes.unwrap()).unwrap()) {
                        Some(Request::SetGarment(bytes)) => received[0].push(bytes.to_vec()),
                        Some(Request::SetScene(bytes)) => received[1].push(bytes.to_vec()),
                        _ => {}
                    }
                }
            }
            Err(error) if matches!(error.kind(), ErrorKind::WouldBlock | ErrorKind::TimedOut) => {}
            Err(_) => return received,
        }
        let count = board.port.read(&mut buffer).unwrap().unwrap();
        if socket.write_all(&buffer[..count]).is_err() {
            return received;
        }
    }
}

#[test]
#[cfg(unix)]
fn after_ctrl_c_the_board_has_its_garment_again() {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let source = format!("tcp:{}", listener.local_addr().unwrap());
    let board = std::thread::spawn(move || serve(&listener));
    let mut setup = Command::new(taxel());
    setup.args(["setup", "--source", &source, "--json"]).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = setup.spawn().unwrap();
    let mut asked = String::new();
    BufReader::new(child.stdout.take().unwrap()).read_line(&mut asked).unwrap();
    assert!(asked.contains("\"ask\""), "{asked}");
    Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(String::from_utf8(output.stderr).unwrap(), "error: ended by Ctrl-C\n");
    let [garments, scenes] = board.join().unwrap();
    let reference = postcard::to_allocvec(&Garment::reference()).unwrap();
    assert!(garments.len() == 2 && garments[0] != reference && garments[1] == reference);
    let shipped = postcard::to_allocvec(&Scene::shipped()).unwrap();
    assert!(scenes.len() == 2 && scenes[0] != shipped && scenes[1] == shipped);
}

#[test]
fn the_example_prints_intentions() {
    let output = Command::new(example("intentions")).arg("sim:pat").output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success() && text.contains("Kindness"), "{text}");
    let code = std::fs::read_to_string(root().join("host/taxel/examples/intentions.rs")).unwrap();
    let lines = code.lines().filter(|line| !line.is_empty() && !line.starts_with("//")).count();
    assert!(lines <= 20, "{lines} lines");
}

#[test]
fn each_example_runs() {
    let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join("example.mcap");
    let file = file.to_str().unwrap();
    let rows: [(&str, &[&str], &str); 5] = [
        ("observer", &["sim:pat", file], "3 contacts; "),
        ("recording", &[file], ": image 20, at most "),
        ("robot", &[], "right: Attack\n"),
        ("virtual_board", &[], "150000 us: 1 contacts\n"),
        ("map", &["press=0.8", "time=-0.9"], "time -> attack\n"),
    ];
    for (name, words, received) in rows {
        let output = Command::new(example(name)).args(words).output().unwrap();
        let text = String::from_utf8(output.stdout).unwrap();
        assert!(output.status.success() && text.contains(received), "{name}: {text}");
    }
}

fn bytes(hex: &str) -> Vec<u8> {
    (0..hex.len()).step_by(2).map(|at| u8::from_str_radix(&hex[at..at + 2], 16).unwrap()).collect()
}

#[test]
fn the_bytes_of_the_wire_document_are_golden_and_decode() {
    let document = std::fs::read_to_string(root().join("docs/reference/wire.md")).unwrap();
    let golden = std::fs::read_to_string(root().join("core/tests/core/golden/wire.txt")).unwrap();
    let shown = document
        .lines()
        .filter(|line| ["report ", "request ", "frame "].iter().any(|kind| line.starts_with(kind)));
    let mut count = 0;
    for line in shown {
        assert!(golden.lines().any(|golden| golden == line), "{line}");
        let mut words = line.split(' ');
        let (kind, name, mut bytes) =
            (words.next().unwrap(), words.next().unwrap(), bytes(words.next().unwrap()));
        let debug = match kind {
            "report" => format!("{:?}", decode::<(u32, Report)>(&bytes).unwrap().1),
            "request" => format!("{:?}", decode::<Request>(&bytes).unwrap()),
            _ => {
                let end = bytes.len() - 1;
                format!("{:?}", decode::<Request>(open(&mut bytes[..end]).unwrap()).unwrap())
            }
        };
        assert!(debug.starts_with(name), "{line}: {debug}");
        count += 1;
    }
    assert!(count > 10, "{count} lines");
    // Every message has its row.
    for (number, (name, when)) in REPORTS.iter().enumerate() {
        let row = format!("| {number} | `{name}` | {when} | ");
        assert!(document.contains(&row), "{row}");
    }
    for (number, name) in REQUESTS.iter().enumerate() {
        let row = format!("| {number} | `{name}` | ");
        assert!(document.contains(&row), "{row}");
    }
}

#[test]
fn the_commands_of_the_troubleshooting_table_exist() {
    let document = std::fs::read_to_string(root().join("docs/guides/troubleshooting.md")).unwrap();
    let help = said(&["--help"]);
    let commands = document.split('`').skip(1).step_by(2).filter_map(|code| code.strip_prefix("taxel "));
    let mut count = 0;
    for command in commands.filter_map(|rest| rest.split(' ').next()) {
        assert!(help.lines().any(|line| line.trim_start().starts_with(&format!("{command} "))), "{command}");
        count += 1;
    }
    assert!(count > 15);
}

#[test]
fn the_tests_that_hold_the_promises_exist() {
    let document = std::fs::read_to_string(root().join("docs/concepts/promises.md")).unwrap();
    let mut count = 0;
    for row in document.lines().filter(|line| line.starts_with("| ")) {
        let codes: Vec<&str> = row.split('`').skip(1).step_by(2).collect();
        let (mut names, mut found) = (Vec::new(), 0);
        for code in codes.into_iter().filter(|code| !code.contains(' ')) {
            if !code.ends_with(".rs") {
                names.push(code);
                continue;
            }
            let file = std::fs::read_to_string(root().join(code)).unwrap();
            for name in names.drain(..) {
                assert!(file.contains(&format!("\nfn {name}()")), "{name} in {code}");
                found += 1;
            }
        }
        assert!(names.is_empty(), "no file is given for {names:?}");
        let is_promise = !row.starts_with("| promise ");
        assert!(found > 0 || !is_promise, "no test holds this: {row}");
        count += found;
    }
    assert!(count > 25, "{count}");
}
