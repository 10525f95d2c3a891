//! State kept from start to start.

use super::kept::{Ending, Kept};
use super::{Aside, Boot, BootCause, Remains, Reset};
use crate::format::Micros;

/// Resets by watchdog or panic after which the board starts with the shipped settings.
pub const RESETS: u8 = 3;

/// Time after which a reset is not blamed on the stored settings, so that the count begins again, us.
pub const LIFE_US: u64 = 60_000_000;

/// The present run of the board, and the state kept for the next start.
#[derive(Debug)]
pub struct Boots<R> {
    remains: R,
    kept: Kept,
    boot: Boot,
    lived: bool,
}

impl<R: Remains> Boots<R> {
    /// Records the start of the board. `grounded`: a pin asks for the shipped settings.
    pub fn begin(remains: R, grounded: bool) -> Boots<R> {
        let reset = remains.reset();
        let by_watchdog = matches!(reset, Reset::Watchdog | Reset::Program);
        let before = Kept::read(remains.word()).filter(|_| by_watchdog);
        let cause = match (reset, before.map(|kept| kept.ending)) {
            (Reset::Power, _) => BootCause::Power,
            (Reset::Pin, _) => BootCause::Pin,
            (_, Some(Ending::Panic)) => BootCause::Panic,
            (Reset::Watchdog, Some(_)) => BootCause::Watchdog,
            (Reset::Program, Some(Ending::Request)) => BootCause::Request,
            // The boot loader ends by the watchdog, too, and leaves no word of ours.
            _ => BootCause::Other,
        };
        let mut kept = Kept { ending: Ending::Running, ..before.unwrap_or_default() };
        kept.resets = match cause {
            BootCause::Watchdog | BootCause::Panic => kept.resets.saturating_add(1),
            _ => 0,
        };
        // A request for a restart has already decided about the settings.
        kept.aside = cause != BootCause::Request && (kept.aside || kept.resets >= RESETS);
        let aside = match (grounded, kept.aside) {
            (true, _) => Aside::Pin,
            (false, true) => Aside::Resets,
            (false, false) => Aside::No,
        };
        let boot = Boot { cause, resets: kept.resets, aside };
        let mut boots = Boots { remains, kept, boot, lived: false };
        boots.keep();
        boots
    }

    fn keep(&mut self) {
        self.remains.keep(self.kept.word());
    }

    /// Returns how the board started.
    pub fn boot(&self) -> Boot {
        self.boot
    }

    /// Records that the flash keeps the stored settings out of use, as a host has requested.
    pub fn put_aside(&mut self) {
        self.boot.aside = Aside::Request;
    }

    /// Saves that were left before the reset; none after a power-up.
    pub fn saves(&self) -> Option<u8> {
        self.kept.saves
    }

    /// Called once per round of the loop.
    pub fn alive(&mut self, now: Micros) {
        if !self.lived && now.0 >= LIFE_US {
            self.lived = true;
            self.kept.resets = 0;
            self.keep();
        }
    }

    /// Stores the number of saves left, for a reset.
    pub fn charge(&mut self, saves: u8) {
        self.kept.saves = Some(saves);
        self.keep();
    }

    /// Records that settings were stored, which the next start uses.
    pub fn saved(&mut self) {
        self.kept.aside = false;
        self.keep();
    }

    /// Records that the next reset is requested by a host.
    pub fn asked(&mut self) {
        self.kept.ending = Ending::Request;
        self.keep();
    }
}

#[cfg(test)]
mod tests {
    extern crate std;

    use super::super::panicked;
    use super::*;
    use std::cell::Cell;
    use std::vec::Vec;

    /// A board with simulated resets.
    struct Played(Cell<u32>);

    impl Remains for (&Played, Reset) {
        fn reset(&self) -> Reset {
            self.1
        }

        fn word(&self) -> u32 {
            self.0.0.get()
        }

        fn keep(&mut self, word: u32) {
            self.0.0.set(word);
        }
    }

    const MINUTE: Micros = Micros(LIFE_US);

    #[test]
    fn three_resets_without_a_minute_of_life_lead_to_what_ships_until_the_power_goes() {
        let board = Played(Cell::new(0xdead_beef));
        let start = |reset| Boots::begin((&board, reset), false);
        assert_eq!(start(Reset::Power).boot(), Boot::default());
        let boots: Vec<Boot> = (0..4).map(|_| start(Reset::Watchdog).boot()).collect();
        let of = |resets, aside| Boot { cause: BootCause::Watchdog, resets, aside };
        assert_eq!(boots, [of(1, Aside::No), of(2, Aside::No), of(3, Aside::Resets), of(4, Aside::Resets)]);
        // A minute with the shipped settings is no evidence about the stored ones.
        start(Reset::Watchdog).alive(MINUTE);
        assert_eq!(start(Reset::Watchdog).boot(), of(1, Aside::Resets));
        assert_eq!(start(Reset::Power).boot(), Boot::default());
        assert_eq!(start(Reset::Watchdog).boot(), of(1, Aside::No));
    }

    #[test]
    fn a_minute_of_life_begins_the_count_anew() {
        let board = Played(Cell::new(0));
        let start = |reset| Boots::begin((&board, reset), false);
        start(Reset::Power);
        for _ in 0..100 {
            assert_eq!(start(Reset::Watchdog).boot().resets, 1);
            let mut boots = start(Reset::Watchdog);
            assert_eq!((boots.boot().resets, boots.boot().aside), (2, Aside::No));
            boots.alive(Micros(LIFE_US - 1));
            boots.alive(MINUTE);
            // Only the first minute counts: later rounds of that run change nothing.
            boots.alive(Micros(2 * LIFE_US));
        }
        start(Reset::Watchdog).alive(Micros(LIFE_US - 1));
        assert_eq!(start(Reset::Watchdog).boot().resets, 2);
    }

    #[test]
    fn panics_count_as_the_watchdog_does_and_are_distinguished() {
        let board = Played(Cell::new(0));
        let start = |reset| Boots::begin((&board, reset), false).boot();
        start(Reset::Power);
        let panic = || {
            board.0.set(panicked(board.0.get()));
            // The watchdog may fire while the panic is being logged.
            [Reset::Program, Reset::Watchdog]
        };
        assert_eq!(start(panic()[0]), Boot { cause: BootCause::Panic, resets: 1, aside: Aside::No });
        assert_eq!(start(panic()[1]), Boot { cause: BootCause::Panic, resets: 2, aside: Aside::No });
        assert_eq!(
            start(Reset::Watchdog),
            Boot { cause: BootCause::Watchdog, resets: 3, aside: Aside::Resets }
        );
    }

    #[test]
    fn what_is_no_fault_of_the_board_counts_nothing() {
        let board = Played(Cell::new(0));
        let start = |reset| Boots::begin((&board, reset), false);
        for _ in 0..10 {
            assert_eq!(start(Reset::Pin).boot().cause, BootCause::Pin);
            start(Reset::Power).asked();
            assert_eq!(start(Reset::Program).boot(), Boot { cause: BootCause::Request, ..Boot::default() });
            // The boot loader resets by the watchdog and leaves no word of ours.
            board.0.set(0);
            assert_eq!(start(Reset::Watchdog).boot(), Boot { cause: BootCause::Other, ..Boot::default() });
            assert_eq!(start(Reset::Program).boot().cause, BootCause::Other);
            assert_eq!(start(Reset::Other).boot(), Boot { cause: BootCause::Other, ..Boot::default() });
        }
        start(Reset::Power);
        assert_eq!(start(Reset::Watchdog).boot().resets, 1);
        start(Reset::Other);
        assert_eq!(start(Reset::Watchdog).boot().resets, 1);
    }

    #[test]
    fn a_save_or_a_request_ends_what_resets_began_and_a_grounded_pin_holds_for_one_start() {
        let board = Played(Cell::new(0));
        let start = |reset, grounded| Boots::begin((&board, reset), grounded);
        let beaten = || {
            start(Reset::Power, false);
            for _ in 0..3 {
                start(Reset::Watchdog, false);
            }
        };
        beaten();
        assert_eq!(start(Reset::Watchdog, false).boot().aside, Aside::Resets);
        start(Reset::Watchdog, false).saved();
        // The count stays: if the new settings are no better, the next reset acts on it.
        assert_eq!(start(Reset::Watchdog, false).boot().aside, Aside::Resets);
        beaten();
        let mut boots = start(Reset::Watchdog, false);
        boots.alive(MINUTE);
        boots.saved();
        assert_eq!(start(Reset::Watchdog, false).boot().aside, Aside::No);
        beaten();
        start(Reset::Watchdog, false).asked();
        let boot = Boot { cause: BootCause::Request, ..Boot::default() };
        assert_eq!(start(Reset::Program, false).boot(), boot);
        assert_eq!(start(Reset::Power, true).boot().aside, Aside::Pin);
        assert_eq!(start(Reset::Power, false).boot().aside, Aside::No);
    }

    #[test]
    fn the_saves_that_are_left_outlast_every_reset_but_that_of_the_power() {
        let board = Played(Cell::new(0));
        let start = |reset| Boots::begin((&board, reset), false);
        assert_eq!(start(Reset::Power).saves(), None);
        start(Reset::Power).charge(4);
        for _ in 0..5 {
            assert_eq!(start(Reset::Watchdog).saves(), Some(4));
            board.0.set(panicked(board.0.get()));
            assert_eq!(start(Reset::Program).saves(), Some(4));
        }
        assert_eq!(start(Reset::Pin).saves(), None);
    }
}
