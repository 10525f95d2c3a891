//! Boards between programs, over Zenoh, from outside.

#[path = "../program/socket.rs"]
mod socket;

use serde_json::{Value, json};
use socket::Socket;
use std::io::{BufRead, BufReader};
use std::net::TcpListener;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};

/// A folder of a test, with the files of a network that nobody else is in.
fn network(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("zenoh-program").join(name);
    std::fs::create_dir_all(&folder).unwrap();
    let port = TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap().port();
    let meeting = [format!("tcp/127.0.0.1:{port}")];
    let router = json!({ "mode": "router", "listen": { "endpoints": meeting } });
    let client = json!({ "mode": "client", "connect": { "endpoints": meeting } });
    std::fs::write(folder.join("router.json5"), router.to_string()).unwrap();
    std::fs::write(folder.join("client.json5"), client.to_string()).unwrap();
    folder
}

fn taxel(folder: &Path, args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_taxel"));
    command.args(args).current_dir(folder).env_remove("ZENOH_CONFIG");
    command
}

fn run(folder: &Path, args: &[&str]) -> Output {
    taxel(folder, args).output().unwrap()
}

/// A program that runs until this is dropped.
struct Serving(Child);

impl Serving {
    /// Starts it, and waits until it says that it offers boards.
    fn start(folder: &Path, args: &[&str]) -> Serving {
        let errors = std::fs::File::create(folder.join("errors.txt")).unwrap();
        let mut child = taxel(folder, args).stdout(Stdio::piped()).stderr(errors).spawn().unwrap();
        let mut line = String::new();
        BufReader::new(child.stdout.take().unwrap()).read_line(&mut line).unwrap();
        assert!(line.contains("(Ctrl-C ends)"), "{line}");
        Serving(child)
    }
}

impl Drop for Serving {
    fn drop(&mut self) {
        self.0.kill().unwrap();
        self.0.wait().unwrap();
    }
}

fn lines(output: &Output) -> Vec<Value> {
    let text = std::str::from_utf8(&output.stdout).unwrap();
    text.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

fn said(output: &Output) -> &str {
    std::str::from_utf8(&output.stderr).unwrap()
}

#[test]
fn a_board_is_followed_by_another_program_and_offered_once() {
    let folder = network("one");
    let args = ["serve", "--source", "sim:five", "--name", "arm/left", "--zenoh"];
    let _serving = Serving::start(&folder, &[&args[..], &["router.json5"]].concat());
    let watched = run(&folder, &["live", "--source", "zenoh:arm/left@client.json5", "--json", "--for", "1s"]);
    assert!(watched.status.success(), "{}", said(&watched));
    let lines = lines(&watched);
    let of = |kind: &str| lines.iter().filter(|line| line["type"] == kind).count();
    assert!(of("hello") > 0 && of("frame") > 100 && of("contacts") > 50, "{}", lines.len());
    assert!(lines.iter().any(|line| line["host_time_uncertainty_us"].as_u64().is_some_and(|us| us < 50_000)));
    let second = run(&folder, &[&args[..], &["client.json5"]].concat());
    assert_eq!(second.status.code(), Some(2));
    assert!(said(&second).contains("arm/left is offered by another program"), "{}", said(&second));
    let unknown = run(&folder, &["live", "--source", "zenoh:arm/right@client.json5"]);
    assert_eq!(unknown.status.code(), Some(3));
    assert!(said(&unknown).contains("zenoh:arm/right: nobody in the network offers this board"));
}

#[test]
fn a_lost_board_is_reported_to_its_viewers_and_another_one_ends_the_offer() {
    let (folder, socket) = (network("lost"), Socket::new("block-4x16"));
    let source = format!("tcp:{}", socket.address);
    let args = ["serve", "--source", &source, "--name", "arm/left", "--zenoh", "router.json5"];
    let mut serving = Serving::start(&folder, &args);
    let args = ["live", "--source", "zenoh:arm/left@client.json5", "--json", "--wait"];
    let viewer = taxel(&folder, &args).stdout(Stdio::piped()).spawn().unwrap();
    let mut viewer = Serving(viewer);
    let mut lines = BufReader::new(viewer.0.stdout.take().unwrap()).lines();
    let mut lists = std::iter::from_fn(|| {
        let line = lines.find(|line| {
            let line = line.as_ref().unwrap();
            line.contains("\"type\":\"contacts\"") || line.contains("\"type\":\"lost\"")
        });
        Some(serde_json::from_str::<Value>(&line?.unwrap()).unwrap())
    });
    let touches = |line: &Value| line["contacts"].as_array().is_some_and(|all| !all.is_empty());
    assert!(lists.any(|line| touches(&line)), "it presses");
    socket.plug(None);
    let ended: Vec<Value> = lists.by_ref().take_while(|line| line["type"] == "contacts").collect();
    let last = ended.last().unwrap();
    assert!(!touches(last) && !last["released"].as_array().unwrap().is_empty(), "{last}");
    socket.plug(Some("mat-64x32"));
    let status = serving.0.wait().unwrap();
    let errors = std::fs::read_to_string(folder.join("errors.txt")).unwrap();
    let why = "answers with another board: it has the garment mat-64x32, not block-4x16";
    assert_eq!((status.code(), errors.contains(&format!("{source} is gone: "))), (Some(3), true), "{errors}");
    assert!(errors.contains(&format!("error: {source} {why}")), "{errors}");
}

#[test]
fn at_the_fastest_rate_nothing_is_lost_between_two_programs() {
    let folder = network("fastest");
    let args = ["serve", "--source", "sim:five", "--garment", "block-4x16", "--name", "arm/left", "--zenoh"];
    let _serving = Serving::start(&folder, &[&args[..], &["router.json5"]].concat());
    let watched = run(&folder, &["live", "--source", "zenoh:arm/left@client.json5", "--json", "--for", "4s"]);
    assert!(watched.status.success(), "{}", said(&watched));
    let lines = lines(&watched);
    let frames: Vec<_> = lines.iter().filter(|line| line["type"] == "frame").collect();
    let lost = frames.last().map(|frame| &frame["lost"]);
    assert!(frames.len() > 5000 && lost == Some(&0.into()), "{lost:?} lost of {} frames", frames.len());
}

#[test]
fn the_boards_of_a_robot_are_offered_and_followed_as_a_robot() {
    let folder = network("robot");
    let robot = |sources: [&str; 2]| {
        let boards = sources.iter().zip(["torso", "hand"]);
        let boards =
            boards.map(|(source, name)| format!("[[boards]]\nname = \"{name}\"\nsource = \"{source}\"\n"));
        format!("name = \"two\"\n{}", boards.collect::<String>())
    };
    std::fs::write(folder.join("here.toml"), robot(["sim:five", "sim:press"])).unwrap();
    let there = ["torso", "hand"].map(|board| format!("zenoh:two/{board}@client.json5"));
    std::fs::write(folder.join("there.toml"), robot([&there[0], &there[1]])).unwrap();
    let _serving = Serving::start(&folder, &["serve", "here.toml", "--zenoh", "router.json5"]);
    let watched = run(&folder, &["live", "there.toml", "--json", "--for", "1s"]);
    assert!(watched.status.success(), "{}", said(&watched));
    let lines = lines(&watched);
    for board in ["torso", "hand"] {
        let of =
            |kind: &str| lines.iter().filter(|line| line["board"] == board && line["type"] == kind).count();
        assert!(of("frame") > 20 && of("hello") > 0, "{board}: {} frames", of("frame"));
    }
}

#[test]
fn a_wrong_file_or_name_ends_with_a_sentence() {
    let folder = network("wrong");
    std::fs::write(folder.join("wrong.json5"), "{ mode: \"boss\" }").unwrap();
    std::fs::write(
        folder.join("robot.toml"),
        "name = \"a b\"\n[[boards]]\nname = \"x\"\nsource = \"sim:pat\"\n",
    )
    .unwrap();
    for (args, why) in [
        (vec!["serve", "--source", "sim:pat", "--zenoh", "wrong.json5"], "wrong.json5: mode: "),
        (vec!["live", "--source", "zenoh:a/b@no-such.json5"], "no-such.json5 cannot be read"),
        (vec!["serve", "--name", "arm"], "a board is named ROBOT/BOARD, as in arm/left"),
        (
            vec!["serve", "robot.toml", "--zenoh", "router.json5"],
            "robot.toml: the name of a robot is 1 to 32 letters, digits, _ and -, not \"a b\"",
        ),
    ] {
        let output = run(&folder, &args);
        assert!(!output.status.success() && said(&output).contains(why), "{}", said(&output));
    }
    let nobody = run(&folder, &["live", "--source", "zenoh:a/b@client.json5"]);
    assert_eq!(nobody.status.code(), Some(3));
    assert!(said(&nobody).contains("no network by client.json5"), "{}", said(&nobody));
}
