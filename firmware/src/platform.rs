//! The board's clock, settling delay, watchdog, heartbeat, stored settings, checksums and marks.

use crate::led::Led;
use crate::mark::mark;
use crate::remains::Scratch;
use crate::sniffer::Sniffer;
use crate::store::{FedFlash, Flash, in_place};
use crate::watchdog::WATCHDOG;
use embassy_rp::{clocks, watchdog::Watchdog};
use embassy_time::Instant;
use embedded_hal::delay::DelayNs;
use rp_pac::watchdog::regs::Load;
use taxel_core::{
    acquire::{Clock, WATCHDOG_MS},
    board::{PieceToStore, Saved, Settings, Shipped, TableKind},
    boot::{Aside, Boots},
    format::Micros,
    pipeline::{Probe, Stage},
    react::Levels,
    run::Platform,
    wire::Checksum,
};
use taxel_store::{Found, StoreError};

/// Time between two toggles of the LED, as long as the loop runs.
const HEARTBEAT_US: u64 = 500_000;

/// Longest pause of the loop; bytes from the host wait in their ring meanwhile.
const LONGEST_PAUSE_US: u64 = 1_000;

/// Number of saves granted to a board that starts with the shipped settings and does not know its earlier
/// saves.
const UNKNOWN_SAVES: u8 = 1;

/// Time since the board started, from the 1 MHz timer.
#[derive(Debug, Clone, Copy)]
pub struct Timer;

impl Clock for Timer {
    #[inline]
    fn now(&self) -> Micros {
        Micros(Instant::now().as_micros())
    }

    /// Feeds the watchdog. Called only after a step of work, never by a timer or an interrupt.
    #[inline]
    fn progressed(&self) {
        // The counter decrements twice per microsecond (RP2040-E1).
        rp_pac::WATCHDOG.load().write_value(Load(2_000 * WATCHDOG_MS));
    }
}

/// Waits by counting instructions: the timer's microseconds are too coarse for the settling of a multiplexer,
/// and a wait that ends up to 1 us early would read the wrong taxel.
#[derive(Debug, Clone, Copy)]
pub struct Settle {
    /// Rounds of the waiting loop per nanosecond, in units of 2^-16.
    rounds_per_ns: u32,
}

impl Settle {
    /// Number of cycles of a round: a subtraction and a taken branch.
    const CYCLES_PER_ROUND: u32 = 3;

    /// Longest wait that is computed in one piece, for clocks up to 190 MHz.
    const PIECE_NS: u32 = 1_000_000;

    /// Delay for the present system clock.
    pub fn new() -> Settle {
        let scaled = u64::from(clocks::clk_sys_freq()) << 16;
        let per_ns = scaled.div_ceil(1_000_000_000 * u64::from(Self::CYCLES_PER_ROUND));
        Settle { rounds_per_ns: per_ns as u32 }
    }

    fn wait(&self, ns: u32) {
        // Without a division: an M0+ has none, and one in software takes 2 us. `delay` does one round more
        // than requested, which makes up for the rounding.
        cortex_m::asm::delay((ns * self.rounds_per_ns) >> 16);
    }
}

impl DelayNs for Settle {
    #[inline]
    fn delay_ns(&mut self, mut ns: u32) {
        while ns > Self::PIECE_NS {
            self.wait(Self::PIECE_NS);
            ns -= Self::PIECE_NS;
        }
        if ns > 0 {
            self.wait(ns);
        }
    }
}

/// The parts of the board other than pins, converter and link.
pub struct BoardPlatform {
    watchdog: Watchdog,
    flash: Flash,
    led: Led,
    led_due: Micros,
    sniffer: Sniffer,
    boots: Boots<Scratch>,
}

impl BoardPlatform {
    /// Starts the watchdog.
    pub fn start(mut watchdog: Watchdog, led: Led, flash: Flash, sniffer: Sniffer) -> BoardPlatform {
        let boots = Boots::begin(Scratch, led.was_grounded());
        watchdog.pause_on_debug(true);
        watchdog.start(WATCHDOG);
        BoardPlatform { watchdog, flash, led, led_due: Micros(0), sniffer, boots }
    }

    /// Stores the levels of outputs for the next start, beside the settings.
    fn keep_levels(&mut self, levels: Levels, saved: Saved) -> Result<Saved, StoreError> {
        let mut flash = FedFlash { flash: &mut self.flash, watchdog: &mut self.watchdog };
        Ok(match flash.keep_levels(levels)? {
            Saved::Written => Saved::Written,
            Saved::Unchanged => saved,
        })
    }

    /// Restores the stored settings, unless they are set aside; then the flash is not even read. Call before
    /// the board has begun. Out of line: its stack is needed only here.
    #[inline(never)]
    pub fn recall(&mut self, board: &mut Shipped) {
        let uses_stored = self.boots.boot().aside == Aside::No;
        if let Some(saves) = self.boots.saves().or((!uses_stored).then_some(UNKNOWN_SAVES)) {
            board.resume_saving(saves);
        }
        if uses_stored {
            let flash = FedFlash { flash: &mut self.flash, watchdog: &mut self.watchdog };
            match flash.store().and_then(|mut store| store.load(board)) {
                Ok(Found::Aside) => self.boots.put_aside(),
                Ok(Found::Nothing | Found::Settings) => {}
                Err(error) => {
                    defmt::error!("stored settings: {}", error.sentence());
                    board.forgot(error);
                }
            }
        }
        for kind in TableKind::USED.iter().copied() {
            if uses_stored {
                let flash = FedFlash { flash: &mut self.flash, watchdog: &mut self.watchdog };
                let table = flash.tables(kind).and_then(|mut tables| tables.in_force()).ok().flatten();
                board.recall_table(kind, table.map(in_place));
            }
        }
        board.booted(self.boots.boot());
    }
}

impl Clock for BoardPlatform {
    #[inline]
    fn now(&self) -> Micros {
        Timer.now()
    }
}

impl Probe for BoardPlatform {
    #[inline]
    fn begin(&mut self, stage: Stage) {
        mark(stage as u32);
    }
}

impl Checksum for BoardPlatform {
    fn crc32(&mut self, bytes: &[u8]) -> u32 {
        self.sniffer.crc32(bytes)
    }
}

impl Platform for BoardPlatform {
    fn alive(&mut self) -> bool {
        self.watchdog.feed(WATCHDOG);
        let now = self.now();
        self.boots.alive(now);
        if now >= self.led_due {
            self.led.toggle();
            self.led_due = Micros(now.0.saturating_add(HEARTBEAT_US));
        }
        true
    }

    #[inline(never)]
    fn save(&mut self, settings: &Settings<'_>) -> Result<Saved, &'static str> {
        // Before it begins: the save itself may never end.
        self.boots.charge(settings.saves);
        let flash = FedFlash { flash: &mut self.flash, watchdog: &mut self.watchdog };
        let saved = flash.store().and_then(|mut store| store.save(settings));
        let saved = saved.and_then(|saved| self.keep_levels(Levels::of(&settings.scene.react), saved));
        if saved.is_ok() {
            self.boots.saved();
        }
        if saved == Ok(Saved::Unchanged) {
            self.boots.charge(settings.saves.saturating_add(1));
        }
        saved.map_err(StoreError::sentence)
    }

    #[inline(never)]
    fn reset_settings(&mut self, undo: bool) -> Result<Saved, &'static str> {
        let flash = FedFlash { flash: &mut self.flash, watchdog: &mut self.watchdog };
        flash.store().and_then(|mut store| store.put_aside(!undo)).map_err(StoreError::sentence)
    }

    #[inline(never)]
    fn store_table(&mut self, piece: &PieceToStore<'_>) -> Result<Option<&'static [u8]>, &'static str> {
        if piece.offset == 0 {
            self.boots.charge(piece.saves);
        }
        let flash = FedFlash { flash: &mut self.flash, watchdog: &mut self.watchdog };
        let table = flash
            .tables(piece.kind)
            .and_then(|mut tables| tables.store(piece))
            .map_err(StoreError::sentence)?;
        let is_whole = piece.offset as usize + piece.bytes.len() == piece.length as usize;
        Ok(is_whole.then(|| in_place(table)))
    }

    #[inline(never)]
    fn keep_table(&mut self, kind: TableKind, length: u32) -> Result<(), &'static str> {
        let flash = FedFlash { flash: &mut self.flash, watchdog: &mut self.watchdog };
        flash.tables(kind).and_then(|mut tables| tables.keep(length)).map_err(StoreError::sentence)
    }

    fn restart(&mut self) {
        self.boots.asked();
        self.watchdog.trigger_reset();
    }

    async fn idle(&mut self, until: Micros) {
        let pause = until.since(self.now()).min(LONGEST_PAUSE_US);
        embassy_time::Timer::after_micros(pause).await;
    }
}
