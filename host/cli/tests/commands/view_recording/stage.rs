//! Recordings, the program that shows them, and a page without a browser.

use serde_json::{Value, json};
use std::io::{BufRead, BufReader, Read, Write};
use std::net::{Ipv4Addr, TcpStream};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::Duration;
use taxel::client::{Client, Event, ImageNews};
use taxel::json;
use taxel::record::Play;
use taxel::recording::{Clips, WIRE};
use taxel_cli::view::message;
use tungstenite::client::IntoClientRequest;
use tungstenite::{Message, WebSocket};

pub const PROGRAM: &str = env!("CARGO_BIN_EXE_taxel");

/// Path of a file of this test run.
pub fn file(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("taxel-view-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    folder.join(name)
}

/// Records a scene for this many seconds.
pub fn recorded(name: &str, scene: &str, seconds: u32, more: &[&str]) -> PathBuf {
    let path = file(name);
    let mut record = Command::new(PROGRAM);
    record.args(["record", "--source", scene, "--for", &format!("{seconds}s"), "--force", "-o"]);
    let done = record.arg(&path).args(more).stderr(Stdio::null()).status().unwrap();
    assert!(done.success());
    path
}

/// A frame of a recording, and its image.
#[derive(Debug, Clone)]
pub struct Moment {
    /// Microseconds since the recording began.
    pub at: u64,
    pub line: Value,
    pub image: Vec<u16>,
    /// Latest health of the board.
    pub health: Option<Value>,
}

/// All frames of a recording, played from its beginning.
pub fn moments(path: &Path) -> Vec<Moment> {
    let start = Clips::open(&path.into(), WIRE).unwrap().places()[0].start;
    let (mut play, mut found, mut health) = (Play::open(&path.into()).unwrap(), Vec::new(), None);
    while let Some((header, event)) = play.next_event().unwrap() {
        let client = play.client();
        if matches!(event, Event::Health(_)) {
            health = Some(as_read(client, &event));
        }
        if let (Event::Frame { image: ImageNews::Whole, .. }, Some((_, image))) = (&event, client.image()) {
            let (at, line) = ((header.log_time - start) / 1000, as_read(client, &event));
            found.push(Moment { at, line, image: image.into(), health: health.clone() });
        }
    }
    found
}

/// An event as a page reads it, with numbers converted to text and back.
fn as_read(client: &Client, event: &Event) -> Value {
    let line = match event {
        Event::Frame { .. } => serde_json::to_value(message::frame(client, event)).unwrap(),
        event => json::message(client, event),
    };
    serde_json::from_str(&line.to_string()).unwrap()
}

/// A running `taxel view`.
pub struct View {
    child: Child,
    pub port: u16,
}

impl View {
    /// Starts it with a source or a file.
    pub fn start(arguments: &[&str]) -> View {
        let mut view = Command::new(PROGRAM);
        view.args(["view", "--port", "0"]).args(arguments);
        let mut child = view.stdout(Stdio::piped()).stderr(Stdio::inherit()).spawn().unwrap();
        let mut line = String::new();
        BufReader::new(child.stdout.take().unwrap()).read_line(&mut line).unwrap();
        let port = line.split("127.0.0.1:").nth(1).and_then(|rest| rest.split('/').next()).unwrap();
        View { port: port.parse().unwrap(), child }
    }

    /// Head and body of the response to a request for a path.
    pub fn get(&self, path: &str, headers: &str) -> (String, Vec<u8>) {
        let mut stream = TcpStream::connect((Ipv4Addr::LOCALHOST, self.port)).unwrap();
        let host = format!("Host: 127.0.0.1:{}", self.port);
        write!(stream, "GET {path} HTTP/1.1\r\n{host}\r\n{headers}\r\n").unwrap();
        let mut answer = Vec::new();
        stream.read_to_end(&mut answer).unwrap();
        let end = answer.windows(4).position(|part| part == b"\r\n\r\n").unwrap() + 4;
        (String::from_utf8(answer[..end].into()).unwrap(), answer[end..].into())
    }

    /// Saves a recording from the page, and joins its chunks.
    pub fn save(&self, name: &str) -> PathBuf {
        let (head, mut body) = self.get("/recording.mcap", "");
        assert!(head.starts_with("HTTP/1.1 200") && head.contains("Transfer-Encoding: chunked"), "{head}");
        let (mut whole, mut ended) = (Vec::new(), false);
        while let Some(line) = body.windows(2).position(|part| part == b"\r\n") {
            let size = std::str::from_utf8(&body[..line]).unwrap();
            let size = usize::from_str_radix(size, 16).unwrap();
            whole.extend_from_slice(&body[line + 2..line + 2 + size]);
            body.drain(..line + 4 + size);
            ended |= size == 0;
        }
        assert!(ended, "the file is cut off");
        let path = file(name);
        std::fs::write(&path, whole).unwrap();
        path
    }

    pub fn page(&self) -> Page {
        let stream = TcpStream::connect((Ipv4Addr::LOCALHOST, self.port)).unwrap();
        stream.set_read_timeout(Some(Duration::from_secs(60))).unwrap();
        let request = format!("ws://127.0.0.1:{}/socket", self.port).into_client_request().unwrap();
        Page { socket: tungstenite::client(request, stream).unwrap().0, overview: None }
    }
}

impl Drop for View {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// A message to a page: a line, or an image with its frame.
pub enum PageMessage {
    Line(Value),
    Image(Value, Vec<u16>),
}

/// A page. The newest overview is kept, because it may arrive before it is requested.
pub struct Page {
    socket: WebSocket<TcpStream>,
    overview: Option<Value>,
}

impl Page {
    pub fn say(&mut self, text: &str) {
        self.socket.send(Message::Text(text.to_string().into())).unwrap();
    }

    pub fn ask(&mut self, request: Value) {
        self.say(&request.to_string());
    }

    pub fn next(&mut self) -> PageMessage {
        match self.socket.read().unwrap() {
            Message::Text(text) => {
                let line: Value = serde_json::from_str(&text).unwrap();
                if line["type"] == "overview" {
                    self.overview = Some(line.clone());
                }
                PageMessage::Line(line)
            }
            Message::Binary(bytes) => {
                let length = u32::from_le_bytes(bytes[..4].try_into().unwrap()) as usize;
                let (head, values) = bytes[4..].split_at(length);
                let mut head: Value = serde_json::from_slice(head).unwrap();
                let values: Vec<u16> = values.chunks(2).map(|b| u16::from_le_bytes([b[0], b[1]])).collect();
                PageMessage::Image(head["frame"].take(), values[..values.len() / 2].into())
            }
            other => panic!("{other:?}"),
        }
    }

    /// Reads until a line of this type meets the condition.
    pub fn line(&mut self, kind: &str, wanted: impl Fn(&Value) -> bool) -> Value {
        loop {
            if let PageMessage::Line(line) = self.next()
                && line["type"] == kind
                && wanted(&line)
            {
                return line;
            }
        }
    }

    /// The complete overview.
    pub fn overview(&mut self) -> Value {
        let whole = |line: &&Value| line["known_us"] == line["duration_us"];
        match self.overview.as_ref().filter(whole) {
            Some(line) => line.clone(),
            None => self.line("overview", |line| whole(&line)),
        }
    }

    /// Reads until an image meets the condition.
    pub fn image(&mut self, wanted: impl Fn(&Value) -> bool) -> (Value, Vec<u16>) {
        loop {
            if let PageMessage::Image(line, image) = self.next()
                && wanted(&line)
            {
                return (line, image);
            }
        }
    }

    /// Pauses. Returns the number of jumps so far.
    pub fn stand(&mut self) -> u64 {
        self.ask(json!({ "play": false }));
        // The first page starts the player: only messages after this order count.
        self.ask(json!({ "speed": 1.5 }));
        self.line("player", |line| line["speed"] == 1.5 && line["playing"] == false);
        self.ask(json!({ "speed": 1 }));
        self.line("player", |line| line["speed"] == 1.0)["seeks"].as_u64().unwrap()
    }

    /// Jumps to a time: the image shown there, and the board's health.
    pub fn seek(&mut self, seconds: f64, seeks: &mut u64) -> (Value, Vec<u16>, Option<Value>) {
        self.ask(json!({ "seek": seconds }));
        *seeks += 1;
        let mut health = None;
        loop {
            match self.next() {
                PageMessage::Line(line) if line["type"] == "health" => health = Some(line),
                PageMessage::Line(line) if line["of"] == "health" => health = None,
                // The state that belongs to an image is sent before it.
                PageMessage::Image(line, image) if line["seeks"] == *seeks => return (line, image, health),
                _ => {}
            }
        }
    }
}
