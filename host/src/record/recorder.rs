//! Keeps what a board tells, second by second, file after file.

use super::file::RecordingFile;
use super::limit::Rotate;
use super::names::{self, beside, numbered};
use super::progress::Progress;
use super::provenance::Origin;
use super::stamps::{Stamp, Stamps};
use super::standing::{self, Standing};
use super::tally::{COUNTS, Tally};
use crate::client::{Client, Event, Worn};
use crate::fault::Fault;
use crate::live::Show;
use crate::output::{Begun, Force, Output};
use crate::passed::Passed;
use crate::progress::{self, Unit};
use crate::stop;
use anyhow::{Context, Result};
use std::fs::File;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};
use taxel_core::wire::{self, Request};

/// Time between two chunks: what a kill loses at most, and as much again for the disk to take it.
const CHUNK: Duration = Duration::from_millis(500);
/// The same by the board's time, for those that are faster than time, us: who reads can go to any second.
const CHUNK_US: u64 = 1_000_000;

/// Number in the answer to a request that a board cannot read: its firmware does not know that one.
const UNREADABLE: u8 = 255;

/// The topic that counts for frames.
const FRAMES: &str = "/taxel/frames";

/// What is to be recorded, and where.
#[derive(Debug, Clone)]
pub struct Plan {
    /// The first file.
    pub path: PathBuf,
    /// When to go on in another.
    pub rotate: Option<Rotate>,
    /// Also as ROS 2's messages.
    pub ros2: bool,
    /// Files that exist are replaced.
    pub force: bool,
    /// Files that are read meanwhile: they are never replaced.
    pub inputs: Vec<PathBuf>,
    /// Where it comes from.
    pub origin: Origin,
    /// Raw codes are asked for, too.
    pub raw: bool,
}

/// A recording under way.
#[derive(Debug)]
pub struct Recorder {
    plan: Plan,
    file: Option<RecordingFile<File>>,
    path: PathBuf,
    number: u32,
    stamps: Stamps,
    standing: Standing,
    worn: Option<Worn>,
    /// The board's time since the file began.
    passed: Passed,
    /// The board's time at which the chunk began, us.
    chunk_us: u64,
    kept: Instant,
    progress: Progress,
    shown: progress::Progress,
    /// What was counted so far, and before the file began.
    tally: [Tally; 2],
    /// Raw codes have been asked for, and the board has not answered yet.
    waits_for_raw: bool,
}

impl Recorder {
    /// Begins the first file.
    pub fn create(plan: Plan) -> Result<Recorder> {
        if plan.rotate.is_some() && !plan.force {
            names::are_free(&plan.path)?;
        }
        Ok(Recorder {
            file: Some(begin(&plan, &plan.path)?),
            path: plan.path.clone(),
            number: 1,
            stamps: Stamps::start(),
            standing: Standing::default(),
            worn: None,
            passed: Passed::default(),
            chunk_us: 0,
            kept: Instant::now(),
            progress: Progress::default(),
            shown: progress::Progress::of("recording", Unit::BoardTime, None),
            tally: [Tally::default(); 2],
            waits_for_raw: false,
            plan,
        })
    }

    /// It is going to end after so many seconds of the board.
    pub fn expect(&mut self, seconds: f64) {
        self.shown.expect((seconds * 1e6) as u64);
    }

    /// What has been recorded so far, in words.
    pub fn progress(&self) -> String {
        let bytes = self.file.as_ref().map_or(0, |file| file.bytes());
        self.progress.line(&self.path, bytes)
    }

    /// Writes the end of the file. Does nothing where it has been written.
    pub fn finish(&mut self) -> Result<()> {
        let Some(mut file) = self.file.take() else { return Ok(()) };
        self.shown.clear();
        let [now, before] = self.tally;
        let counted = file.writer.metadata(COUNTS, now.words(before));
        let ended = file.finish().map(|bytes| self.progress.ended(bytes));
        ended.and(counted).with_context(|| self.incomplete())
    }

    fn incomplete(&self) -> String {
        format!("{} could not be completed: `taxel info --repair` completes it", self.path.display())
    }

    /// What could not be written ends the recording; what was written before stays, with an end.
    fn guard(&mut self, done: Result<()>) -> Result<()> {
        let Err(error) = done else { return Ok(()) };
        let mut kept = "what was recorded before is whole".to_string();
        if let Some(file) = self.file.take() {
            // The last messages are lost in any case; whether the rest has its end, the file itself says.
            let _ = file.finish();
            let scan = crate::recording::scan(&self.path).ok().filter(|scan| scan.whole);
            let bytes = std::fs::metadata(&self.path).map_or(0, |known| known.len());
            self.progress.cut(bytes, scan.as_ref().map_or(0, |scan| scan.contents.messages(FRAMES)));
            kept = if scan.is_some() { kept } else { self.incomplete() };
        }
        Err(error).with_context(|| format!("{} cannot be written, {kept}", self.path.display()))
    }

    fn take(&mut self, client: &Client, event: &Event) -> Result<()> {
        let stamp = self.stamps.of(client, event);
        self.standing.take(client, event);
        self.rotate(client, event, stamp)?;
        self.tally[0] = Tally::of(client.counts());
        self.progress.take(client, event, self.passed.until(stamp.board_us));
        let Some(file) = &mut self.file else { return Ok(()) };
        if *event == Event::Hello && client.worn() != self.worn.as_ref() {
            self.worn = client.worn().cloned();
            if let Some(worn) = &self.worn {
                file.attach(worn, client.line(), &self.plan.origin, stamp)?;
            }
        }
        if stamp.board_us.abs_diff(self.chunk_us) >= CHUNK_US {
            self.chunk_us = stamp.board_us;
            file.close()?;
        }
        file.wire(stamp, client.line())?;
        file.event(client, event, stamp, self.plan.origin.counts_per_newton)
    }

    /// Goes on in another file where it is time: with an image that stands alone, so that the file does, too.
    fn rotate(&mut self, client: &Client, event: &Event, stamp: Stamp) -> Result<()> {
        let Event::Frame { alone: true, .. } = event else { return Ok(()) };
        let Some(file) = &self.file else { return Ok(()) };
        let passed = self.passed.until(stamp.board_us);
        let due = match self.plan.rotate {
            None => false,
            Some(Rotate::After(time)) => passed >= time.as_micros() as u64,
            Some(Rotate::Bytes(bytes)) => file.bytes() >= bytes,
        };
        if !due {
            return Ok(());
        }
        self.finish()?;
        self.tally[1] = self.tally[0];
        self.number += 1;
        self.path = numbered(&self.plan.path, self.number);
        self.passed = Passed::default();
        let file = self.file.insert(begin(&self.plan, &self.path)?);
        if let Some(worn) = &self.worn {
            file.attach(worn, self.standing.hello(), &self.plan.origin, stamp)?;
        }
        for bytes in self.standing.frames(standing::sequence(client.line())?)? {
            file.wire(stamp, &bytes)?;
        }
        Ok(())
    }

    /// An error: the board refuses raw codes.
    fn answered(&mut self, event: &Event) -> Result<()> {
        let Event::Answer { request, refusal } = event else { return Ok(()) };
        let is_ours = [(Request::SetRaw { hz: 0 }).number(), UNREADABLE].contains(request);
        if !is_ours || !std::mem::take(&mut self.waits_for_raw) {
            return Ok(());
        }
        match refusal {
            Some(why) => Err(Fault::board(format!("--raw: the board refuses raw codes: {why}")).into()),
            None => Ok(()),
        }
    }

    fn keep(&mut self) -> Result<()> {
        if self.kept.elapsed() < CHUNK {
            return Ok(());
        }
        if let Some(file) = &mut self.file {
            file.flush()?;
        }
        self.kept = Instant::now();
        let line = || self.progress.line(&self.path, self.file.as_ref().map_or(0, |file| file.bytes()));
        self.shown.told(self.progress.board_us(), line);
        Ok(())
    }
}

/// Begins a file, and the one beside it. They get their names when they can be read: a crash leaves what was
/// written, and what cannot be begun takes no name.
fn begin(plan: &Plan, path: &Path) -> Result<RecordingFile<File>> {
    let output = |path: &Path| Output::file(path, Force { force: plan.force }, &plan.inputs);
    let main = output(path)?;
    let (ros2, ros2_begun) = match plan.ros2 {
        true => output(&beside(path))?.begin().map(|(file, begun)| (Some(file), Some(begun)))?,
        false => (None, None),
    };
    let (main, main_begun) = main.begin()?;
    let file =
        RecordingFile::create(main, ros2).with_context(|| format!("{} cannot be written", path.display()))?;
    main_begun.name()?;
    match ros2_begun.map_or(Ok(()), Begun::name) {
        Ok(()) => Ok(file),
        Err(error) => {
            // The one that has its name is an empty recording, and not half of one; of two errors the first is
            // told.
            _ = file.finish();
            Err(error)
        }
    }
}

impl Show for Recorder {
    fn event(&mut self, client: &Client, event: &Event) -> Result<()> {
        let done = self.take(client, event);
        self.guard(done)?;
        self.answered(event)
    }

    /// It is said on the standard error, too: nobody may look into a recording for days.
    fn gap(&mut self, client: &Client, note: &Event) -> Result<()> {
        if let Event::Log { text, .. } = note {
            self.shown.clear();
            eprintln!("{text}");
        }
        let stamp = self.stamps.now(client);
        let Some(file) = &mut self.file else { return Ok(()) };
        let done = file.event(client, note, stamp, self.plan.origin.counts_per_newton);
        self.guard(done)
    }

    fn asked(&mut self, client: &Client, bytes: &[u8]) -> Result<()> {
        let Some(file) = self.file.as_mut().filter(|_| !bytes.is_empty()) else { return Ok(()) };
        let stamp = self.stamps.now(client);
        let mut done = file.requests(stamp, bytes);
        for frame in bytes.split(|byte| *byte == 0) {
            let mut frame = frame.to_vec();
            let request = wire::open(&mut frame).and_then(wire::decode::<Request<'_>>);
            if let (Ok(Request::Posture(posture)), true) = (request, done.is_ok()) {
                let names = client.worn().map_or(&[][..], |worn| worn.scene.joints.as_slice());
                done = file.posture(stamp, &posture, names);
            }
        }
        self.guard(done)
    }

    fn idle(&mut self, client: &mut Client) -> Result<bool> {
        if client.worn().is_some() && std::mem::take(&mut self.plan.raw) {
            self.waits_for_raw = client.request_codes()?;
        }
        let done = self.keep();
        self.guard(done)?;
        Ok(!stop::asked())
    }

    fn end(&mut self, _: &Client) -> Result<()> {
        self.finish()
    }
}
