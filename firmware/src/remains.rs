//! State that survives a reset: a scratch register of the watchdog, which only power loss and the reset pin
//! clear. The boot ROM uses the upper four registers; this is the first.

use rp_pac::{VREG_AND_CHIP_RESET, WATCHDOG};
use taxel_core::boot::{Remains, Reset};

/// The scratch register, and the cause of the reset.
#[derive(Debug, Clone, Copy)]
pub struct Scratch;

impl Remains for Scratch {
    fn reset(&self) -> Reset {
        // A reset of the whole chip clears the watchdog's reasons.
        let reason = WATCHDOG.reason().read();
        let chip = VREG_AND_CHIP_RESET.chip_reset().read();
        if reason.force() {
            Reset::Program
        } else if reason.timer() {
            Reset::Watchdog
        } else if chip.had_run() {
            Reset::Pin
        } else if chip.had_por() {
            Reset::Power
        } else {
            Reset::Other
        }
    }

    fn word(&self) -> u32 {
        WATCHDOG.scratch0().read()
    }

    fn keep(&mut self, word: u32) {
        WATCHDOG.scratch0().write(|register| *register = word);
    }
}
