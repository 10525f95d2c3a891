//! The board as a function that never waits: [`Board::step`] takes an input, [`Board::pending`] returns the
//! bytes to send next, [`Board::sent`] consumes them. Policy (thinning, priorities) is here, where a unit
//! test reaches it.
//!
//! The board is made of owners: each has a part of its state, in one file, and none knows another. What follows
//! from an input is added to the `Effects`: reports, answers, pins. What perceives, garment and scene with
//! their stages, is handed to them. The board itself only hands each input to those that it concerns.
//!
//! | owner | of what |
//! |---|---|
//! | `Scans` | when to scan, and what is missed |
//! | `FrameBudget` | the time that frames take |
//! | `Calibration` | baseline and gains |
//! | `TaxelWatch`, `LineTests` | faults of taxels, and of lines and inputs |
//! | `Alarms` | reactions to the board's own state |
//! | `Surface`, `Folds` | reports by the tables in flash |
//! | `Uploads`, `Jobs`, `Rebuilds` | tables that come, work that stops the scan, changes of garment and scene |

mod alarms;
mod budget;
mod calibration;
mod effects;
mod exchange;
#[cfg(feature = "folds")]
mod folds;
mod info;
mod io;
mod jobs;
mod line_tests;
mod outbox;
mod outputs;
mod pace;
mod perception;
mod quota;
mod reading;
mod rebuilds;
mod reflex;
mod refusal;
mod region_reports;
mod retest;
mod saving;
mod scans;
mod settings;
mod setup;
mod shapes;
mod surface;
mod tables;
mod taxel_watch;
mod tx_frame;

pub use crate::wire::TableKind;
pub use info::BoardInfo;
pub use io::{Input, Job};
pub use settings::{PART_BYTES, Part, Saved, Settings, TooLong};
pub use setup::{Setup, SetupError};
pub use tables::PieceToStore;

use crate::acquire::{Scan, ScanError};
use crate::boot::{Aside, Boot};
use crate::capacity;
use crate::format::{Code, Micros};
use crate::garment::{Circuit, Garment, PANELS};
use crate::health;
use crate::intent::{Feed, Intent};
use crate::pipeline::{PipelineState, Probe, Stage};
use crate::reflex::Reflexes;
use crate::scene::{Scene, StreamConfig};
use crate::selftest::Findings;
use crate::surface::Table;
use crate::wire::{
    Checksum, Health, LONGEST_REQUEST, Receiver, Report, Request, WireError, decode, frame_bound,
};
use alarms::{Alarms, Faults};
use budget::{Activity, FrameBudget};
use calibration::Calibration;
use core::fmt;
use effects::Effects;
#[cfg(feature = "folds")]
use folds::Folds;
use heapless::Vec;
use jobs::{Jobs, Work};
use line_tests::{LineTests, Tested};
use outbox::{About, Outbox, Streamed};
use outputs::Outputs;
use perception::{Perception, is_busy};
use rebuilds::Rebuilds;
use refusal::Refusal;
use scans::Scans;
use surface::Surface;
use tables::{TABLES, UploadStep, Uploads};
use taxel_watch::TaxelWatch;
use tx_frame::TxFrame;

/// Number that stands in the answer to an unreadable request.
const UNREADABLE: u8 = 255;

/// The whole state of the board, for garments of up to TAXELS taxels; RUNS and PARTS as in
/// [`ContactState`](crate::contact::ContactState).
pub struct Board<const TAXELS: usize, const RUNS: usize, const PARTS: usize = RUNS> {
    /// Start of the board; none until [`Board::booted`].
    boot: Option<Boot>,
    /// True once the stages were reset for the first garment.
    begun: bool,
    inbox: Receiver<{ frame_bound(LONGEST_REQUEST) }>,
    info: BoardInfo,
    setup: Setup,
    state: PipelineState<TAXELS, RUNS, PARTS>,
    outbox: Outbox<TAXELS>,
    outputs: Outputs,
    health: Health,
    /// Number of the last perceived frame.
    frame: u32,
    scans: Scans,
    budget: FrameBudget,
    calibration: Calibration,
    taxels: TaxelWatch,
    lines: LineTests,
    alarms: Alarms,
    surface: Surface,
    #[cfg(feature = "folds")]
    folds: Folds,
    tables: Uploads,
    jobs: Jobs,
    rebuilds: Rebuilds,
}

/// The board that ships, of the capacities that [`capacity`] states.
pub type Shipped = Board<{ capacity::TAXELS }, { capacity::RUNS }, { capacity::PARTS }>;

/// The parts of a board that perceive, for an owner; the owner itself stays free to be borrowed.
macro_rules! perception {
    ($board:ident) => {
        &mut Perception { info: &$board.info, setup: &mut $board.setup, state: &mut $board.state }
    };
}

/// The parts of a board that take effects, for an owner.
macro_rules! effects {
    ($board:ident) => {
        &mut Effects {
            outbox: &mut $board.outbox,
            outputs: &mut $board.outputs,
            health: &mut $board.health,
            frame: $board.frame,
        }
    };
}

/// Construction, and what the board begins with.
impl<const TAXELS: usize, const RUNS: usize, const PARTS: usize> Board<TAXELS, RUNS, PARTS> {
    /// A board with a garment and a scene.
    pub fn new(info: BoardInfo, garment: Garment, scene: Scene) -> Result<Self, SetupError> {
        let mut board = Board::bare(info);
        board.set_garment(garment)?;
        board.set_scene(scene)?;
        Ok(board)
    }

    /// A board without a garment, built in place, because a microcontroller's stack has no room for the
    /// whole. Its stages are reset on the first [`Board::step`].
    #[inline(never)]
    pub fn bare(info: BoardInfo) -> Self {
        const { assert!(TAXELS <= capacity::TAXELS, "messages and stored settings have room for no more") };
        Board {
            boot: None,
            begun: false,
            inbox: Receiver::new(),
            info,
            setup: Setup::empty(),
            state: PipelineState::default(),
            outbox: Outbox::new(&StreamConfig::default()),
            outputs: Outputs::default(),
            health: Health::default(),
            frame: 0,
            scans: Scans::new(),
            budget: FrameBudget::new(),
            calibration: Calibration::new(),
            taxels: const { TaxelWatch::new() },
            lines: LineTests::new(),
            alarms: Alarms::default(),
            surface: const { Surface::new() },
            #[cfg(feature = "folds")]
            folds: const { Folds::new() },
            tables: const { Uploads::new() },
            jobs: Jobs::new(),
            rebuilds: Rebuilds::new(),
        }
    }

    /// Sets the first garment, before the first [`Board::step`].
    pub fn set_garment(&mut self, mut garment: Garment) -> Result<(), SetupError> {
        self.setup.change_garment(&self.info, &mut garment, TAXELS)
    }

    /// Sets the first scene, before the first [`Board::step`].
    pub fn set_scene(&mut self, mut scene: Scene) -> Result<(), SetupError> {
        self.setup.change_scene(&self.info, &mut scene)?;
        self.rates_changed();
        self.outputs = Outputs::at_rest(self.setup.pipeline.reactions());
        Ok(())
    }

    /// Sets how the board started, which each `Hello` reports.
    pub fn booted(&mut self, boot: Boot) {
        self.boot = Some(boot);
    }

    /// Limits the saves to those that were left before a reset.
    pub fn resume_saving(&mut self, left: u8) {
        self.jobs.resume(left);
    }

    /// Takes a part of stored settings. A part that does not fit is ignored, and the reason is logged.
    #[inline(never)] // own frame: its stack is free again on return
    pub fn restore(&mut self, part: Part, bytes: &[u8]) {
        self.begin();
        let done = match part {
            Part::Garment => self.restore_garment(bytes),
            Part::Scene => self.take_scene(bytes, Micros(0)).inspect_err(|_| {
                perception!(self).ship_scene();
                self.scene_changed();
            }),
            Part::Gain => self.restore_numbers(bytes, |board, taxel, gain| board.put_gain(taxel, gain)),
            Part::Baseline => self.restore_numbers(bytes, |board, taxel, code| {
                let is_set = board.state.condition.set_baseline(taxel, Code(code));
                board.calibration.restored(is_set);
            }),
            Part::Calibration => decode(bytes).map_err(Refusal::of).and_then(|certificate| {
                let taxels = self.setup.layout.taxels();
                self.calibration.certify(certificate, taxels, effects!(self))
            }),
        };
        if let Err(why) = done {
            self.outbox.log(format_args!("stored {part}: {}", why.sentence()));
        }
    }

    /// Logs why the stored settings were not used.
    pub fn forgot(&mut self, why: impl fmt::Display) {
        self.outbox.log(format_args!("stored settings: {why}; this is what ships"));
    }

    /// Gives the board a table that its flash holds, after its garment and scene.
    pub fn recall_table(&mut self, kind: TableKind, table: Option<&'static [u8]>) {
        if TableKind::USED.contains(&kind) {
            self.install(kind, table);
        }
    }

    /// Sets a stored garment, with a scene that fits any garment; the stored scene follows.
    #[inline(never)]
    fn restore_garment(&mut self, bytes: &[u8]) -> Result<(), Refusal> {
        let reactions = core::mem::take(&mut self.setup.scene.react);
        let done = perception!(self).take_garment(bytes);
        match done {
            Ok(()) => self.garment_changed(),
            Err(_) => self.setup.scene.react = reactions,
        }
        done
    }

    fn restore_numbers(&mut self, bytes: &[u8], set: fn(&mut Self, usize, u16)) -> Result<(), Refusal> {
        let (numbers, rest) = bytes.as_chunks();
        if numbers.len() != self.setup.layout.taxels() || !rest.is_empty() {
            return Err(Refusal::of("it is of another garment"));
        }
        for (taxel, number) in numbers.iter().enumerate() {
            set(self, taxel, u16::from_le_bytes(*number));
        }
        Ok(())
    }

    /// Resets the state of all stages, once.
    fn begin(&mut self) {
        if !core::mem::replace(&mut self.begun, true) {
            self.reset();
            #[cfg(feature = "folds")]
            self.folds.revalidate(perception!(self));
        }
    }

    fn reset(&mut self) {
        perception!(self).reset();
        self.taxels.monitor.reset();
    }
}

/// Inputs.
impl<const TAXELS: usize, const RUNS: usize, const PARTS: usize> Board<TAXELS, RUNS, PARTS> {
    /// Takes any input, at `now`. Only [`Input::Tick`] returns a job.
    pub fn step(&mut self, now: Micros, input: Input<'_>, probe: &mut impl Probe) -> Option<Job> {
        self.begin();
        let is_scan = matches!(input, Input::Scanned(Ok(_)));
        let activity = if is_scan { Activity::Process } else { Activity::Else };
        self.budget.turn(now, activity, self.outbox.has_rest());
        match input {
            Input::Received(bytes) => self.receive(now, bytes),
            Input::Scanned(Ok(scan)) => self.perceive(now, &scan, probe),
            Input::Scanned(Err(error)) => self.scan_failed(error),
            Input::Saved(result) => self.saved(now, result),
            Input::SettingsReset(result) => {
                self.work_ended(now);
                self.jobs.settings_reset(now, result, effects!(self));
            }
            Input::TableStored(result) if TABLES => self.table_stored(now, result),
            Input::TableKept(kind, result) if TABLES => self.table_kept(now, kind, result),
            Input::TableStored(_) | Input::TableKept(..) => {}
            Input::Examined(result) => self.tested(now, result),
            Input::Misled => self.lines.raise(now),
            Input::Reflex(early) => {
                reflex::begin(&early, self.budget.scanned(), perception!(self), effects!(self));
            }
            Input::StartOfFrame(start) => self.outbox.note(Report::START_OF_FRAME, &start),
            Input::Tick => return self.next_job(now),
        }
        None
    }

    fn next_job(&mut self, now: Micros) -> Option<Job> {
        self.outbox.tick(now);
        self.update_alarms(now);
        if let Some((pin, level)) = self.outputs.next() {
            return Some(Job::Drive(pin, level));
        }
        if let Some(job) = self.next_work(now) {
            return Some(job);
        }
        if self.scans.is_scanning() {
            return None;
        }
        if self.lines.begin() {
            return Some(Job::Examine);
        }
        self.scans.begin(now).then_some(Job::Scan(self.setup.scene.plan))
    }

    /// Returns the next work other than scanning, if it is due.
    fn next_work(&mut self, now: Micros) -> Option<Job> {
        if self.jobs.restarts(now) {
            return Some(Job::Restart);
        }
        let taxels = self.setup.layout.taxels();
        let is_busy = || self.calibration.is_tared() && is_busy(&self.setup.scene, &self.state);
        let work = self.jobs.due(now, (is_busy, taxels), effects!(self))?;
        if work != Work::SelfTest && !self.alarms.are_blind() {
            // Reactions to blindness come first: the flash takes longer than most can wait.
            self.alarms.blind();
            self.update_alarms(now);
            if let Some((pin, level)) = self.outputs.next() {
                return Some(Job::Drive(pin, level));
            }
        }
        self.jobs.begin(now);
        Some(match work {
            Work::Save => Job::Save,
            Work::Reset { undo } => Job::ResetSettings { undo },
            Work::SelfTest => Job::Examine,
            Work::StoreTable => Job::StoreTable,
            Work::KeepTable(kind) => Job::KeepTable(kind),
        })
    }

    fn update_alarms(&mut self, now: Micros) {
        let (lines, scans, taxels) = (&self.lines, &self.scans, &self.taxels);
        let faults = || Faults {
            lines: lines.faults() as i32 + i32::from(scans.fail()),
            taxels: taxels.monitor.faulty(),
        };
        self.alarms.update(now, perception!(self), faults, effects!(self));
    }

    fn perceive(&mut self, now: Micros, scan: &Scan<'_>, probe: &mut impl Probe) {
        let Board { setup: Setup { pipeline, layout, circuit, .. }, state, outbox, health, budget, .. } =
            self;
        let (time, duration_us) = (scan.report.start, scan.report.duration_us);
        self.scans.ended();
        self.jobs.scanned();
        self.rebuilds.scanned();
        self.scans.done(time, budget.scanned(), health);
        self.frame = self.frame.wrapping_add(1);
        let frame = self.frame;
        budget.begin(now, frame, time, duration_us);
        outbox.queue_budget(|| budget.due(now, health));
        if !self.scans.is_limited() {
            health.overruns = health.overruns.wrapping_add(scan.report.overruns);
        }
        health.scan_us = duration_us;
        outbox.queue_temperature(time, scan.report.temperature);
        let percept = pipeline.process(state, layout, scan.codes, circuit.falling(), time, probe);
        let touched = !percept.present.is_empty();
        for change in percept.reactions.changes() {
            self.outputs.apply(pipeline.reactions().pin(percept.reactions, change.index));
        }
        // Only a scene without a rate limit keeps pace with the converter.
        let late = !self.scans.is_limited() && budget.is_late();
        outbox.enqueue(frame, time, &percept, late, health);
        self.surface.note(frame, time, percept.present, touched);
        if cfg!(feature = "surface") {
            let words = |id| percept.symbols.words(id).unwrap_or_default();
            self.surface.update_regions((frame, time), layout, percept.present, words);
        }
        #[cfg(feature = "folds")]
        self.folds.note(frame, time);
        outbox.enqueue_raw(frame, time, scan.codes.get(..layout.taxels()).unwrap_or(scan.codes));
        let tare = percept.tare;
        self.calibration.progress(tare, effects!(self));
        let is_tared = self.calibration.is_tared();
        if self.taxels.watch(scan.codes, (touched, is_tared), perception!(self), effects!(self)) {
            self.lines.raise(now);
        }
        self.frame_perceived(now);
        probe.begin(Stage::Idle);
    }

    /// Records a perceived frame. During a tare no frame counts as perceived.
    fn frame_perceived(&mut self, now: Micros) {
        if self.state.condition.baseline().is_none() {
            return self.alarms.blind();
        }
        self.alarms.frame_perceived(now, self.setup.pipeline.reactions(), &mut self.outputs);
    }

    /// Counts and logs a failed scan.
    #[cold]
    fn scan_failed(&mut self, error: ScanError) {
        self.scans.ended();
        self.jobs.scanned();
        self.rebuilds.scanned();
        self.scans.failed(&mut self.health);
        self.outbox.log(format_args!("scan: {error}"));
    }

    /// Takes the end of other work than scanning; returns false if none was begun.
    fn work_ended(&mut self, now: Micros) -> bool {
        let Some(us) = self.jobs.ended(now) else { return false };
        self.scans.count_missed(us, &mut self.health);
        true
    }

    fn saved(&mut self, now: Micros, result: Result<Saved, &'static str>) {
        self.work_ended(now);
        if result.is_ok()
            && let Some(boot) = &mut self.boot
        {
            // The settings stored now are those in force.
            boot.aside = Aside::No;
        }
        self.jobs.saved(now, result, effects!(self));
    }

    /// Takes the result of a test of lines and inputs.
    fn tested(&mut self, now: Micros, result: Result<Findings, ScanError>) {
        match self.lines.tested(now, result) {
            Tested::OnEvidence(is_new) => {
                self.scans.interrupt();
                if is_new {
                    self.outbox.flag(Report::SELF_TEST);
                }
            }
            // The tests at the start and after a change of garment were not requested: their result goes out
            // with the other news of it.
            Tested::Else(refusal) if self.work_ended(now) => {
                if refusal.is_none() {
                    self.taxels.recover(perception!(self), effects!(self));
                    self.outbox.flag(Report::SELF_TEST);
                }
                self.outbox.answer(Work::SelfTest.request(), refusal);
            }
            Tested::Else(_) => {}
        }
    }

    /// Takes the result of storing a piece of a table.
    #[inline(never)]
    fn table_stored(&mut self, now: Micros, result: Result<Option<&'static [u8]>, &'static str>) {
        self.work_ended(now);
        if self.tables.is_first() {
            self.jobs.charge(now);
        }
        let Some(done) = self.tables.stored(result, &self.setup.layout) else { return };
        let refusal = match done {
            // It is answered once the table is kept.
            Ok(UploadStep::Keep(kind)) => match self.jobs.add(Work::KeepTable(kind)) {
                Ok(()) => return,
                Err(why) => {
                    self.tables.end();
                    Some(why)
                }
            },
            Ok(_) => None,
            Err(why) => Some(why),
        };
        self.outbox.answer(Work::StoreTable.request(), refusal);
    }

    /// Takes the result of keeping the table that was stored last, or none.
    #[inline(never)]
    fn table_kept(&mut self, now: Micros, kind: TableKind, result: Result<(), &'static str>) {
        self.work_ended(now);
        let whole = self.tables.end();
        if result.is_ok() {
            self.install(kind, whole);
        }
        self.outbox.answer(Work::KeepTable(kind).request(), result.err().map(Refusal::of));
    }

    /// Puts a table in force, if it fits the present garment.
    fn install(&mut self, kind: TableKind, table: Option<&'static [u8]>) {
        match kind {
            TableKind::Surface => {
                self.surface.install(table, &self.setup.layout, self.budget.last());
            }
            #[cfg(feature = "folds")]
            TableKind::Folds => {
                self.folds.install(table);
                self.folds.revalidate(perception!(self));
            }
            #[cfg(not(feature = "folds"))]
            TableKind::Folds => {}
        }
    }

    /// Sets the gain of a taxel.
    fn put_gain(&mut self, taxel: usize, gain: u16) {
        self.taxels.put_gain(taxel, gain, perception!(self));
    }
}

/// Requests.
impl<const TAXELS: usize, const RUNS: usize, const PARTS: usize> Board<TAXELS, RUNS, PARTS> {
    /// True if the board accepts the byte that ends the message being received. Two changes of garment or
    /// scene need a scan between them; all other bytes are accepted at any time. A change that is passed on
    /// too early is made all the same.
    pub fn takes_message(&mut self, now: Micros) -> bool {
        !self.inbox.first().is_some_and(Rebuilds::count) || self.rebuilds.are_due(now)
    }

    fn receive(&mut self, now: Micros, mut bytes: &[u8]) {
        while !bytes.is_empty() {
            let (taken, frame) = self.inbox.take(bytes);
            bytes = bytes.get(taken..).unwrap_or(&[]);
            let Some(frame) = frame else { continue };
            // The message is copied out of the inbox, which is part of the board that it changes.
            let mut message = Vec::<u8, LONGEST_REQUEST>::new();
            let read = frame.and_then(|body| {
                message.extend_from_slice(body).map_err(|_| WireError::TooLong)?;
                decode::<Request>(&message)
            });
            match read {
                Ok(request) => {
                    self.alarms.host_heard(now);
                    self.dispatch(now, request);
                }
                Err(error) => {
                    let health = &mut self.health;
                    health.refused = health.refused.wrapping_add(1);
                    self.outbox.answer(UNREADABLE, Some(format_args!("{error}").into()));
                }
            }
        }
    }

    /// Hands a request to the owner that it concerns, and answers it unless the answer comes later.
    fn dispatch(&mut self, now: Micros, request: Request<'_>) {
        let number = request.number();
        if Rebuilds::count(number) {
            self.rebuilds.charge(now);
        }
        let result = match request {
            Request::Start => {
                self.start(now);
                Ok(())
            }
            Request::Stop => {
                self.stop();
                Ok(())
            }
            Request::Sync { token } => return self.outbox.sync(token, now),
            Request::KeyFrame => {
                self.outbox.forget_image();
                Ok(())
            }
            Request::Stream { raw_hz, budget_hz } => self.stream(raw_hz, budget_hz),
            Request::SetGarment(bytes) => self.take_garment(bytes, now),
            Request::SetScene(bytes) => self.take_scene(bytes, now).map(|()| {
                // Other programs on the board know its concepts by this scene.
                self.outbox.flag(Report::HELLO);
            }),
            Request::SetTable(bytes) => return self.later(number, |board| board.take_table(bytes, now)),
            Request::SetShapes(bytes) => shapes::set(bytes, perception!(self), effects!(self)),
            Request::AddShapes(bytes) => shapes::add(bytes, perception!(self), effects!(self)),
            Request::SetGain { first, gains } => self.set_gain(first, &gains),
            Request::SetCalibration(certificate) => {
                self.calibration.certify(certificate, self.setup.layout.taxels(), effects!(self))
            }
            Request::Tare { frames } => {
                return self.later(number, |board| board.calibration.tare(frames, perception!(board)));
            }
            Request::SelfTest => return self.later(number, |board| board.jobs.add(Work::SelfTest)),
            Request::Save => {
                return self.later(number, |board| {
                    board.jobs.may_write(now, board.calibration.is_taring())?;
                    board.jobs.add(Work::Save)
                });
            }
            Request::ResetSettings { undo } => {
                return self.later(number, |board| board.jobs.add(Work::Reset { undo }));
            }
            Request::Posture(posture) => {
                let known = self.state.condition.posture_mut();
                known.accept(&posture, &self.setup.scene.joints, now).map_err(Refusal::of)
            }
            Request::SetPoses(_) if !cfg!(feature = "surface") => Err(Refusal::left_out("surface")),
            Request::SetPoses(bytes) => self.surface.take_poses(bytes, now),
            Request::Feed(feed) => self.feed(&feed, now),
        };
        self.outbox.answer(number, result.err());
    }

    /// Begins what is answered when it is done; a refusal is answered now.
    fn later(&mut self, number: u8, begin: impl FnOnce(&mut Self) -> Result<(), Refusal>) {
        if let Err(why) = begin(self) {
            self.outbox.answer(number, Some(why));
        }
    }

    /// Reports everything from now on: the same codes give the same reports, whatever came before.
    fn start(&mut self, now: Micros) {
        self.taxels.monitor.again();
        self.outbox.start();
        self.surface.name_regions();
        let lasting = self.state.react().since();
        exchange::report_reactions(now, (&self.setup.scene.react, lasting), effects!(self));
        if self.state.taught.gallery().is_some() {
            self.outbox.flag(Report::SHAPES);
        }
        self.report_present(Streamed::default());
    }

    fn stop(&mut self) {
        let before = self.outbox.streamed();
        self.outbox.stop();
        self.report_present(before);
    }

    /// Reports what is present, as far as it is streamed and was not before, or the other way round.
    fn report_present(&mut self, before: Streamed) {
        let state = &self.state;
        let present = (state.present(), state.symbols().regions(PANELS), state.intent().meaning());
        self.outbox.queue_present(before, self.budget.last(), present, &mut self.health);
    }

    fn stream(&mut self, raw_hz: u16, budget_hz: u16) -> Result<(), Refusal> {
        if raw_hz > 0 && !cfg!(feature = "raw") {
            return Err(Refusal::left_out("raw"));
        }
        self.outbox.send_raw(raw_hz);
        self.budget.report(budget_hz);
        Ok(())
    }

    fn feed(&mut self, feed: &Feed, now: Micros) -> Result<(), Refusal> {
        if !cfg!(feature = "intent") {
            return Err(Refusal::left_out("intent"));
        }
        let map = self.setup.pipeline.intent().map(Intent::map);
        self.state.fed.accept(feed, map, now).map_err(Refusal::of)
    }

    fn set_gain(&mut self, first: u16, gains: &[u16]) -> Result<(), Refusal> {
        let end = usize::from(first) + gains.len();
        if end > self.setup.layout.taxels() {
            return Err(Refusal::of("the garment has no such taxel"));
        }
        for (taxel, gain) in (usize::from(first)..end).zip(gains) {
            self.put_gain(taxel, *gain);
        }
        self.calibration.gain_set(effects!(self));
        Ok(())
    }

    fn take_table(&mut self, piece: &[u8], now: Micros) -> Result<(), Refusal> {
        if self.jobs.has_table() {
            return Err(Refusal::of("the last piece is not stored yet"));
        }
        let may_begin = || {
            self.jobs.may_write(now, self.calibration.is_taring())?;
            if self.calibration.is_tared() && is_busy(&self.setup.scene, &self.state) {
                return Err(Refusal::of("something touches the garment"));
            }
            Ok(())
        };
        match self.tables.take(piece, may_begin)? {
            UploadStep::Keep(kind) => self.jobs.add(Work::KeepTable(kind)),
            _ => self.jobs.add(Work::StoreTable),
        }
    }

    fn take_garment(&mut self, bytes: &[u8], now: Micros) -> Result<(), Refusal> {
        let lasting = *self.state.react().since();
        perception!(self).take_garment(bytes)?;
        self.garment_changed();
        exchange::end_reactions(&lasting, now, perception!(self), effects!(self));
        Ok(())
    }

    // Own frame: it needs much stack, and most requests need none of it.
    #[inline(never)]
    fn take_scene(&mut self, bytes: &[u8], now: Micros) -> Result<(), Refusal> {
        let mut scene = Scene::empty();
        reading::scene(bytes, &mut scene)?;
        let streamed = self.outbox.streamed();
        if let Some(done) = self.setup.adjust_scene(&self.info, &mut scene) {
            done.map_err(Refusal::of)?;
            // `scene` now holds the previous scene, here and below.
            if scene.gestures != self.setup.scene.gestures {
                self.state.recognise_anew();
            }
            self.stream_changed();
            self.report_present(streamed);
            return Ok(());
        }
        let lasting = *self.state.react().since();
        let before = Outputs::at_rest(self.setup.pipeline.reactions());
        self.setup.change_scene(&self.info, &mut scene).map_err(Refusal::of)?;
        // A pin that the new scene does not drive must not keep the level of the old one.
        self.outputs.follow(before);
        self.scene_changed();
        exchange::transfer_reactions(&lasting, &scene.react, now, perception!(self), effects!(self));
        self.report_present(streamed);
        Ok(())
    }

    /// The garment has changed: resets everything known of the old one.
    fn garment_changed(&mut self) {
        self.reset();
        self.alarms.blind();
        self.outbox.renew();
        let (at, state) = (self.budget.last(), &self.state);
        self.outbox.end_contacts(at, state.released(), state.symbols(), &mut self.health);
        self.calibration.forget(effects!(self));
        self.lines.rewired();
        self.surface.revalidate(&self.setup.layout, at);
        self.scene_changed();
    }

    /// The scene has changed: resets what its stages have found.
    fn scene_changed(&mut self) {
        self.state.forget();
        #[cfg(feature = "folds")]
        self.folds.revalidate(perception!(self));
        self.taxels.monitor.again();
        self.outbox.end_intention(self.budget.last());
        self.rates_changed();
        let reactions = self.setup.pipeline.reactions();
        self.outputs.follow(Outputs::at_rest(reactions));
        self.alarms.show_frames(reactions, &mut self.outputs);
    }

    /// The scene's rates have changed.
    fn rates_changed(&mut self) {
        self.scans.follow(&self.setup.scene);
        self.stream_changed();
    }

    /// The scene's stream may have changed.
    fn stream_changed(&mut self) {
        let stream = &self.setup.scene.stream;
        self.outbox.pace(stream);
        self.surface.pace(stream.pressing_hz, self.budget.last());
    }
}

/// Bytes to the host.
impl<const TAXELS: usize, const RUNS: usize, const PARTS: usize> Board<TAXELS, RUNS, PARTS> {
    /// Bytes to send next: the rest of the message in transmission, else the most urgent message, encoded
    /// now.
    pub fn pending(&mut self, now: Micros, platform: &mut (impl Probe + Checksum)) -> &[u8] {
        let rest = self.outbox.has_rest();
        self.budget.turn(now, if rest { Activity::Else } else { Activity::Encode }, rest);
        let Board {
            boot,
            info,
            setup,
            state,
            outbox,
            health,
            budget,
            calibration,
            taxels,
            lines,
            surface,
            #[cfg(feature = "folds")]
            folds,
            ..
        } = self;
        health.process_us = budget.process_us();
        let image = state.image(&setup.pipeline, &setup.layout);
        let about = About {
            info,
            boot: *boot,
            setup,
            monitor: &taxels.monitor,
            examined: lines.report(),
            certificate: calibration.certificate(),
            present: state.present(),
            form_ages: state.form_ages(),
            unsure: state.unsure(),
            taught: &state.taught,
            image: &image,
        };
        #[cfg(feature = "folds")]
        let elsewhere = surface.due() | folds.due();
        #[cfg(not(feature = "folds"))]
        let elsewhere = surface.due();
        let put = |number, tx_frame: &mut TxFrame| {
            #[cfg(feature = "folds")]
            if number == Report::FOLDS {
                return folds.put(tx_frame, state.condition.folds(), || state.doubts(&setup.layout));
            }
            let (layout, values, falling) = (&setup.layout, image.values, setup.circuit.falling());
            let full = Code(if falling { 0 } else { setup.scene.plan.depth.keep(info.full_scale) });
            let senses = (taxels.monitor.faulty(), full, falling);
            surface.put(
                number,
                tx_frame,
                |pressing, table| state.doubt(pressing, table, layout, values, senses),
                |pressing, table| state.press(pressing, table, layout, values),
            )
        };
        outbox.prepare(now, &about, (elsewhere, put), health, platform);
        if !outbox.has_rest() {
            budget.rest();
        }
        outbox.rest()
    }

    /// Records that the link has taken the first `count` of the pending bytes.
    pub fn sent(&mut self, count: usize) {
        self.outbox.sent(count);
    }

    /// True once after each `Sync`: the host would like to know when a frame of the USB begins.
    pub fn asks_start_of_frame(&mut self) -> bool {
        self.outbox.asks_start_of_frame()
    }
}

/// Queries of the loop.
impl<const TAXELS: usize, const RUNS: usize, const PARTS: usize> Board<TAXELS, RUNS, PARTS> {
    /// Time of the next scan. Until then only bytes need moving.
    pub fn wake(&self) -> Micros {
        self.scans.next()
    }

    /// Reflexes to watch in each sub-field; none during a tare.
    pub fn reflexes(&self) -> Option<&Reflexes> {
        let Board { setup, state, .. } = self;
        state.condition.baseline().map(|_| setup.pipeline.reactions().reflexes())
    }

    /// Mask of the reactions that last, by row of the scene's table.
    pub fn reacting(&self) -> u8 {
        self.state.reacting()
    }

    /// Last code of a taxel that begins no reflex; none if no row watches the taxel.
    pub fn inactive_code(&self, taxel: u16) -> Option<u16> {
        let Board { setup, state, .. } = self;
        let row = setup.pipeline.reactions().reflexes().row_of(taxel)?;
        Some(state.condition.inactive_code(taxel.into(), row.level, setup.circuit.falling()))
    }

    /// Settings to store.
    pub fn settings(&self) -> Settings<'_> {
        let Board { setup: Setup { garment, scene, layout, .. }, state, .. } = self;
        let gain = state.condition.gain();
        let baseline = state.condition.baseline().filter(|_| self.calibration.is_tared());
        Settings {
            garment,
            scene,
            gain: gain.get(..layout.taxels()).unwrap_or(gain),
            faulty: self.taxels.monitor.faulty(),
            baseline: baseline.map(|all| all.get(..layout.taxels()).unwrap_or(all)),
            calibration: self.calibration.certificate(),
            saves: self.jobs.saves_left(),
        }
    }

    /// The piece of a table to be stored.
    pub fn piece_to_store(&self) -> PieceToStore<'_> {
        self.tables.piece_to_store(self.jobs.saves_left())
    }

    /// Wiring of the garment.
    pub fn circuit(&self) -> &Circuit {
        &self.setup.circuit
    }

    /// Garment and scene, and the stages built from them.
    pub fn setup(&self) -> &Setup {
        &self.setup
    }

    /// State of the stages.
    pub fn state(&self) -> &PipelineState<TAXELS, RUNS, PARTS> {
        &self.state
    }

    /// The surface in force.
    pub fn surface(&self) -> Option<Table<'static>> {
        self.surface.table()
    }

    /// Health of a taxel.
    pub fn health_of(&self, taxel: usize) -> health::TaxelHealth {
        self.taxels.monitor.health(taxel)
    }

    /// Counters.
    pub fn health(&self) -> &Health {
        &self.health
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::garment::Pins;
    use crate::wire::encode;

    #[test]
    fn an_output_that_the_new_scene_does_not_drive_is_put_to_rest() {
        let info =
            BoardInfo { firmware: "", chip: "", pins: Pins::ANY, full_scale: 4095, link_bytes_per_s: 92_160 };
        let mut board = Board::<64, 32>::new(info, Garment::block(), Scene::shipped()).unwrap();
        let drives = |board: &mut Board<64, 32>| {
            let jobs = core::iter::from_fn(|| board.step(Micros(0), Input::Tick, &mut ()));
            let pins = jobs
                .map_while(|job| if let Job::Drive(pin, level) = job { Some((pin, level)) } else { None });
            pins.collect::<heapless::Vec<_, 8>>()
        };
        let mut scene = Scene::shipped();
        let resting: heapless::Vec<_, 8> =
            scene.react.iter().map(|row| (row.output.unwrap().pin, false)).collect();
        assert_eq!(drives(&mut board), resting);
        scene.react.remove(0);
        let (mut text, mut wire) = ([0; 2048], [0; 2048]);
        let text = postcard::to_slice(&scene, &mut text).unwrap();
        let frame = encode(&Request::SetScene(text), &mut wire).unwrap();
        board.step(Micros(0), Input::Received(frame), &mut ());
        assert_eq!(drives(&mut board), resting);
        assert_eq!(board.setup().scene, scene);
    }
}
