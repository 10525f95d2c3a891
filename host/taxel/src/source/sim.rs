//! The simulated board as a source: runs the core's loop in a thread, on virtual time.

use super::beside::{self, yielded};
use super::hand::Hand;
use super::paced::{Paced, Pacing};
use super::pipe::{BoardEnd, pipe};
use super::script_posture::{PosturesEnd, ScriptPosture};
use super::touching::{Rounds, Touching};
use super::{Source, SourceOptions, scene_of};
use crate::body;
use crate::client::SIMULATED;
use crate::error::{Context, Error, Result};
use crate::files::calibrate::ForceScale;
use crate::files::{self, garments, input, scripts};
use crate::sim::{self, COUNTS_PER_NEWTON, FULL_SCALE, Script, SimBoard, SimClock, SimFlash, SimScan};
use std::ops::Range;
use std::path::Path;
use taxel_core::acquire::Clock;
use taxel_core::board::{BoardInfo, PieceToStore, Saved, Settings, Shipped, TableKind};
use taxel_core::boot::{Aside, Boot, BootCause};
use taxel_core::capacity::TAXELS;
use taxel_core::format::Micros;
use taxel_core::garment::{Circuit, Garment, Layout, Pins};
use taxel_core::pipeline::{Probe, Stage};
use taxel_core::run::{Link, Platform, run};
use taxel_core::scene::Scene;
use taxel_core::wire::Checksum;
use taxel_store::{Found, Store, StoreError, Tables, tables_bytes};

/// Capacity of a USB link, bytes per second.
const LINK: u32 = 1_000_000;

/// Script to play, and for how long.
struct Playing {
    script: Script,
    garment: Garment,
    /// Scene of the board at its start.
    scene: Scene,
    /// Tables of the surface and of the folds in its flash at its start.
    surface: Option<&'static [u8]>,
    folds: Option<&'static [u8]>,
    seed: u64,
    realtime: bool,
    rounds: Rounds,
    hand: Hand,
    end_us: u64,
}

/// Opens a simulated board that plays a script of touches.
pub fn open(scene: &str, options: &SourceOptions) -> Result<Source> {
    play(scripts::load(scene)?, format!("sim:{scene}"), options)
}

/// Starts a simulated board that plays a script.
pub fn play(script: Script, label: String, options: &SourceOptions) -> Result<Source> {
    let mut board_scene = scene_of(&script)?;
    let (script, garment) = match &options.garment {
        Some(asked) => fitted(script, &garments::read(asked)?, &mut board_scene, &label)?,
        None => {
            let garment = scripts::garment(&script)?;
            (script, garment)
        }
    };
    let surface = options.body.as_ref().map(|body| surface(body, &garment)).transpose()?;
    let folds = options.folds.as_ref().map(|file| folds(file, &garment)).transpose()?;
    let tare = script.tare_frames.min(4096) as u16;
    let rounds = match (options.repeat, options.waits) {
        (false, _) => Rounds::One,
        (true, false) => Rounds::Many,
        (true, true) => Rounds::Later,
    };
    let seed = options.seed.unwrap_or(script.seed);
    let named = options.garment.clone().unwrap_or(input::beside(&script.folder, &script.garment));
    let layout = Layout::build(&garment, TAXELS, FULL_SCALE).with_context(|| label.clone())?;
    let hand =
        Hand::new(Script { seed, garment: scripts::lasting_path(&named)?, ..script.untouched() }, layout);
    let scene = Some(board_scene.clone());
    let play = Playing {
        seed,
        realtime: options.realtime,
        rounds,
        hand: hand.clone(),
        end_us: if rounds == Rounds::One { end_us(script.duration_s, options) } else { u64::MAX },
        garment,
        scene: board_scene,
        surface,
        folds,
        script,
    };
    let (host, board_end) = pipe();
    let build = move || {
        // Built here for the check only; it is built again for each round.
        SimBoard::new(&play.garment, &play.script, play.seed)?;
        let mut board = Box::new(play.board()?);
        Ok(async move {
            if board_end.begin().await {
                play.all(&mut board, board_end).await;
            }
        })
    };
    beside::run(&label, build).with_context(|| label.clone())?;
    Ok(Source {
        tare,
        scale: ForceScale::new(None, Some(COUNTS_PER_NEWTON)),
        has_asked_garment: options.garment.is_some(),
        has_body: options.body.is_some(),
        scene,
        has_folds: options.folds.is_some(),
        hand: Some(hand),
        ..Source::new(label, host)
    })
}

/// Table of a body's surface that this garment covers.
fn surface(body: &str, garment: &Garment) -> Result<&'static [u8]> {
    let layout = Layout::build(garment, TAXELS, FULL_SCALE)?;
    let surface = body::read(body)?.surface(garment, &layout)?;
    Ok(lasting(&body::table(&surface, &layout)?))
}

/// Table of folds in a file, for this garment.
fn folds(file: &Path, garment: &Garment) -> Result<&'static [u8]> {
    let layout = Layout::build(garment, TAXELS, FULL_SCALE)?;
    let table = files::folds::read(file)?;
    files::folds::check(file, &table, &layout)?;
    Ok(lasting(&table))
}

/// The script on another garment, once checked. Changes are reported on standard error.
fn fitted(
    script: Script,
    asked: &garments::Read,
    scene: &mut Scene,
    label: &str,
) -> Result<(Script, Garment)> {
    let garment = asked.garment.clone();
    let layout = Layout::build(&garment, TAXELS, FULL_SCALE).map_err(|error| asked.error(&error))?;
    let circuit =
        Circuit::build(&garment, &layout, info(&garment).pins).map_err(|error| asked.error(&error))?;
    let lacking = sim::lacking(&script, &layout);
    if let (Some(largest), false) = (sim::largest(&layout), lacking.is_empty()) {
        let (name, lacking) = (&garment.name, lacking.join(", "));
        log::warn!(
            "{label}: the garment {name} has no panel {lacking}: what touches there touches {}.",
            largest.name
        );
    }
    let script = scripts::fit(script, &layout)?;
    for row in &mut scene.react {
        if let Some(line) = row.output.filter(|line| circuit.lines().contains(&line.pin)) {
            log::warn!(
                "{label}: the reaction {} drives no pin: GP{} is a line of the garment.",
                row.name,
                line.pin
            );
            row.output = None;
        }
    }
    Ok((script, garment))
}

/// End of the script, or later if more is awaited.
fn end_us(duration_s: f64, options: &SourceOptions) -> u64 {
    let seconds = duration_s.max(options.seconds.unwrap_or(0.0));
    // The caller stops at its number of frames; this limit is for scenes that send none.
    let frames = options.frames.map_or(0, |frames| 10_000_000 + frames.saturating_mul(100_000));
    ((seconds * 1e6) as u64).max(frames)
}

/// A simulated board for this garment: any pin may be a line or an output.
pub fn info(garment: &Garment) -> BoardInfo {
    let inputs =
        garment.blocks.iter().fold(0, |mask, b| mask | 1u64.checked_shl(b.input.into()).unwrap_or(0));
    BoardInfo {
        firmware: SIMULATED,
        chip: "",
        pins: Pins { outputs: !inputs, inputs, ..Pins::ANY },
        full_scale: FULL_SCALE,
        link_bytes_per_s: LINK,
    }
}

impl Playing {
    /// A board as after power-up.
    fn board(&self) -> Result<Shipped> {
        let mut board = Shipped::new(info(&self.garment), self.garment.clone(), self.scene.clone())?;
        board.recall_table(TableKind::Surface, self.surface);
        board.recall_table(TableKind::Folds, self.folds);
        board.booted(Boot::default());
        Ok(board)
    }

    /// Restarts the board from its stored settings.
    fn restart(&self, board: &mut Shipped, flash: &mut SimFlash) -> Result<()> {
        *board = self.board()?;
        let found = Store::new(&mut *flash, 0..SimFlash::BYTES).and_then(|mut store| store.load(board));
        let found = found.map_err(Error::other)?;
        for kind in TableKind::USED.iter().copied() {
            let table = tables(flash, kind).and_then(|mut tables| tables.in_force());
            if let Some(table) = table.map_err(Error::other)? {
                board.recall_table(kind, Some(lasting(bytes_of(flash, table))));
            }
        }
        let aside = if found == Found::Aside { Aside::Request } else { Aside::No };
        board.booted(Boot { cause: BootCause::Request, resets: 0, aside });
        Ok(())
    }

    /// Runs the board until it is lost, or the script that is played once has ended.
    async fn all(&self, board: &mut Shipped, link: BoardEnd) {
        let mut flash = SimFlash::new(tables_start(TableKind::Folds) + tables_bytes(TableKind::Folds));
        let mut posture = ScriptPosture::new(&self.scene);
        let idle = self.script.untouched();
        let script = if self.rounds == Rounds::Later { &idle } else { &self.script };
        let mut now = Micros(0);
        // The inputs have been checked, so the board is built again after each restart.
        while let Ok(simulated) = SimBoard::new(&self.garment, script, self.seed) {
            let SimBoard { mut lines, delay, adc, clock, hand } = simulated;
            let pace = Pacing::new(&link, clock.clone(), self.realtime);
            let mut platform = Virtual {
                clock: clock.clone(),
                end: Micros(self.end_us),
                link: &link,
                flash: &mut flash,
                restarts: false,
                pace: &pace,
            };
            let mut scan = Paced::new(SimScan::new(&mut lines, delay, adc, clock.clone()), &pace);
            posture.begin(&script.joints);
            let touching = Touching::new(&self.hand, hand, &self.script, self.rounds);
            let mut end = PosturesEnd::new(&link, &mut posture, touching, clock.clone());
            run(&mut scan, &mut end, &mut platform, board).await;
            now = clock.now();
            if !platform.restarts || self.restart(board, &mut flash).is_err() {
                break;
            }
            // Both its clock and the script restart.
            posture.follow(&board.setup().scene);
        }
        // Messages of the last frame.
        loop {
            let count = (&link).try_write(board.pending(now, &mut ()));
            board.sent(count);
            if count == 0 {
                return;
            }
            yielded().await;
        }
    }
}

/// Returns where the tables of a kind lie in the simulated flash: after the settings.
const fn tables_start(kind: TableKind) -> u32 {
    match kind {
        TableKind::Surface => SimFlash::BYTES,
        TableKind::Folds => SimFlash::BYTES + tables_bytes(TableKind::Surface),
    }
}

fn tables(flash: &mut SimFlash, kind: TableKind) -> std::result::Result<Tables<&mut SimFlash>, StoreError> {
    Tables::new(flash, tables_start(kind), kind)
}

/// A table that a board refers to from now on. It stays until the program ends, as flash
/// would.
pub fn lasting(table: &[u8]) -> &'static [u8] {
    Box::leak(table.into())
}

fn bytes_of(flash: &SimFlash, table: Range<u32>) -> &[u8] {
    flash.bytes().get(table.start as usize..table.end as usize).unwrap_or(&[])
}

/// The simulated board apart from its pins.
struct Virtual<'a> {
    clock: SimClock,
    end: Micros,
    link: &'a BoardEnd,
    /// Keeps saved settings as long as the simulation runs.
    flash: &'a mut SimFlash,
    /// The board is to restart.
    restarts: bool,
    pace: &'a Pacing<'a>,
}

impl Clock for Virtual<'_> {
    fn now(&self) -> Micros {
        self.clock.now()
    }
}

impl Probe for Virtual<'_> {
    fn begin(&mut self, _: Stage) {}
}

impl Checksum for Virtual<'_> {}

impl Platform for Virtual<'_> {
    fn alive(&mut self) -> bool {
        self.now() < self.end && !self.link.is_alone() && !self.restarts
    }

    fn save(&mut self, settings: &Settings<'_>) -> Result<Saved, &'static str> {
        let mut store = Store::new(&mut *self.flash, 0..SimFlash::BYTES).map_err(StoreError::sentence)?;
        store.save(settings).map_err(StoreError::sentence)
    }

    fn reset_settings(&mut self, undo: bool) -> Result<Saved, &'static str> {
        let mut store = Store::new(&mut *self.flash, 0..SimFlash::BYTES).map_err(StoreError::sentence)?;
        store.put_aside(!undo).map_err(StoreError::sentence)
    }

    fn store_table(&mut self, piece: &PieceToStore<'_>) -> Result<Option<&'static [u8]>, &'static str> {
        let tables = tables(self.flash, piece.kind);
        let table = tables.and_then(|mut tables| tables.store(piece)).map_err(StoreError::sentence)?;
        let is_whole = piece.offset as usize + piece.bytes.len() == piece.length as usize;
        Ok(is_whole.then(|| lasting(bytes_of(self.flash, table))))
    }

    fn keep_table(&mut self, kind: TableKind, length: u32) -> Result<(), &'static str> {
        let tables = tables(self.flash, kind);
        tables.and_then(|mut tables| tables.keep(length)).map_err(StoreError::sentence)
    }

    fn restart(&mut self) {
        self.restarts = true;
    }

    async fn idle(&mut self, until: Micros) {
        self.pace.wait().await;
        let next = until.0.min(self.now().0 + 1000);
        self.clock.advance_to(next);
    }
}
