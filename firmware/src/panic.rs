//! A panic is logged, then the board restarts: a garment must not fall silent until somebody presses a button.

use core::panic::PanicInfo;
use embassy_rp::{peripherals::WATCHDOG, watchdog::Watchdog};

#[panic_handler]
fn panic(info: &PanicInfo) -> ! {
    cortex_m::interrupt::disable();
    defmt::error!("{}", defmt::Display2Format(info));
    #[allow(unsafe_code)]
    // SAFETY: interrupts are off and nothing returns from here, so no other owner of the watchdog runs again.
    let watchdog = unsafe { WATCHDOG::steal() };
    Watchdog::new(watchdog).trigger_reset();
    loop {
        cortex_m::asm::nop();
    }
}
