//! Plays a recording: the board's bytes in their original timing, scaled, or as fast as possible.

use super::{Port, Source, SourceOptions};
use crate::error::{Context, RecordingError, Result};
use crate::recording::{BoardRecording, GapMark, LinkRecord, WIRE, WireReader, force_scale};
use crate::text::progress::{Progress, Unit};
use crate::time::Instant;
use std::fmt;
use std::io::{self, IsTerminal};
use std::str::FromStr;
use std::time::Duration;

/// Longest wait of a read.
const PATIENCE: Duration = Duration::from_millis(10);

/// Speed of a replay.
#[derive(Debug, Default, Clone, Copy, PartialEq)]
pub enum Speed {
    /// Speed of a simulation: the recorded one if somebody watches, else as fast as possible.
    #[default]
    AsAsked,
    /// Multiple of the recorded speed.
    Times(f64),
    /// Greatest speed that is possible.
    Max,
}

impl Eq for Speed {}

impl FromStr for Speed {
    type Err = String;

    fn from_str(text: &str) -> Result<Speed, String> {
        match text.parse::<f64>() {
            _ if text == "max" => Ok(Speed::Max),
            Ok(times) if times.is_finite() && times > 0.0 => Ok(Speed::Times(times)),
            _ => Err(format!("\"{text}\": a speed is a number above 0, or max")),
        }
    }
}

impl fmt::Display for Speed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Speed::AsAsked => Ok(()),
            Speed::Times(times) => write!(f, "@{times}"),
            Speed::Max => f.write_str("@max"),
        }
    }
}

/// Opens the recording of a board.
pub fn open(recording: &BoardRecording, speed: Speed, options: &SourceOptions) -> Result<Source> {
    let speed = match speed {
        Speed::AsAsked if options.realtime => Some(1.0),
        Speed::Times(times) => Some(times),
        Speed::AsAsked | Speed::Max => None,
    };
    let overview = recording.overview()?;
    if overview.topics().all(|topic| topic != recording.topic(WIRE)) {
        return Err(RecordingError::NotTaxel { path: recording.path.clone(), topic: WIRE }.into());
    }
    let scale = force_scale(&overview, recording)?;
    let wire = WireReader::open(recording)?;
    let progress = || Progress::of(format!("playing {recording}"), Unit::Bytes, Some(wire.passed()[1]));
    let progress = (!io::stdout().is_terminal()).then(progress);
    let replay =
        Player { wire, speed, began: None, next: Vec::new(), gap: None, due: None, passed: None, progress };
    let label = format!("replay:{recording}");
    Ok(Source { scale, listens: false, ..Source::new(label, replay) })
}

/// A recording being played.
#[derive(Debug)]
struct Player {
    wire: WireReader,
    speed: Option<f64>,
    /// Time at which the first message was played, and its log time, ns.
    began: Option<(Instant, u64)>,
    /// Pending bytes, or a gap's begin or end, and when they are due.
    next: Vec<u8>,
    gap: Option<GapMark>,
    due: Option<Instant>,
    /// A gap's begin or end that was reached.
    passed: Option<GapMark>,
    /// None if the replay is displayed.
    progress: Option<Progress>,
}

impl Player {
    /// Loads the next message. Returns false at the end.
    fn fetch(&mut self) -> Result<bool> {
        if let Some((header, record)) = self.wire.next_record()? {
            let time = header.log_time;
            let (start, first) = *self.began.get_or_insert_with(|| (Instant::now(), time));
            let passed = Duration::from_nanos(time.saturating_sub(first));
            self.due = self.speed.and_then(|speed| {
                start.checked_add(Duration::try_from_secs_f64(passed.as_secs_f64() / speed).ok()?)
            });
            match record {
                LinkRecord::Frame(bytes) => self.next.extend_from_slice(bytes),
                LinkRecord::Gap(mark) => self.gap = Some(mark),
            }
            if let Some(progress) = &mut self.progress {
                progress.at(self.wire.passed()[0]);
            }
            return Ok(true);
        }
        Ok(false)
    }
}

impl Port for Player {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<Option<usize>> {
        let mut count = 0;
        loop {
            if self.next.is_empty()
                && self.gap.is_none()
                && !self.fetch().context("the recording ends").map_err(io::Error::other)?
            {
                return Ok((count > 0).then_some(count));
            }
            let wait = self.due.map_or(Duration::ZERO, |due| due.saturating_duration_since(Instant::now()));
            if !wait.is_zero() {
                if count == 0 {
                    crate::time::sleep(wait.min(PATIENCE));
                }
                return Ok(Some(count));
            }
            if self.gap.is_some() {
                if count == 0 {
                    self.passed = self.gap.take();
                }
                return Ok(Some(count));
            }
            let taken = self.next.len().min(buffer.len() - count);
            buffer[count..count + taken].copy_from_slice(&self.next[..taken]);
            self.next.drain(..taken);
            count += taken;
            if count == buffer.len() {
                return Ok(Some(count));
            }
        }
    }

    fn gap(&mut self) -> Option<GapMark> {
        self.passed.take()
    }

    fn remark(&self) -> Option<String> {
        let skipped = self.wire.skipped();
        (!skipped.is_none()).then(|| skipped.to_string())
    }

    /// Discards the bytes: a recording has no board.
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        Ok(bytes.len())
    }
}
