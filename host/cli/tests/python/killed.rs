//! `kill -9` during a recording: the file has everything but the last second.
//!
//! A board on TCP replays the messages of a simulated one at their times, and notes when each was sent.

use super::read;
use super::stage::{file, play};
use std::io::Write;
use std::net::{TcpListener, TcpStream};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};
use taxel::client::{Client, Event, Stamp};
use taxel::recording::{Messages, WIRE};
use taxel::session::Observer;

/// Messages of a board with their times, us.
#[derive(Default)]
struct Said {
    messages: Vec<(u64, Vec<u8>)>,
    time: u64,
}

impl Observer for Said {
    fn event(&mut self, client: &Client, event: &Event, _: Stamp) -> taxel::Result<()> {
        if let Event::Frame { time, .. } = event {
            self.time = time.0;
        }
        self.messages.push((self.time, client.line().to_vec()));
        Ok(())
    }
}

fn program() -> Command {
    Command::new(crate::start::taxel())
}

/// Sends messages at their times until `end`. Returns how many were sent up to a second before it.
fn send(mut link: TcpStream, said: &Said, start: Instant, end: Instant) -> usize {
    let mut safe = 0;
    for (time, message) in &said.messages {
        let due = (start + Duration::from_micros(*time)).min(end);
        std::thread::sleep(due.saturating_duration_since(Instant::now()));
        if Instant::now() >= end || link.write_all(message).is_err() {
            return safe;
        }
        safe += usize::from(Instant::now() + Duration::from_secs(1) <= end);
    }
    panic!("the board had no more to say before the kill");
}

/// A recording killed `after` its begin, and the number of messages that it must have.
fn kill(said: &Said, path: &Path, after: Duration) -> usize {
    let board = TcpListener::bind("127.0.0.1:0").unwrap();
    let source = format!("tcp:{}", board.local_addr().unwrap());
    let mut command = program();
    command.args(["record", "--force", "--source", &source, "-o"]).arg(path);
    let mut recording: Child = command.stderr(Stdio::null()).spawn().unwrap();
    let (link, _) = board.accept().unwrap();
    let start = Instant::now();
    let safe = send(link, said, start, start + after);
    recording.kill().unwrap();
    recording.wait().unwrap();
    safe
}

fn wire(path: &Path) -> Vec<Vec<u8>> {
    let mut messages = Messages::of_topic(path, WIRE).unwrap();
    let mut all = Vec::new();
    while let Some(message) = messages.next_message().unwrap() {
        all.push(message.data.to_vec());
    }
    all
}

#[test]
fn a_kill_costs_a_second_at_most() {
    let mut said = Said::default();
    play("sim:five", &mut said);
    let kills = if std::env::var_os("TAXEL_CAMPAIGN").is_some() { 50 } else { 3 };
    let (mut random, mut spared, mut torn) = (fastrand::Rng::with_seed(9), usize::MAX, 0);
    for number in 0..kills {
        let path: PathBuf = file("killed.mcap");
        let safe = kill(&said, &path, Duration::from_millis(random.u64(1200..2400)));
        torn += usize::from(!taxel::recording::scan(&path).unwrap().whole);
        let repaired =
            program().arg("info").arg(&path).args(["--repair", "--in-place", "--json"]).output().unwrap();
        assert!(repaired.status.success(), "kill {number}: {}", String::from_utf8_lossy(&repaired.stderr));
        let kept = wire(&path);
        assert!(kept.iter().zip(&said.messages).all(|(kept, (_, sent))| kept == sent), "kill {number}");
        assert!(kept.len() >= safe, "kill {number}: {} of {safe} messages", kept.len());
        let found = read("mcap", &path);
        assert_eq!(found["counts"][WIRE].as_u64().unwrap_or(0), kept.len() as u64, "kill {number}");
        spared = spared.min(kept.len() - safe);
    }
    println!(
        "{kills} kills: {torn} files without their end, all repaired; at least {spared} messages of the last second kept"
    );
}
