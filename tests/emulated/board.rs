//! The firmware image on the emulated board, as a host sees it: messages on a TCP socket, and the harness's
//! own lines. A part of the targets that run it; `tests/emulator/README.md` says what the harness does.

#![allow(dead_code)] // each target that runs the emulator uses a part of it

use serde_json::Value;
use std::collections::VecDeque;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::mpsc;
use std::time::Duration;
use taxel::sim::wiring_json;
use taxel_core::format::Micros;
use taxel_core::garment::{Circuit, Garment, Layout, Pins};
use taxel_core::selftest::PinFault;
use taxel_core::wire::{LONGEST_REQUEST, Receiver, Report, Request, decode, encode, frame_bound};

/// The longest frame that the board sends, and more.
const LONGEST: usize = 8192;
/// A harness that says nothing for so long hangs.
const PATIENCE: Duration = Duration::from_secs(60);

/// A running harness and the link to its board.
pub struct Emulated {
    child: Child,
    input: ChildStdin,
    lines: mpsc::Receiver<Value>,
    /// What the harness said and nobody has waited for yet.
    pub said: VecDeque<Value>,
    link: TcpStream,
    receiver: Box<Receiver<LONGEST>>,
    messages: VecDeque<(usize, Vec<u8>)>,
    wire_bytes: usize,
    seq: Option<u32>,
    /// Messages may be damaged or missing: a cable was pulled.
    pub forgiving: bool,
    /// Wiring and codes, which the harness reads again after each reset.
    files: [PathBuf; 2],
}

impl Emulated {
    /// Runs the image that TAXEL_FIRMWARE_ELF names with `garment` on its pins. The taxels show `rest` until
    /// `play`, then the frames of `codes`. `options` are further ones of the harness.
    pub fn start(garment: &Garment, codes: &[u16], rest: u16, options: &[&str]) -> Emulated {
        let rest = rest.to_string();
        Emulated::run(garment, codes, &[&["--hold", "--idle", &rest], options].concat())
    }

    /// The same, but the taxels show the frames of `codes` from the first scan on.
    pub fn run(garment: &Garment, codes: &[u16], options: &[&str]) -> Emulated {
        let image = std::env::var_os("TAXEL_FIRMWARE_ELF")
            .expect("TAXEL_FIRMWARE_ELF names no image: run this by `cargo xtask test --only emulator`");
        let layout = Layout::build(garment, 2048, 4095).unwrap();
        let circuit = Circuit::build(garment, &layout, Pins::ANY).unwrap();
        let wiring = wiring_json(garment, &layout, &circuit).unwrap().to_string();
        let codes: Vec<u8> = codes.iter().flat_map(|code| code.to_le_bytes()).collect();
        let files = [file("json", wiring.as_bytes()), file("bin", &codes)];
        let mut child = Command::new("node")
            .arg(Path::new(env!("CARGO_MANIFEST_DIR")).join("emulator/emulator.mjs"))
            .arg("--image")
            .arg(image)
            .args(["--port", "0"])
            .args(options)
            .arg("--wiring")
            .arg(&files[0])
            .arg("--codes")
            .arg(&files[1])
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .expect("node cannot be started");
        let input = child.stdin.take().unwrap();
        let lines = lines_of(child.stdout.take().unwrap());
        let mut said = VecDeque::new();
        let port = wait_for(&lines, &mut said, "port")["port"].as_u64().unwrap() as u16;
        let link = TcpStream::connect(("127.0.0.1", port)).unwrap();
        link.set_nodelay(true).unwrap();
        link.set_read_timeout(Some(PATIENCE)).unwrap();
        let (receiver, messages) = (Box::new(Receiver::new()), VecDeque::new());
        Emulated {
            child,
            input,
            lines,
            said,
            link,
            receiver,
            messages,
            wire_bytes: 0,
            seq: None,
            forgiving: false,
            files,
        }
    }

    /// Lets the frames begin; when the first scan that shows them began.
    pub fn play(&mut self) -> Micros {
        writeln!(self.input, "play").unwrap();
        Micros(self.wait_for("play")["play"]["us"].as_f64().unwrap() as u64)
    }

    /// What the harness answers to a command: `stats`, what it has counted so far, or `stack`, how deep the
    /// stack was since it was last asked.
    pub fn look(&mut self, at: &str) -> Value {
        writeln!(self.input, "{at}").unwrap();
        self.wait_for(at)[at].take()
    }

    /// Breaks lines and inputs; those that were broken before are whole again.
    pub fn fault(&mut self, faults: &[PinFault]) {
        writeln!(self.input, "faults {}", serde_json::to_string(faults).unwrap()).unwrap();
        self.wait_for("faults");
    }

    /// Loses the converter's next samples, as if DMA had not fetched them in time.
    pub fn starve(&mut self, samples: u32) {
        writeln!(self.input, "starve {samples}").unwrap();
        self.wait_for("starve");
    }

    /// The converter stands still from now on, or goes on; when that was, us.
    pub fn stall(&mut self, stands_still: bool) -> f64 {
        writeln!(self.input, "stall {}", if stands_still { "on" } else { "off" }).unwrap();
        self.wait_for("stall")["stall"].as_f64().unwrap()
    }

    /// A DMA channel transfers nothing any more.
    pub fn jam(&mut self, channel: u32) {
        writeln!(self.input, "jam {channel}").unwrap();
        self.wait_for("jam");
    }

    /// The supply of the processor's core sags for a moment: whether that resets the chip.
    pub fn sag(&mut self, millivolts: u32) -> bool {
        writeln!(self.input, "sag {millivolts}").unwrap();
        self.wait_for("sag")["sag"]["browns"].as_bool().unwrap()
    }

    /// The program that has the USB port open reads from now on, or does not.
    pub fn read_on(&mut self, reads: bool) {
        writeln!(self.input, "read {}", if reads { "on" } else { "off" }).unwrap();
        self.wait_for("read");
    }

    /// Waits until the harness says something of this kind.
    pub fn wait_for(&mut self, kind: &str) -> Value {
        wait_for(&self.lines, &mut self.said, kind)
    }

    /// Sends a request.
    pub fn ask(&mut self, request: &Request<'_>) {
        let mut wire = vec![0; frame_bound(LONGEST_REQUEST)];
        let frame = encode(request, &mut wire).unwrap();
        self.link.write_all(frame).unwrap();
    }

    /// Sends a request and waits until it has been obeyed; what comes meanwhile is dropped.
    pub fn obey(&mut self, request: &Request<'_>) {
        self.ask(request);
        loop {
            if let Report::Answer(answer) = self.receive().report() {
                assert_eq!((answer.request, answer.refusal), (request.number(), None));
                return;
            }
        }
    }

    /// The next message. A gap between two of them fails the test.
    pub fn receive(&mut self) -> Message {
        while self.messages.is_empty() {
            let mut bytes = [0; 4096];
            let count = self.link.read(&mut bytes).expect("the board says nothing more");
            assert!(count > 0, "the harness has ended");
            for byte in &bytes[..count] {
                self.wire_bytes += 1;
                let Some(body) = self.receiver.push(*byte) else { continue };
                let wire_bytes = std::mem::take(&mut self.wire_bytes);
                match body {
                    Ok(body) => self.messages.push_back((wire_bytes, body.to_vec())),
                    Err(_) if self.forgiving => {}
                    Err(error) => panic!("a damaged frame: {error}"),
                }
            }
        }
        let (wire_bytes, body) = self.messages.pop_front().unwrap();
        let message = Message { wire_bytes, body };
        let seq = message.seq();
        let follows = self.forgiving || self.seq.is_none_or(|last| seq == last.wrapping_add(1));
        assert!(follows, "{:?} then {seq}", self.seq);
        self.seq = Some(seq);
        message
    }

    /// Waits until the harness's power cut has ended the run.
    pub fn end_of_power(mut self) {
        self.wait_for("cut");
        self.link.shutdown(std::net::Shutdown::Both).unwrap();
        assert!(self.child.wait().unwrap().success());
    }

    /// Ends the run. The harness fails on warnings of the emulator, faults, panics and resets of the board.
    pub fn end(mut self) {
        writeln!(self.input, "quit").unwrap();
        self.link.shutdown(std::net::Shutdown::Both).unwrap();
        assert!(self.child.wait().unwrap().success());
    }
}

impl Drop for Emulated {
    fn drop(&mut self) {
        // Has no effect on a harness that has ended.
        let _ = self.child.kill();
        let _ = self.child.wait();
        self.files.iter().for_each(|file| drop(std::fs::remove_file(file)));
    }
}

/// One message of the board.
pub struct Message {
    /// Bytes of its frame on the wire.
    pub wire_bytes: usize,
    body: Vec<u8>,
}

impl Message {
    /// What it says.
    pub fn report(&self) -> Report<'_> {
        self.read().1
    }

    fn seq(&self) -> u32 {
        self.read().0
    }

    fn read(&self) -> (u32, Report<'_>) {
        decode(&self.body).expect("a message that this program does not know")
    }
}

/// A file for the harness, of which there may be several at a time, also by other programs: checks run side
/// by side.
fn file(kind: &str, content: &[u8]) -> PathBuf {
    static FILES: AtomicU32 = AtomicU32::new(0);
    let (program, number) = (std::process::id(), FILES.fetch_add(1, Ordering::Relaxed));
    let name = format!("{}-{program}-{number}.{kind}", env!("CARGO_CRATE_NAME"));
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::write(&path, content).unwrap();
    path
}

/// What the harness prints, line by line.
fn lines_of(output: impl Read + Send + 'static) -> mpsc::Receiver<Value> {
    let (send, lines) = mpsc::channel();
    std::thread::spawn(move || {
        for line in BufReader::new(output).lines().map_while(Result::ok) {
            let Ok(value) = serde_json::from_str(&line) else { continue };
            if send.send(value).is_err() {
                break;
            }
        }
    });
    lines
}

/// The first line of a kind; the others are kept.
fn wait_for(lines: &mpsc::Receiver<Value>, said: &mut VecDeque<Value>, kind: &str) -> Value {
    if let Some(at) = said.iter().position(|line| line.get(kind).is_some()) {
        return said.remove(at).unwrap();
    }
    loop {
        let line = lines.recv_timeout(PATIENCE).expect("the harness has ended, or says nothing more");
        if line.get(kind).is_some() {
            return line;
        }
        said.push_back(line);
    }
}
