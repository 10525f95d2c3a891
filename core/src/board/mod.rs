//! The board as a function that never waits: [`Board::step`] takes an input, [`Board::pending`] returns the
//! bytes to send next, [`Board::sent`] consumes them. Policy (thinning, priorities) is here, where a unit
//! test reaches it.

mod alarms;
mod budget;
mod examining;
mod exchange;
#[cfg(feature = "folds")]
mod folds;
mod info;
mod missed_scans;
mod outbox;
mod outputs;
mod pace;
mod poses;
mod quota;
mod reading;
mod rebuilds;
mod reflex;
mod refusal;
mod region_reports;
mod request;
mod restoring;
mod retest;
mod saving;
mod senses;
mod settings;
mod setup;
mod surface;
mod tables;
mod taxel_health;
mod tx_frame;
mod uploads;
mod work;
mod works;

pub use info::BoardInfo;
pub use settings::{PART_BYTES, Part, Saved, Settings, TooLong};
pub use setup::{Setup, SetupError};
pub use uploads::{PieceToStore, TableKind};

use crate::acquire::{Plan, Scan, ScanError};
use crate::boot::Boot;
use crate::capacity;
use crate::condition::{Certificate, Tare};
use crate::format::{Code, Micros};
use crate::garment::{Circuit, Garment};
use crate::health::Monitor;
use crate::pipeline::{PipelineState, Probe, Stage};
use crate::reflex::Early;
use crate::scene::{Scene, StreamConfig};
use crate::selftest::Findings;
use crate::wire::{Checksum, Health, LONGEST_REQUEST, Receiver, SelfTestReport, StartOfFrame, frame_bound};
use budget::{Doing, Ledger};
#[cfg(feature = "folds")]
use folds::Folds;
use heapless::Deque;
use outbox::{About, Outbox};
use outputs::Outputs;
use pace::Pace;
use rebuilds::Rebuilds;
use refusal::Refusal;
use retest::Retest;
use saving::Saving;
use senses::Senses;
use surface::Surface;
use tx_frame::TxFrame;
use uploads::{TABLES, Uploads};
use work::{TARE, Work};

/// Input of the board: an event, or the passing of time.
#[derive(Debug)]
pub enum Input<'a> {
    /// Bytes from the host, split anywhere.
    Received(&'a [u8]),
    /// A scan finished, or failed.
    Scanned(Result<Scan<'a>, ScanError>),
    /// Result of [`Job::Save`].
    Saved(Result<Saved, &'static str>),
    /// Result of [`Job::ResetSettings`].
    SettingsReset(Result<Saved, &'static str>),
    /// Result of [`Job::StoreTable`]: the whole table with its last piece.
    TableStored(Result<Option<&'static [u8]>, &'static str>),
    /// Result of [`Job::KeepTable`].
    TableKept(TableKind, Result<(), &'static str>),
    /// Result of a test of lines and inputs: at the start and after each [`Job::Examine`].
    Examined(Result<Findings, ScanError>),
    /// A select line was not at the level to which it was driven.
    Misled,
    /// A reaction began by reflex, within the frame being scanned or scanned last.
    Reflex(Early),
    /// When the frame of the USB began that [`Board::asks_start_of_frame`] has asked for.
    StartOfFrame(StartOfFrame),
    /// Asks for the next job.
    Tick,
}

/// Job that the board gives to its loop.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Job {
    /// Scan; answered by [`Input::Scanned`].
    Scan(Plan),
    /// Set the level of a pin.
    Drive(u8, bool),
    /// Store [`Board::settings`]; answered by [`Input::Saved`].
    Save,
    /// Make the stored settings have no effect from the next start on, or restore them; answered by
    /// [`Input::SettingsReset`].
    ResetSettings {
        /// Restore them.
        undo: bool,
    },
    /// Store [`Board::piece_to_store`]; answered by [`Input::TableStored`].
    StoreTable,
    /// Make the table whose pieces were stored last the one of its kind in force, or none if its length is 0;
    /// answered by [`Input::TableKept`].
    KeepTable(TableKind),
    /// Restart, as after power-on.
    Restart,
    /// Stop a free-running scan, and examine lines and inputs: the circuit has changed, the host asks for it,
    /// or there is evidence against one of them. Answered by [`Input::Examined`].
    Examine,
}

/// The whole state of the board, for garments of up to TAXELS taxels; RUNS and PARTS as in
/// [`ContactState`](crate::contact::ContactState).
pub struct Board<const TAXELS: usize, const RUNS: usize, const PARTS: usize = RUNS> {
    info: BoardInfo,
    /// How the board started; none until [`Board::booted`].
    boot: Option<Boot>,
    setup: Setup,
    /// True once the stages were reset for the first garment.
    begun: bool,
    state: PipelineState<TAXELS, RUNS, PARTS>,
    inbox: Receiver<{ frame_bound(LONGEST_REQUEST) }>,
    outbox: Outbox<TAXELS>,
    outputs: Outputs,
    senses: Senses,
    works: Deque<Work, 4>,
    /// True from the start of a [`Work`] to the end of the next scan.
    worked: bool,
    saving: Saving,
    rebuilds: Rebuilds,
    /// The last self-test of the present garment's lines and inputs.
    examined: Option<SelfTestReport>,
    retest: Retest,
    scans: Pace,
    scanning: bool,
    /// Number of scans that have failed since the last good one.
    stumbles: u16,
    /// True after an interruption of the scan whose lost frames are not counted yet.
    interrupted: bool,
    /// True if the circuit has changed since the last scan.
    rewired: bool,
    health: Health,
    ledger: Ledger,
    frame: u32,
    taring: bool,
    /// True if the garment has a baseline of its own, by tare or restored.
    tared: bool,
    monitor: Monitor,
    /// Calibration from which the gains come.
    certificate: Option<Certificate>,
    surface: Surface,
    #[cfg(feature = "folds")]
    folds: Folds,
    uploads: Uploads,
}

/// The board that ships, of the capacities that [`capacity`] states.
pub type Shipped = Board<{ capacity::TAXELS }, { capacity::RUNS }, { capacity::PARTS }>;

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
            info,
            boot: None,
            setup: Setup::empty(),
            begun: false,
            state: PipelineState::default(),
            inbox: Receiver::new(),
            outbox: Outbox::new(&StreamConfig::default()),
            outputs: Outputs::default(),
            senses: Senses::default(),
            works: Deque::new(),
            worked: false,
            saving: Saving::new(),
            rebuilds: Rebuilds::new(),
            examined: None,
            scans: Pace::new(0),
            retest: Retest::new(),
            scanning: false,
            stumbles: 0,
            interrupted: false,
            rewired: false,
            health: Health::default(),
            ledger: Ledger::new(),
            frame: 0,
            taring: false,
            tared: false,
            monitor: const { Monitor::new() },
            certificate: None,
            surface: const { Surface::new() },
            #[cfg(feature = "folds")]
            folds: const { Folds::new() },
            uploads: const { Uploads::new() },
        }
    }

    /// Sets the first garment, before the first [`Board::step`].
    pub fn set_garment(&mut self, mut garment: Garment) -> Result<(), SetupError> {
        self.setup.change_garment(&self.info, &mut garment, TAXELS)
    }

    /// Sets the first scene, before the first [`Board::step`].
    pub fn set_scene(&mut self, mut scene: Scene) -> Result<(), SetupError> {
        self.setup.change_scene(&self.info, &mut scene)?;
        self.scans = Pace::new(self.setup.scan_rate());
        self.outbox.pace(&self.setup.scene.stream);
        self.outputs = Outputs::at_rest(self.setup.pipeline.reactions());
        Ok(())
    }

    /// Sets how the board started, which is sent after each `Hello`.
    pub fn booted(&mut self, boot: Boot) {
        self.boot = Some(boot);
    }

    /// Resets the state of all stages.
    fn reset(&mut self) {
        let Setup { layout, circuit, .. } = &self.setup;
        self.state.reset(layout, circuit.falling(), self.info.full_scale);
        self.monitor.reset();
    }

    /// The garment has changed: resets everything known of the old one.
    fn garment_changed(&mut self) {
        self.reset();
        self.senses.blind();
        self.rewired = true;
        self.outbox.renew();
        let (at, state) = (self.ledger.last(), &self.state);
        self.outbox.end_contacts(at, state.released(), state.symbols(), &mut self.health);
        if core::mem::take(&mut self.taring) {
            self.outbox.answer(TARE, Some(Refusal::of("the garment was changed")));
        }
        self.tared = false;
        (self.examined, self.retest) = (None, Retest::new());
        self.certificate = None;
        self.surface.refit(&self.setup.layout, at);
        self.scene_changed();
    }

    /// The scene has changed: resets what its stages have found.
    fn scene_changed(&mut self) {
        self.state.forget();
        #[cfg(feature = "folds")]
        self.refit_folds();
        self.monitor.again();
        self.scans = Pace::new(self.setup.scan_rate());
        self.outbox.end_intention(self.ledger.last());
        self.outbox.pace(&self.setup.scene.stream);
        self.outputs.follow(Outputs::at_rest(self.setup.pipeline.reactions()));
        self.show_frames();
    }

    /// Resets the state of all stages, once.
    fn begin(&mut self) {
        if !self.begun {
            self.begun = true;
            self.reset();
            #[cfg(feature = "folds")]
            self.refit_folds();
        }
    }

    /// Takes any input, at `now`. Only [`Input::Tick`] returns a job.
    pub fn step(&mut self, now: Micros, input: Input<'_>, probe: &mut impl Probe) -> Option<Job> {
        self.begin();
        let doing = if matches!(input, Input::Scanned(Ok(_))) { Doing::Process } else { Doing::Else };
        self.ledger.turn(now, doing, self.outbox.has_rest());
        match input {
            Input::Received(bytes) => self.receive(now, bytes),
            Input::Scanned(Ok(scan)) => self.perceive(now, &scan, probe),
            Input::Scanned(Err(error)) => self.stumbled(error),
            Input::Saved(result) => self.saved(now, result),
            Input::SettingsReset(result) => self.settings_reset(now, result),
            Input::TableStored(result) if TABLES => self.table_stored(now, result),
            Input::TableKept(kind, result) if TABLES => self.table_kept(now, kind, result),
            Input::TableStored(_) | Input::TableKept(..) => {}
            Input::Examined(result) => self.examined(now, result),
            Input::Misled => self.retest.raise(now),
            Input::Reflex(early) => self.reflex(&early),
            Input::StartOfFrame(start) => self.outbox.start_of_frame(start),
            Input::Tick => return self.next_job(now),
        }
        None
    }

    fn next_job(&mut self, now: Micros) -> Option<Job> {
        self.outbox.tick(now);
        self.look_after(now);
        if let Some((pin, level)) = self.outputs.next() {
            return Some(Job::Drive(pin, level));
        }
        if let Some(job) = self.next_work(now) {
            return Some(job);
        }
        if self.scanning {
            return None;
        }
        if core::mem::take(&mut self.rewired) {
            return Some(Job::Examine);
        }
        if self.retest.follow() {
            return Some(Job::Examine);
        }
        if !self.scans.due(now) {
            return None;
        }
        self.scanning = true;
        Some(Job::Scan(self.setup.scene.plan))
    }

    /// True if the board accepts the byte that ends the message being received. Two changes of garment or
    /// scene need a scan between them; all other bytes are accepted at any time. A change that is passed on
    /// too early is made all the same.
    pub fn takes_message(&mut self, now: Micros) -> bool {
        !self.inbox.first().is_some_and(Rebuilds::count) || self.rebuilds.are_due(now)
    }

    /// True once after each `Sync`: the host would like to know when a frame of the USB begins.
    pub fn asks_start_of_frame(&mut self) -> bool {
        self.outbox.asks_start_of_frame()
    }

    /// A scan has ended, successfully or not.
    fn scan_ended(&mut self) {
        (self.scanning, self.worked) = (false, false);
        self.rebuilds.scanned();
    }

    /// Time of the next scan. Until then only bytes need moving.
    pub fn wake(&self) -> Micros {
        self.scans.next()
    }

    fn perceive(&mut self, now: Micros, scan: &Scan<'_>, probe: &mut impl Probe) {
        self.scan_ended();
        if self.stumbles > 0 || self.interrupted {
            self.go_on(scan.report.start);
        }
        self.frame = self.frame.wrapping_add(1);
        self.ledger.begin(now, self.frame, scan.report.start, scan.report.duration_us);
        self.outbox.charge(|| self.ledger.due(now, &self.health));
        self.health.scans = self.health.scans.wrapping_add(1);
        // A scene that wants fewer frames than the converter makes skips the others on purpose.
        if self.setup.scene.rate_hz == 0 {
            self.health.overruns = self.health.overruns.wrapping_add(scan.report.overruns);
        }
        self.health.scan_us = scan.report.duration_us;
        self.outbox.warm(scan.report.start, scan.report.temperature);
        let Setup { pipeline, layout, circuit, .. } = &self.setup;
        let time = scan.report.start;
        let percept = pipeline.process(&mut self.state, layout, scan.codes, circuit.falling(), time, probe);
        let touched = !percept.present.is_empty();
        for change in percept.reactions.changes() {
            if let Some((pin, level)) = pipeline.reactions().pin(percept.reactions, change.index) {
                self.outputs.set(pin, level);
            }
        }
        // Only a scene without a rate limit keeps pace with the converter.
        let late = self.setup.scene.rate_hz == 0 && self.ledger.is_late();
        self.outbox.enqueue(self.frame, time, &percept, late, &mut self.health);
        self.surface.note(self.frame, time, percept.present, touched);
        if cfg!(feature = "surface") {
            let words = |id| percept.symbols.words(id).unwrap_or_default();
            self.surface.feel((self.frame, time), layout, percept.present, words);
        }
        #[cfg(feature = "folds")]
        self.folds.note(self.frame, time);
        if self.taring && percept.tare == Tare::Done {
            (self.taring, self.tared) = (false, true);
            self.outbox.answer(TARE, None);
        }
        self.outbox.raw(scan.codes, layout.taxels());
        self.watch(now, scan.codes, touched);
        self.saw(now);
        probe.begin(Stage::Idle);
    }

    /// Bytes to send next: the rest of the message in transmission, else the most urgent message, encoded
    /// now.
    pub fn pending(&mut self, now: Micros, platform: &mut (impl Probe + Checksum)) -> &[u8] {
        let rest = self.outbox.has_rest();
        self.ledger.turn(now, if rest { Doing::Else } else { Doing::Encode }, rest);
        let Board {
            outbox,
            ledger,
            info,
            boot,
            setup,
            monitor,
            examined,
            certificate,
            health,
            state,
            surface,
            #[cfg(feature = "folds")]
            folds,
            ..
        } = self;
        health.process_us = ledger.process_us();
        let image = state.image(&setup.pipeline, &setup.layout);
        let about = About {
            info,
            boot: *boot,
            setup,
            monitor,
            examined: examined.as_ref(),
            certificate: certificate.as_ref(),
            present: state.present(),
            form_ages: state.form_ages(),
            took_picture: state.took_picture(),
            unsure: state.unsure(),
            taught: &state.taught,
        };
        let falling = setup.circuit.falling();
        let full = Code(if falling { 0 } else { setup.scene.plan.depth.keep(info.full_scale) });
        let senses = (monitor.faulty(), full, falling);
        let pressing = surface.is_due().then_some(|tx_frame: &mut TxFrame| {
            let (layout, values) = (&setup.layout, image.values);
            surface.put(
                tx_frame,
                |pressing, table| state.doubt(pressing, table, layout, values, senses),
                |pressing, table| state.press(pressing, table, layout, values),
            )
        });
        #[cfg(feature = "folds")]
        let folding = folds
            .is_due()
            .then_some(|| folds.report(state.condition.folds(), || state.doubts(&setup.layout)));
        #[cfg(not(feature = "folds"))]
        let folding = None::<fn() -> Option<crate::wire::FoldsReport>>;
        outbox.prepare(now, about, &image, (pressing, folding), health, platform);
        if !outbox.has_rest() {
            ledger.rest();
        }
        outbox.rest()
    }

    /// Records that the link has taken the first `count` of the pending bytes.
    pub fn sent(&mut self, count: usize) {
        self.outbox.sent(count);
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

    /// Counters.
    pub fn health(&self) -> &Health {
        &self.health
    }
}
