//! Pressing a simulated garment from a page: what is felt is what the saved file plays. A real board is not pressed.

use crate::plugged::stage::{board, folder};
use crate::start::taxel;
use fastrand::Rng;
use serde_json::{Value, json};
use std::io::{BufRead, BufReader, Read, Write};
use std::net::{Ipv4Addr, TcpStream};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};
use tungstenite::client::IntoClientRequest;
use tungstenite::{Message, WebSocket};

/// `taxel view` of a source, which ends with the test.
struct View {
    program: Child,
    port: u16,
}

impl Drop for View {
    fn drop(&mut self) {
        let _ = self.program.kill();
        let _ = self.program.wait();
    }
}

impl View {
    fn of(source: &str) -> View {
        let mut command = Command::new(taxel());
        command
            .args(["view", "--port", "0", "--tare", "16", "--source", source])
            .stdin(Stdio::null())
            .stdout(Stdio::piped());
        let mut program = command.spawn().unwrap();
        let mut line = String::new();
        BufReader::new(program.stdout.take().unwrap()).read_line(&mut line).unwrap();
        let port = line.split("127.0.0.1:").nth(1).and_then(|rest| rest.split('/').next()).unwrap();
        View { port: port.parse().unwrap(), program }
    }

    fn page(&self) -> Page {
        let stream = TcpStream::connect((Ipv4Addr::LOCALHOST, self.port)).unwrap();
        stream.set_read_timeout(Some(Duration::from_secs(30))).unwrap();
        let request = format!("ws://127.0.0.1:{}/socket", self.port).into_client_request().unwrap();
        let socket = tungstenite::client(request, stream).unwrap().0;
        Page { socket, image: Value::Null, hand: Value::Null }
    }

    /// Status and contents of a file.
    fn file(&self, name: &str) -> (String, Vec<u8>) {
        let mut stream = TcpStream::connect((Ipv4Addr::LOCALHOST, self.port)).unwrap();
        write!(stream, "GET /{name} HTTP/1.1\r\nHost: localhost:{}\r\n\r\n", self.port).unwrap();
        stream.shutdown(std::net::Shutdown::Write).unwrap();
        let mut bytes = Vec::new();
        stream.read_to_end(&mut bytes).unwrap();
        let end = bytes.windows(4).position(|window| window == b"\r\n\r\n").unwrap();
        (String::from_utf8_lossy(&bytes[9..12]).into_owned(), unchunked(&bytes[..end], &bytes[end + 4..]))
    }
}

/// The body of an answer.
fn unchunked(head: &[u8], mut body: &[u8]) -> Vec<u8> {
    if !String::from_utf8_lossy(head).contains("chunked") {
        return body.into();
    }
    let mut whole = Vec::new();
    loop {
        let end = body.windows(2).position(|window| window == b"\r\n").unwrap();
        let length = usize::from_str_radix(std::str::from_utf8(&body[..end]).unwrap(), 16).unwrap();
        if length == 0 {
            return whole;
        }
        whole.extend(&body[end + 2..end + 2 + length]);
        body = &body[end + 4 + length..];
    }
}

/// A page, with the last image's head and the last `hand` that it was sent.
struct Page {
    socket: WebSocket<TcpStream>,
    image: Value,
    hand: Value,
}

impl Page {
    fn ask(&mut self, request: &Value) {
        self.socket.send(Message::Text(request.to_string().into())).unwrap();
    }

    fn press(&mut self, finger: u8, tool: &str, panel: u8, at: [f64; 2], force_n: f64) {
        let press = json!({"finger": finger, "tool": tool, "panel": panel, "at": at, "force_n": force_n});
        self.ask(&json!({"press": press}));
    }

    fn contacts(&self) -> &[Value] {
        self.image["frame"]["contacts"].as_array().unwrap()
    }

    /// Reads what it is sent for a while.
    fn read(&mut self, ms: u64) {
        let began = Instant::now();
        while began.elapsed() < Duration::from_millis(ms) {
            match self.socket.read().unwrap() {
                Message::Binary(bytes) => {
                    let length = u32::from_le_bytes(bytes[..4].try_into().unwrap()) as usize;
                    self.image = serde_json::from_slice(&bytes[4..4 + length]).unwrap();
                }
                Message::Text(text) => {
                    let line: Value = serde_json::from_str(&text).unwrap();
                    if line["type"] == "hand" {
                        self.hand = line;
                    }
                }
                _ => {}
            }
        }
    }
}

/// Frames with contacts, by number, without what the host adds.
fn felt(lines: impl IntoIterator<Item = Value>) -> Vec<(u64, Value)> {
    let frames =
        lines.into_iter().filter(|line| line["contacts"].as_array().is_some_and(|all| !all.is_empty()));
    frames.map(|line| (line["frame"].as_u64().unwrap(), line["contacts"].clone())).collect()
}

fn lines(path: &[&str]) -> Vec<Value> {
    let output = Command::new(taxel()).args(path).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout)
        .unwrap()
        .lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect()
}

/// Contacts that a page's recording has, and those that the saved script gives.
fn compare(view: &View, folder: &Path) -> usize {
    let [recording, script] = ["hand.mcap", "touches.toml"].map(|name| folder.join(name));
    for (name, path) in [("recording.mcap", &recording), ("touches.toml", &script)] {
        let (status, bytes) = view.file(name);
        assert_eq!(status, "200", "{name}");
        std::fs::write(path, bytes).unwrap();
    }
    let source = format!("sim:{}", script.display());
    let replay = format!("replay:{}@max", recording.display());
    let live = felt(lines(&["live", "--json", "--source", &replay]));
    let played = felt(lines(&["live", "--json", "--source", &source]));
    assert_eq!(live.len(), played.len());
    live.iter().zip(&played).for_each(|(live, played)| assert_eq!(live, played));
    live.len()
}

#[test]
fn what_a_page_presses_is_felt_and_its_file_plays_the_same_to_the_last_bit() {
    let view = View::of("sim:idle");
    let mut page = view.page();
    page.read(700);
    let tools = ["fingertip", "pen", "palm", "forearm", "ball", "strap"];
    let printed: Vec<_> =
        page.hand["tools"].as_array().unwrap().iter().map(|tool| tool["name"].clone()).collect();
    assert_eq!(printed, tools);
    assert!(page.hand["scripts"].as_array().unwrap().len() > 9 && page.hand["touches"] == 0, "{}", page.hand);
    assert_eq!(page.hand["playing"], Value::Null, "an idle garment is played by nobody");
    let mut rng = Rng::with_seed(7);
    let mut pressed = 0;
    for _ in 0..60 {
        let fingers = rng.u8(1..=5);
        pressed += u64::from(fingers);
        for _ in 0..rng.usize(2..12) {
            for finger in 0..fingers {
                let tool = tools[usize::from(finger + fingers) % tools.len()];
                let at = [rng.f64() * 16.0, rng.f64() * 32.0];
                page.press(finger, tool, finger % 4, at, rng.f64() * 12.0);
            }
            page.read(rng.u64(1..18));
        }
        (0..fingers).for_each(|finger| page.ask(&json!({"release": finger})));
        page.read(rng.u64(20..80));
    }
    page.read(700);
    assert_eq!((page.contacts(), page.hand["touches"].as_u64()), (&[][..], Some(pressed)));
    assert!(compare(&view, &folder("hand")) > 300);
    // A page that goes takes its fingers with it.
    page.press(0, "palm", 0, [8.0, 8.0], 20.0);
    page.read(400);
    assert_eq!(page.contacts().len(), 1);
    drop(page);
    let mut page = view.page();
    page.read(1_000);
    // A busy machine may take longer.
    for _ in 0..20 {
        if !page.contacts().is_empty() {
            page.read(500);
        }
    }
    assert!(page.contacts().is_empty(), "{}", page.image);
}

#[test]
fn a_script_plays_when_a_page_asks_and_nonsense_does_nothing() {
    let view = View::of("sim:idle");
    let mut page = view.page();
    page.read(500);
    page.ask(&json!({"script": "../../etc/passwd"}));
    page.press(0, "hammer", 0, [8.0, 8.0], 20.0);
    page.press(0, "palm", 9, [8.0, 8.0], 20.0);
    page.press(0, "palm", 0, [8.0, 8.0], 2_000.0);
    (0..2000).for_each(|_| page.ask(&json!({"script": "five"})));
    page.read(900);
    assert_eq!((&page.hand["playing"], &page.hand["touches"]), (&json!("five"), &json!(0)));
    assert_eq!(page.contacts().len(), 5, "{}", page.image);
}

#[test]
fn a_real_board_is_not_pressed() {
    let view = View::of(&format!("serial:{}", board()));
    let mut page = view.page();
    // Until it is tared, its weight is a touch.
    page.read(1_000);
    for _ in 0..50 {
        page.press(0, "palm", 3, [8.0, 8.0], 100.0);
        page.ask(&json!({"script": "five"}));
        page.ask(&json!({"hand": "again"}));
        page.read(40);
        assert_eq!(page.hand, Value::Null);
        let own = page.contacts().iter().all(|contact| contact["panel"] == 0);
        assert!(own, "its own script presses the chest: {}", page.image);
    }
    assert_eq!(view.file("touches.toml").0, "404");
}
