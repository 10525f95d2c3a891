//! `taxel view` and `taxel record --view`: the pages of all boards, from outside.

use super::robot::folder;
use super::socket::Socket;
use crate::start::taxel;
use serde_json::{Value, json};
use std::collections::BTreeSet;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};
use taxel::recording::{Messages, Overview};
use tungstenite::client::IntoClientRequest;
use tungstenite::{Message, WebSocket};

/// Longest wait for a message.
const PATIENCE: Duration = Duration::from_secs(60);

/// A robot whose hand can be unplugged.
fn robot(hand: &Socket) -> String {
    format!(
        "name = \"two\"\n[[boards]]\nname = \"torso\"\nsource = \"sim:five\"\ngarment = \"reference\"\n\
         body = \"reference\"\n[[boards]]\nname = \"hand\"\nsource = \"tcp:{}\"\ngarment = \"block-4x16\"\n",
        hand.address
    )
}

/// The program, and the port of its pages.
pub struct Viewed(pub Child, u16);

impl Viewed {
    fn start(name: &str, robot: &str) -> Viewed {
        Viewed::run(&folder(name, robot), &["view", "robot.toml"], "robot two")
    }

    /// Runs the program in a folder; its first line says what it shows.
    pub fn run(folder: &Path, args: &[&str], what: &str) -> Viewed {
        let mut program = Command::new(taxel())
            .current_dir(folder)
            .args(args)
            .args(["--port", "0"])
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let mut line = String::new();
        BufReader::new(program.stdout.take().unwrap()).read_line(&mut line).unwrap();
        let port = line.split("127.0.0.1:").nth(1).and_then(|rest| rest.split('/').next()).unwrap();
        let port = port.parse().unwrap();
        assert_eq!(line, format!("{what} at http://127.0.0.1:{port}/ (Ctrl-C ends)\n"));
        Viewed(program, port)
    }

    pub fn page(&self, path: &str) -> WebSocket<TcpStream> {
        let stream = TcpStream::connect(("127.0.0.1", self.1)).unwrap();
        stream.set_read_timeout(Some(PATIENCE)).unwrap();
        let request = format!("ws://127.0.0.1:{}{path}", self.1).into_client_request().unwrap();
        tungstenite::client(request, stream).unwrap().0
    }

    fn get(&self, path: &str) -> String {
        let mut stream = TcpStream::connect(("127.0.0.1", self.1)).unwrap();
        write!(stream, "GET {path} HTTP/1.1\r\nHost: localhost:{}\r\n\r\n", self.1).unwrap();
        let mut bytes = Vec::new();
        stream.read_to_end(&mut bytes).unwrap();
        String::from_utf8_lossy(&bytes).into_owned()
    }
}

impl Drop for Viewed {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// Reads until a line of this type meets the condition; fails after a while.
pub fn line(page: &mut WebSocket<TcpStream>, kind: &str, wanted: impl Fn(&Value) -> bool) -> Value {
    let (until, mut last) = (Instant::now() + PATIENCE, Value::Null);
    while Instant::now() < until {
        let Message::Text(text) = page.read().unwrap() else { continue };
        let line: Value = serde_json::from_str(&text).unwrap();
        if line["type"] == kind {
            if wanted(&line) {
                return line;
            }
            last = line;
        }
    }
    panic!("no such {kind} in {PATIENCE:?}; the last one was {last}");
}

#[test]
fn each_board_has_its_page_and_each_page_reports_all_boards() {
    let hand = Socket::new("block-4x16");
    let viewed = Viewed::start("view", &robot(&hand));
    let [mut first, mut torso, mut other] =
        ["/socket", "/boards/torso/socket", "/boards/hand/socket"].map(|path| viewed.page(path));
    for (page, garment) in [(&mut first, "reference"), (&mut torso, "reference"), (&mut other, "block-4x16")]
    {
        line(page, "hello", |line| line["garment"] == garment);
    }
    let state = |line: &Value, at: usize, state: &str| line["boards"][at]["state"] == state;
    let live = line(&mut torso, "robot", |line| state(line, 0, "live") && state(line, 1, "live"));
    assert_eq!((&live["name"], &live["board"]), (&json!("two"), &json!("torso")));
    assert_eq!((&live["boards"][0]["name"], &live["boards"][1]["name"]), (&json!("torso"), &json!("hand")));
    line(&mut torso, "robot", |line| line["boards"][0]["contacts"] == 5);
    line(&mut viewed.page("/boards/torso/socket"), "body", |_| true);
    // What their touches mean together is on the page of either board.
    let touched = |meant: &Value| -> BTreeSet<u64> {
        let touches = meant["touches"].as_array().unwrap().iter();
        touches.map(|touch| touch["board"].as_u64().unwrap()).collect()
    };
    for page in [&mut torso, &mut other] {
        let meant =
            line(page, "robot_intent", |line| line["touches"].as_array().is_some_and(|all| all.len() > 5));
        assert!(meant["text"].as_str().unwrap().starts_with(meant["leading"].as_str().unwrap()), "{meant}");
        assert_eq!(touched(&meant), [0, 1].into());
    }
    hand.plug(None);
    let lost = line(&mut torso, "robot", |line| state(line, 1, "lost"));
    assert!(
        state(&lost, 0, "live") && lost["boards"][1]["since_us"].as_u64().unwrap() > 1_700_000_000_000_000
    );
    assert!(lost["boards"][1]["why"].is_string() && lost["boards"][1]["contacts"] == 0, "{lost}");
    line(&mut torso, "robot_intent", |line| touched(line) == [0].into());
    // A board that is another one is never live, and the hand's page goes on to report the torso.
    hand.plug(Some("mat-64x32"));
    line(&mut other, "robot", |line| state(line, 1, "other") && line["board"] == "hand");
    hand.plug(Some("block-4x16"));
    let back = line(&mut other, "robot", |line| state(line, 1, "live"));
    assert_eq!((&back["boards"][1]["since_us"], &back["boards"][1]["why"]), (&json!(null), &json!(null)));
    other.send(Message::text("{\"tare\": 8}")).unwrap();
    line(&mut other, "say", |line| line["said"].as_str().unwrap().ends_with("tare: done"));
}

#[test]
fn files_are_those_of_a_board_and_nothing_else_is_served() {
    let hand = Socket::new("block-4x16");
    let viewed = Viewed::start("view-files", &robot(&hand));
    for path in ["/", "/boards/torso/", "/boards/hand/", "/boards/hand/robot.js"] {
        assert!(viewed.get(path).starts_with("HTTP/1.1 200 OK\r\n"), "{path}");
    }
    for path in ["/boards/foot/", "/boards/hand", "/boards/", "/boards/hand/no.js", "/boards/foot/socket"] {
        assert!(viewed.get(path).starts_with("HTTP/1.1 404 Not Found\r\n"), "{path}");
    }
    let mut page = viewed.page("/boards/hand/socket");
    line(&mut page, "link", |line| line["rate"].as_f64().unwrap() > 0.0);
    assert!(viewed.get("/boards/hand/recording.mcap").contains("filename=\"recording.mcap\""));
}

#[test]
fn with_a_time_it_ends_and_a_board_that_never_comes_is_an_error() {
    let hand = Socket::new("block-4x16");
    let gone = robot(&hand).replace(&format!("tcp:{}", hand.address), "serial:nowhere");
    let run = |name: &str, text: &str| {
        let mut command = Command::new(taxel());
        command.args(["view", "robot.toml", "--port", "0", "--for", "0.5s"]);
        command.current_dir(folder(name, text)).stdin(Stdio::null()).output().unwrap()
    };
    assert!(run("view-time", &robot(&hand)).status.success());
    let done = run("view-gone", &gone);
    assert_eq!(done.status.code(), Some(3));
    let error = String::from_utf8(done.stderr).unwrap();
    assert!(error.starts_with("error: board hand: serial port nowhere"), "{error}");
}

/// Two simulated boards.
const TWO: &str = "name = \"two\"\n[[boards]]\nname = \"torso\"\nsource = \"sim:five\"\ngarment = \"reference\"\n\
    body = \"reference\"\n[[boards]]\nname = \"hand\"\nsource = \"sim:press\"\ngarment = \"block-4x16\"\n";

/// What a recording holds below these topics, by topic: the bytes of the wire, and images and JSON without the host's
/// times.
pub fn held(path: &Path, below: &[&str]) -> Vec<(String, Vec<Vec<u8>>)> {
    let overview = Overview::of(path).unwrap();
    let topics = overview.channels.iter().map(|info| info.channel.topic.clone());
    let own = topics.filter(|topic| below.iter().any(|below| topic.starts_with(below)));
    let mut all: Vec<_> = own
        .map(|topic| {
            let (mut messages, mut printed) = (Messages::of_topic(path, &topic).unwrap(), Vec::new());
            while let Some(message) = messages.next_message().unwrap() {
                let bytes = match serde_json::from_slice::<Value>(message.data) {
                    Ok(mut line) => {
                        line.as_object_mut().unwrap().remove("host_time_us");
                        line.to_string().into_bytes()
                    }
                    // The time is the first field: its tag, its length, itself.
                    Err(_) if topic.ends_with("/image") => {
                        message.data[2 + usize::from(message.data[1])..].to_vec()
                    }
                    Err(_) => message.data.to_vec(),
                };
                printed.push(bytes);
            }
            (topic, printed)
        })
        .collect();
    all.sort();
    all
}

#[test]
fn a_recording_is_watched_while_it_is_made_and_is_the_same() {
    let folder = folder("record-view", TWO);
    let record =
        |file: &'static str| ["record", "robot.toml", "--realtime", "--for", "3s", "--force", "-o", file];
    let mut viewed = Viewed::run(&folder, &[&record("watched.mcap")[..], &["--view"]].concat(), "robot two");
    let [mut torso, mut hand, _asleep] =
        ["/boards/torso/socket", "/boards/hand/socket", "/boards/torso/socket"].map(|path| viewed.page(path));
    torso.send(Message::text("{\"hover\": 9}")).unwrap();
    line(&mut torso, "hello", |line| line["garment"] == "reference");
    line(&mut hand, "hello", |line| line["garment"] == "block-4x16");
    line(&mut torso, "robot", |line| {
        line["boards"][0]["contacts"] == 5 && line["boards"][1]["state"] == "live"
    });
    line(&mut hand, "robot_intent", |line| line["touches"].as_array().is_some_and(|all| all.len() > 4));
    while !torso.read().unwrap().is_binary() {}
    // The other page has not read a byte.
    assert!(viewed.0.wait().unwrap().success());
    let alone = Command::new(taxel()).current_dir(&folder).args(record("alone.mcap")).output().unwrap();
    assert!(alone.status.success());
    let [watched, alone] = ["watched.mcap", "alone.mcap"]
        .map(|file| held(&folder.join(file), &["/taxel/torso/", "/taxel/hand/"]));
    assert_eq!(
        watched.iter().map(|(topic, all)| (topic, all.len())).collect::<Vec<_>>(),
        alone.iter().map(|(topic, all)| (topic, all.len())).collect::<Vec<_>>()
    );
    assert!(watched == alone);
    assert!(alone.iter().any(|(topic, all)| topic == "/taxel/torso/frames" && all.len() > 500));
}

#[test]
fn what_is_said_of_a_page_needs_one() {
    let folder = folder("record-unseen", TWO);
    let args = ["record", "robot.toml", "-o", "out.mcap", "--port", "0"];
    let done = Command::new(taxel()).current_dir(&folder).args(args).output().unwrap();
    assert_eq!(done.status.code(), Some(2));
    assert!(String::from_utf8(done.stderr).unwrap().contains("--view"));
    assert!(!folder.join("out.mcap").exists());
}
