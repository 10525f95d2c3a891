//! Requests to boards while they are followed, as lines of a file or of the standard input.

use anyhow::{Context, Result, bail, ensure};
use std::io::{BufRead, BufReader, Read, stdin};
use std::path::Path;
use std::sync::mpsc::{Receiver, sync_channel};
use std::thread;
use taxel::files::input;
use taxel::mind::{HostInputLine, RobotMeaning, RobotMind};
use taxel::robot::{BoardOrder, RobotStream};
use taxel::source::SceneFile;
use taxel::text::words;

/// Frames of a tare for which no number is given: those of `taxel view`.
const TARE: u16 = 32;
/// Lines that wait.
const WAITING: usize = 64;
/// Longest line, bytes.
const LONGEST: u64 = 4096;

/// The lines.
pub struct RequestLines {
    name: String,
    lines: Receiver<std::io::Result<String>>,
    /// Lines read so far.
    count: usize,
}

impl RequestLines {
    /// Reads a file, or `-`, the standard input, if one is named.
    pub fn of(path: Option<&Path>) -> Result<Option<RequestLines>> {
        path.map(RequestLines::open).transpose()
    }

    fn open(path: &Path) -> Result<RequestLines> {
        let (name, input): (_, Box<dyn Read + Send>) = match path.as_os_str() == "-" {
            true => ("standard input".into(), Box::new(stdin())),
            false => {
                let name = path.display().to_string();
                let file = input::open(path).with_context(|| format!("{name} cannot be read"))?;
                (name, Box::new(file))
            }
        };
        let (sender, lines) = sync_channel(WAITING);
        // It ends with the input, or with the program.
        thread::Builder::new().name("requests".into()).spawn(move || {
            let mut input = BufReader::new(input);
            loop {
                let mut line = String::new();
                let read = input.by_ref().take(LONGEST).read_line(&mut line);
                if matches!(read, Ok(0)) {
                    break;
                }
                let is_last = read.is_err();
                if sender.send(read.map(|_| line)).is_err() || is_last {
                    break;
                }
            }
        })?;
        Ok(RequestLines { name, lines, count: 0 })
    }

    /// Asks what the lines say that have come since, and gives the mind of the robot their host input. What
    /// cannot be asked is reported, and the rest goes on. Returns what the mind was given.
    pub fn ask<T: Send + 'static>(
        &mut self,
        session: &RobotStream<T>,
        mut mind: Option<&mut RobotMind>,
    ) -> Vec<HostInput> {
        let mut all = Vec::new();
        while let Ok(line) = self.lines.try_recv() {
            self.count += 1;
            let asked = line.map_err(anyhow::Error::from).and_then(|line| match host_input(line.trim())? {
                Some(input) => give(input, session, mind.as_deref_mut()).map(Some),
                None => ask(line.trim(), session).map(|()| None),
            });
            match asked {
                Ok(input) => all.extend(input),
                Err(error) => {
                    eprintln!("{}, line {}: {}", self.name, self.count, words::sentence(error.as_ref()));
                }
            }
        }
        all
    }
}

/// Input that a mind was given.
pub struct HostInput {
    /// Host time at which it was sent, us.
    pub host_us: u64,
    /// Line of the input.
    pub line: HostInputLine,
    /// Meaning of touches then, if that is news.
    pub news: Option<RobotMeaning>,
}

/// The host input of a line: `host_input NAME VALUE [AGE_MS]`, or the same as JSON; none if it asks something.
fn host_input(line: &str) -> Result<Option<HostInputLine>> {
    if line.starts_with('{') {
        return Ok(Some(HostInputLine::parse(line)?));
    }
    let parts: Vec<&str> = line.split_whitespace().collect();
    let [name, value, age @ ..] = parts.strip_prefix(&["host_input"]).unwrap_or_default() else {
        return Ok(None);
    };
    let value = value.parse().with_context(|| format!("host_input {name}: \"{value}\""))?;
    let age_ms = match age {
        [] => 0,
        [age] => age.parse().with_context(|| format!("host_input {name}: age \"{age}\""))?,
        _ => bail!("\"{line}\": must be host_input NAME VALUE [AGE_MS]"),
    };
    Ok(Some(HostInputLine {
        host_input: [(name.to_string(), value)].into(),
        age_ms,
        ..HostInputLine::default()
    }))
}

/// Gives the mind its input, and the boards the robot's posture.
fn give<T: Send + 'static>(
    line: HostInputLine,
    session: &RobotStream<T>,
    mind: Option<&mut RobotMind>,
) -> Result<HostInput> {
    let host_us = session.now_us();
    let mind = mind.context("nobody takes host input: the boards are not at one time, see --realtime")?;
    let news = mind.take_input(&line, host_us)?.cloned();
    session.take_joints(line.from_us(host_us), line.joints());
    Ok(HostInput { host_us, line, news })
}

/// Asks what a line says: `tare [BOARD] [N]`, `scene [BOARD] FILE`, `self-test [BOARD]`.
fn ask<T: Send + 'static>(line: &str, session: &RobotStream<T>) -> Result<()> {
    let parts: Vec<&str> = line.split_whitespace().collect();
    let Some((what, rest)) = parts.split_first() else { return Ok(()) };
    let (board, order) = match (*what, rest) {
        ("tare", []) => (None, BoardOrder::Tare(TARE)),
        ("tare", [one]) => match one.parse() {
            Ok(frames) => (None, BoardOrder::Tare(frames)),
            Err(_) => (Some(*one), BoardOrder::Tare(TARE)),
        },
        ("tare", [board, frames]) => {
            let frames = frames.parse().with_context(|| format!("board {board}: tare over \"{frames}\""))?;
            (Some(*board), BoardOrder::Tare(frames))
        }
        ("scene", [file]) => (None, BoardOrder::Scene(Box::new(SceneFile::read(Path::new(file))?))),
        ("scene", [board, file]) => {
            let scene = SceneFile::read(Path::new(file)).with_context(|| format!("board {board}"))?;
            (Some(*board), BoardOrder::Scene(Box::new(scene)))
        }
        ("self-test", []) => (None, BoardOrder::SelfTest),
        ("self-test", [board]) => (Some(*board), BoardOrder::SelfTest),
        _ => bail!(
            "\"{line}\": must be tare [BOARD] [N], scene [BOARD] FILE, self-test [BOARD] or host_input NAME VALUE [AGE_MS]"
        ),
    };
    if let BoardOrder::Tare(frames) = &order {
        ensure!((1..=4096).contains(frames), "a tare takes 1 to 4096 frames, not {frames}");
    }
    session.order(board, &order)?;
    Ok(())
}
