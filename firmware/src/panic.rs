//! Panic handler: logs, then restarts the board, so that a garment does not stay silent until a reset.

use crate::remains::Scratch;
use core::panic::PanicInfo;
use embassy_rp::{peripherals::WATCHDOG, watchdog::Watchdog};
use taxel_core::boot::{Remains, panicked};

#[panic_handler]
fn panic(info: &PanicInfo) -> ! {
    cortex_m::interrupt::disable();
    // First: if the rest hangs, the watchdog restarts the board, and the cause is known.
    Scratch.keep(panicked(Scratch.word()));
    defmt::error!("{}", defmt::Display2Format(info));
    #[allow(unsafe_code)]
    // SAFETY: interrupts are off and this function never returns, so no other owner of the watchdog runs
    // again.
    let watchdog = unsafe { WATCHDOG::steal() };
    Watchdog::new(watchdog).trigger_reset();
    loop {
        cortex_m::asm::nop();
    }
}
