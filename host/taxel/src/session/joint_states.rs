//! Positions of joints as lines: of a file, or of the standard input.

use super::joint_time::JointTime;
use super::observer::Observer;
use super::posing::Posing;
use crate::client::{Client, Event, Stamp};
use crate::error::{Context, Result, UsageError};
use crate::files::input;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::fs::File;
use std::io::{BufRead, BufReader, Read, stdin};
use std::path::Path;
use std::sync::mpsc::{Receiver, TryRecvError, sync_channel};
use std::thread;
use taxel_core::format::Micros;

/// Longest line, bytes.
const LONGEST: u64 = 1 << 20;
/// Lines of the standard input that may wait.
const WAITING: usize = 1024;

/// Positions of joints, one JSON object a line:
///
/// `{"time_us": 5128, "positions": {"left_elbow": 0.5}}`
///
/// Positions are in rad or m; `time_us` is the board's time, `host_time_us` the host's, us since 1970.
/// Without either they are of the time at which the line is read. The lines of a recording's topic
/// `/taxel/joints` are of this form. Empty lines do not count.
pub struct JointStates {
    /// Path of the file, or `standard input`.
    name: String,
    lines: Lines,
    /// Number of the line read last, from 1.
    number: usize,
    /// A line whose time has not come.
    next: Option<StateLine>,
    /// Time of the last line taken, us of the board.
    until_us: u64,
}

/// Source of lines.
enum Lines {
    File(BufReader<File>),
    /// A thread waits for them.
    Input(Receiver<Result<Vec<u8>>>),
    Ended,
}

/// A line.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct StateLine {
    #[serde(rename = "type")]
    kind: Option<String>,
    time_us: Option<u64>,
    host_time_us: Option<u64>,
    #[serde(rename = "host_time_uncertainty_us")]
    _uncertainty: Option<u64>,
    positions: BTreeMap<String, f64>,
}

impl StateLine {
    fn time(&self) -> JointTime {
        match (self.time_us, self.host_time_us) {
            (Some(us), _) => JointTime::Board(Micros(us)),
            (None, Some(us)) => JointTime::Host(us),
            (None, None) => JointTime::Now,
        }
    }
}

impl JointStates {
    /// Opens a file, or the standard input if its name is `-`.
    pub fn open(path: &Path) -> Result<JointStates> {
        let (name, lines) = if path == Path::new("-") {
            ("standard input".to_string(), Lines::Input(input()?))
        } else {
            let file = input::open(path).with_context(|| format!("cannot read {}", path.display()))?;
            (path.display().to_string(), Lines::File(BufReader::new(file)))
        };
        Ok(JointStates { name, lines, number: 0, next: None, until_us: 0 })
    }

    /// Hands over the positions whose time has come, and the first ones after it: between two readings a
    /// posture is known better than after the last one. Errors name file and line.
    pub fn hand_over(&mut self, client: &Client, posing: &mut Posing) -> Result<()> {
        let Some(now) = posing.now() else { return Ok(()) };
        while self.until_us <= now.0 {
            if self.next.is_none() {
                self.next = self.read()?;
            }
            let Some(line) = self.next.take() else { break };
            let positions = line.positions.iter().map(|(joint, at)| (joint.as_str(), *at));
            posing.take(client, line.time(), positions).with_context(|| self.place())?;
            self.until_us = line.time_us.unwrap_or(0);
        }
        Ok(())
    }

    fn place(&self) -> String {
        format!("{}, line {}", self.name, self.number)
    }

    /// The next line; none if there is none yet, or no more.
    fn read(&mut self) -> Result<Option<StateLine>> {
        loop {
            let bytes = match &mut self.lines {
                Lines::File(file) => line(file),
                Lines::Input(lines) => match lines.try_recv() {
                    Ok(line) => line.map(Some),
                    Err(TryRecvError::Empty) => return Ok(None),
                    Err(TryRecvError::Disconnected) => Ok(None),
                },
                Lines::Ended => return Ok(None),
            };
            self.number += 1;
            let Some(bytes) = bytes.with_context(|| self.place())? else {
                self.lines = Lines::Ended;
                return Ok(None);
            };
            if bytes.trim_ascii().is_empty() {
                continue;
            }
            let wrong = |what: String| UsageError::Argument(format!("{}: {what}", self.place()));
            let line: StateLine = serde_json::from_slice(&bytes).map_err(|error| {
                wrong(format!(
                    "no positions of joints: {error}: {{\"positions\": {{\"JOINT\": 0.5}}}} is a line"
                ))
            })?;
            if let Some(kind) = line.kind.as_deref().filter(|kind| *kind != "joints") {
                return Err(wrong(format!("a message of type \"{kind}\": must be \"joints\"")).into());
            }
            return Ok(Some(line));
        }
    }
}

impl Observer for JointStates {
    fn event(&mut self, _: &Client, _: &Event, _: Stamp) -> Result<()> {
        Ok(())
    }

    fn pose(&mut self, client: &Client, posing: &mut Posing) -> Result<()> {
        self.hand_over(client, posing)
    }

    fn follows_another(&self) -> bool {
        true
    }
}

/// A line without its end; none at the end of the stream.
fn line(from: &mut impl BufRead) -> Result<Option<Vec<u8>>> {
    let mut bytes = Vec::new();
    let read = from.take(LONGEST).read_until(b'\n', &mut bytes)?;
    require!((read as u64) < LONGEST, UsageError::Argument, "the line is longer than {LONGEST} bytes");
    Ok((read > 0).then_some(bytes))
}

/// Lines of the standard input.
fn input() -> Result<Receiver<Result<Vec<u8>>>> {
    let (sender, lines) = sync_channel(WAITING);
    // It ends with the input, or with the program.
    thread::Builder::new().name("joints".into()).spawn(move || {
        let mut input = BufReader::new(stdin());
        while let Some(line) = line(&mut input).transpose() {
            let is_last = line.is_err();
            if sender.send(line).is_err() || is_last {
                break;
            }
        }
    })?;
    Ok(lines)
}
