//! Ports that tests plug in.

use crate::start::taxel;
use serialport::{SerialPort, TTYPort};
use std::fs::File;
use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};
use taxel::source::{self, SourceOptions};

/// Longest time that a command may take before it is ended: it goes on, where it should not.
const LONGEST: Duration = Duration::from_secs(60);

/// Time after which bytes that nobody reads are dropped.
const UNREAD: Duration = Duration::from_millis(300);

/// A folder of this test's own, new.
pub fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("plugged").join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

/// The lists of ports in which the boards with these serial numbers open as this says.
pub fn boards(boards: &[(&str, &str)]) -> String {
    let port = |(at, (serial, opens)): (usize, &(&str, &str))| {
        format!(
            "[[port]]\nname = \"/dev/ttyTAXEL{at}\"\nusb = [0x1209, 0x0001]\nproduct = \"taxel\"\nserial = \"{serial}\"\n\
             opens = \"{opens}\"\n"
        )
    };
    boards.iter().enumerate().map(port).collect()
}

/// The program, with the ports of this list.
pub fn command(folder: &Path, ports: &str, words: &[&str]) -> Command {
    let table = folder.join("ports.toml");
    std::fs::write(&table, ports).unwrap();
    let mut command = Command::new(taxel());
    command.args(words).current_dir(folder).env("TAXEL_PORTS", table).stdin(Stdio::null());
    command
}

/// What a command has said, and with which status after which time it has ended.
pub struct Ended {
    pub status: Option<i32>,
    pub output: String,
    pub error: String,
    pub seconds: f64,
}

/// Runs a command to its end.
pub fn ended(mut command: Command) -> Ended {
    let began = Instant::now();
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let read = |mut from: Box<dyn Read + Send>| {
        thread::spawn(move || {
            let mut text = String::new();
            from.read_to_string(&mut text).unwrap();
            text
        })
    };
    let output = read(Box::new(child.stdout.take().unwrap()));
    let error = read(Box::new(child.stderr.take().unwrap()));
    let status = wait(&mut child);
    let seconds = began.elapsed().as_secs_f64();
    Ended { status, output: output.join().unwrap(), error: error.join().unwrap(), seconds }
}

/// Exit status of a program; none if it goes on and is ended.
pub fn wait(child: &mut Child) -> Option<i32> {
    let began = Instant::now();
    loop {
        if let Some(status) = child.try_wait().unwrap() {
            return status.code();
        }
        if began.elapsed() > LONGEST {
            child.kill().unwrap();
            child.wait().unwrap();
            return None;
        }
        thread::sleep(Duration::from_millis(5));
    }
}

/// A terminal: what is written to it, and its name.
pub fn terminal() -> (TTYPort, String) {
    let (mut master, slave) = TTYPort::pair().unwrap();
    master.set_timeout(Duration::from_millis(1)).unwrap();
    let name = slave.name().unwrap();
    (master, name)
}

/// The end of a terminal for a program's output.
pub fn opened(name: &str) -> File {
    File::options().read(true).write(true).open(name).unwrap()
}

/// Plugs in a simulated board that plays at real time as a real one does; returns its port.
pub fn board() -> String {
    let (mut master, name) = terminal();
    thread::spawn(move || {
        let options = SourceOptions { realtime: true, repeat: true, ..SourceOptions::default() };
        let mut board = source::open(&"sim:press".parse().unwrap(), &options).unwrap();
        let mut buffer = [0; 1024];
        loop {
            // An error: nobody has it open now.
            if let Ok(count) = master.read(&mut buffer) {
                board.port.write(&buffer[..count]).unwrap();
            }
            let Ok(Some(count)) = board.port.read(&mut buffer) else { return };
            pass(&mut master, &buffer[..count]);
        }
    });
    name
}

/// Passes bytes to whoever has the terminal open; drops them if nobody reads for long.
fn pass(master: &mut TTYPort, mut bytes: &[u8]) {
    let began = Instant::now();
    while !bytes.is_empty() && began.elapsed() < UNREAD {
        match master.write(bytes) {
            Ok(count) => bytes = &bytes[count..],
            Err(_) => thread::sleep(Duration::from_millis(1)),
        }
    }
}

/// Plugs in something that says these bytes again and again; returns its port.
pub fn stranger(bytes: Vec<u8>) -> String {
    let (mut master, name) = terminal();
    thread::spawn(move || {
        loop {
            let _ = master.write_all(&bytes);
            thread::sleep(Duration::from_millis(1));
        }
    });
    name
}
