//! A panic is logged, then the board restarts: a garment must not fall silent until somebody presses a button.

use crate::remains::Scratch;
use core::panic::PanicInfo;
use embassy_rp::{peripherals::WATCHDOG, watchdog::Watchdog};
use taxel_core::boot::{Remains, panicked};

#[panic_handler]
fn panic(info: &PanicInfo) -> ! {
    cortex_m::interrupt::disable();
    // First of all: should the rest hang, the watchdog restarts the board, and this was the cause.
    Scratch.keep(panicked(Scratch.word()));
    defmt::error!("{}", defmt::Display2Format(info));
    #[allow(unsafe_code)]
    // SAFETY: interrupts are off and nothing returns from here, so no other owner of the watchdog runs again.
    let watchdog = unsafe { WATCHDOG::steal() };
    Watchdog::new(watchdog).trigger_reset();
    loop {
        cortex_m::asm::nop();
    }
}
