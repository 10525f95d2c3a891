//! Records a board's stream, second by second, file after file.

use super::bag::Ros2;
use super::counters::Counters;
use super::file::RecordingFile;
use super::limit::Rotate;
use super::names::{self, beside, numbered};
use super::provenance::Origin;
use super::stamps::{Stamp, Stamps};
use super::standing::Standing;
use super::tally::{COUNTS, Tally};
use crate::body::ReadBody;
use crate::client::passed::Passed;
use crate::client::{Client, Event, Worn};
use crate::error::{Context, Error, Result};
use crate::files::output::{Begun, Force, Output};
use crate::recording;
use crate::session::{JointPositions, Show};
use crate::tell::progress::{self, Unit};
use std::fs::File;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Time between two chunks: the loss by a kill, plus as much again for the disk to write it.
const CHUNK: Duration = Duration::from_millis(500);
/// Most board time between two chunks for sources faster than real time, us, so that readers can seek to any
/// second. A chunk of more than half of it ends before a key frame, so that the next one stands alone.
const CHUNK_US: u64 = 1_000_000;

/// Topic whose messages count as frames.
const FRAMES: &str = "/taxel/frames";

/// What to record, and where.
#[derive(Debug, Clone)]
pub struct Plan {
    /// The first file.
    pub path: PathBuf,
    /// When to continue in another file.
    pub rotate: Option<Rotate>,
    /// Also write ROS 2 messages.
    pub ros2: bool,
    /// Where the panels lie on the robot, for the ROS 2 messages.
    pub body: Option<ReadBody>,
    /// Replace existing files.
    pub force: bool,
    /// Input files, which are never replaced.
    pub inputs: Vec<PathBuf>,
    /// Origin of the stream.
    pub origin: Origin,
}

/// A recording in progress.
#[derive(Debug)]
pub struct Recorder {
    plan: Plan,
    file: Option<RecordingFile<File>>,
    /// Names of the file and of the one beside it; those that replace others wait for frames.
    begun: Vec<Begun>,
    path: PathBuf,
    number: u32,
    stamps: Stamps,
    standing: Standing,
    worn: Option<Worn>,
    /// Board time since the file began.
    passed: Passed,
    /// What `passed` was at the last key frame, us.
    key_us: u64,
    /// Board time at the start of the chunk, us.
    chunk_us: u64,
    kept: Instant,
    counters: Counters,
    shown: progress::Progress,
    /// Counters so far, and when the file began.
    tally: [Tally; 2],
}

impl Recorder {
    /// Creates the first file.
    pub fn create(plan: Plan) -> Result<Recorder> {
        if plan.rotate.is_some() && !plan.force {
            names::are_free(&plan.path)?;
        }
        let (file, begun) = begin(&plan, &plan.path)?;
        Ok(Recorder {
            file: Some(file),
            begun,
            path: plan.path.clone(),
            number: 1,
            stamps: Stamps::start(),
            standing: Standing::default(),
            worn: None,
            passed: Passed::default(),
            key_us: 0,
            chunk_us: 0,
            kept: Instant::now(),
            counters: Counters::default(),
            shown: progress::Progress::of("recording", Unit::BoardTime, None),
            tally: [Tally::default(); 2],
            plan,
        })
    }

    /// Sets the expected duration in board time.
    pub fn expect(&mut self, seconds: f64) {
        self.shown.expect((seconds * 1e6) as u64);
    }

    /// Progress in words.
    pub fn progress(&self) -> String {
        let bytes = self.file.as_ref().map_or(0, |file| file.bytes());
        self.counters.line(&self.path, bytes)
    }

    /// Writes the end of the file, unless written already.
    pub fn finish(&mut self) -> Result<()> {
        let Some(mut file) = self.file.take() else { return Ok(()) };
        self.shown.clear();
        let [now, before] = self.tally;
        let counted = file.writer.metadata(COUNTS, now.words(before));
        let frames = self.counters.frames();
        let ended = file.finish().map(|bytes| self.counters.ended(bytes));
        self.name(frames)?;
        ended.and(counted).with_context(|| self.incomplete())
    }

    /// Gives the files their names. Error if they have no frames and would replace others.
    fn name(&mut self, frames: u64) -> Result<()> {
        self.begun.iter_mut().try_for_each(|begun| begun.end(frames == 0))
    }

    fn incomplete(&self) -> String {
        format!("{} could not be completed: `taxel info --repair` completes it", self.path.display())
    }

    /// Ends the recording on a write error. Earlier data stays, and the file is completed.
    fn guard(&mut self, done: Result<()>) -> Result<()> {
        let Err(error) = done else { return Ok(()) };
        let mut kept = "what was recorded before is whole".to_string();
        if let Some(file) = self.file.take() {
            // The last messages are lost in any case; the file itself shows whether it is complete.
            let _ = file.finish();
            let path = self.begun.first().map_or(&*self.path, Begun::path);
            let scan = crate::recording::scan(path).ok();
            let bytes = std::fs::metadata(path).map_or(0, |known| known.len());
            let frames = scan.as_ref().map_or(0, |scan| scan.contents.messages(FRAMES));
            let is_whole = scan.is_some_and(|scan| scan.whole);
            self.counters.cut(bytes, if is_whole { frames } else { 0 });
            kept = match self.name(frames) {
                Err(why) => why.to_string(),
                Ok(()) if is_whole => kept,
                Ok(()) => self.incomplete(),
            };
        }
        Err(error).with_context(|| format!("{} cannot be written, {kept}", self.path.display()))
    }

    fn take(&mut self, client: &Client, event: &Event) -> Result<()> {
        let stamp = self.stamps.of(client, event);
        self.standing.take(client, event);
        self.rotate(client, event, stamp)?;
        self.tally[0] = Tally::of(client.counts());
        let passed_us = if self.stamps.is_known() { self.passed.until(stamp.board_us) } else { 0 };
        self.counters.take(client, event, passed_us);
        let Some(file) = &mut self.file else { return Ok(()) };
        if *event == Event::Hello && client.worn() != self.worn.as_ref() {
            self.worn = client.worn().cloned();
            if let Some(worn) = &self.worn {
                file.attach(worn, client.line(), &self.plan.origin, stamp)?;
            }
        }
        let is_key = matches!(event, Event::Frame { alone: true, .. });
        let most = if is_key { CHUNK_US / 2 } else { CHUNK_US };
        if stamp.board_us.abs_diff(self.chunk_us) >= most {
            self.chunk_us = stamp.board_us;
            file.close()?;
        }
        file.put(|messages| messages.frames(client, stamp))?;
        file.event(client, event, stamp, self.plan.origin.counts_per_newton)?;
        if matches!(event, Event::Other { .. }) && self.plan.rotate.is_some() {
            // A file is of one board: the `Hello` of this one follows.
            (self.standing, self.worn) = (Standing::default(), None);
            self.next_file()?;
        }
        Ok(())
    }

    /// Continues in another file when due. It begins with a key frame, so that the file stands alone: with
    /// the one next to the requested time.
    fn rotate(&mut self, client: &Client, event: &Event, stamp: Stamp) -> Result<()> {
        let Event::Frame { alone: true, .. } = event else { return Ok(()) };
        let Some(file) = &self.file else { return Ok(()) };
        let passed = self.passed.until(stamp.board_us);
        let since_key = passed - std::mem::replace(&mut self.key_us, passed);
        let due = match self.plan.rotate {
            None => false,
            Some(Rotate::After(time)) => passed.saturating_add(since_key / 2) >= time.as_micros() as u64,
            Some(Rotate::Bytes(bytes)) => file.bytes() >= bytes,
        };
        if !due {
            return Ok(());
        }
        self.next_file()?;
        let Some(file) = &mut self.file else { return Ok(()) };
        if let Some(worn) = &self.worn {
            file.attach(worn, self.standing.hello(), &self.plan.origin, stamp)?;
        }
        for bytes in self.standing.frames(recording::sequence(client.lines().next().unwrap_or_default())?)? {
            file.put(|messages| messages.wire(stamp, &bytes))?;
        }
        Ok(())
    }

    /// Completes the file, and begins another one.
    fn next_file(&mut self) -> Result<()> {
        self.finish()?;
        self.tally[1] = self.tally[0];
        self.number += 1;
        self.path = numbered(&self.plan.path, self.number);
        (self.passed, self.key_us) = (Passed::default(), 0);
        let (file, begun) = begin(&self.plan, &self.path)?;
        (self.file, self.begun) = (Some(file), begun);
        Ok(())
    }

    fn keep(&mut self) -> Result<()> {
        if self.kept.elapsed() < CHUNK {
            return Ok(());
        }
        if let Some(file) = &mut self.file {
            file.flush()?;
        }
        if self.counters.frames() > 0 {
            self.name(self.counters.frames())?;
        }
        self.kept = Instant::now();
        let line = || self.counters.line(&self.path, self.file.as_ref().map_or(0, |file| file.bytes()));
        self.shown.told(self.counters.board_us(), line);
        Ok(())
    }
}

/// Creates a file, and the one beside it. They get their names once they are readable: a crash leaves what
/// was written, and a failed start leaves no file of that name. Those that replace others get them later.
fn begin(plan: &Plan, path: &Path) -> Result<(RecordingFile<File>, Vec<Begun>)> {
    let output = |path: &Path| Output::file(path, Force { force: plan.force }, &plan.inputs);
    let main = output(path)?;
    let ros2 = plan.ros2.then(|| output(&beside(path))?.begin()).transpose()?;
    let (ros2, ros2_begun) = ros2.unzip();
    let (main, begun) = main.begin()?;
    let ros2 = ros2.map(|file| Ros2::create(file, plan.body.clone())).transpose();
    let file = ros2
        .and_then(|ros2| RecordingFile::create(main, ros2))
        .with_context(|| format!("{} cannot be written", path.display()))?;
    let mut begun: Vec<Begun> = [begun].into_iter().chain(ros2_begun).collect();
    match begun.iter_mut().try_for_each(Begun::open) {
        Ok(()) => Ok((file, begun)),
        Err(error) => {
            // The file that already has its name becomes an empty recording instead of half of one. The first
            // of two errors is reported.
            _ = file.finish();
            Err(error)
        }
    }
}

impl<E: From<Error>> Show<E> for Recorder {
    fn event(&mut self, client: &Client, event: &Event) -> Result<(), E> {
        // Also printed to standard error: a recording may not be looked at for days.
        if let Some(remark) = event.remark() {
            self.shown.clear();
            eprintln!("{remark}");
        }
        let done = self.take(client, event);
        Ok(self.guard(done)?)
    }

    /// In another file.
    fn follows_another(&self) -> bool {
        self.plan.rotate.is_some()
    }

    fn tells_remarks(&self) -> bool {
        true
    }

    fn asked(&mut self, client: &Client, bytes: &[u8]) -> Result<(), E> {
        let Some(file) = self.file.as_mut().filter(|_| !bytes.is_empty()) else { return Ok(()) };
        let stamp = self.stamps.now(client);
        let done = file.put(|messages| messages.requests(client, bytes, stamp));
        Ok(self.guard(done)?)
    }

    fn joints(&mut self, client: &Client, joints: &JointPositions) -> Result<(), E> {
        let Some(file) = &mut self.file else { return Ok(()) };
        let stamp = self.stamps.of_time(client, joints.time.0);
        let done = file.put(|messages| messages.joints(joints, stamp));
        Ok(self.guard(done)?)
    }

    fn idle(&mut self, _: &mut Client) -> Result<bool, E> {
        let done = self.keep();
        self.guard(done)?;
        Ok(true)
    }

    fn end(&mut self, _: &Client) -> Result<(), E> {
        Ok(self.finish()?)
    }
}
