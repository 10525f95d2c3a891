//! Output levels before the program starts: each output gets its fault level, as stored in the flash, with
//! the first instructions.
//!
//! This runs before memory is cleared, which takes some 60 ms at the 6 MHz of a chip that has just started.
//! embassy-rp has a function of its own there, which resets the levels of all pins; the linker option
//! `--wrap` (build.rs) redirects the call to this one. When the clocks start, embassy-rp resets the pads once
//! more, and the outputs are driven again right after that.

use crate::store::LEVELS;
use core::ptr;
use rp_pac::io::vals::Gpio0ctrlFuncsel;
use rp_pac::{IO_BANK0, PADS_BANK0, RESETS, SIO};
use taxel_core::react::Levels;
use taxel_store::{Record, in_force};

/// Address of the flash in memory.
const FLASH: usize = 0x1000_0000;
/// Number of pins of the chip.
const PINS: usize = 30;

#[allow(unsafe_code)] // SAFETY: embassy-rp's own function, by the name that the linker gives it
unsafe extern "C" {
    #[link_name = "__real___pre_init"]
    fn pre_init_of_embassy();
}

/// The first function that runs. It uses only the stack: no memory is initialised yet.
#[allow(unsafe_code)] // SAFETY: no other symbol has this name; nothing here or there reads or writes a static
#[unsafe(export_name = "__wrap___pre_init")]
unsafe extern "C" fn pre_init() {
    unsafe { pre_init_of_embassy() };
    RESETS.reset().modify(|resets| {
        resets.set_io_bank0(false);
        resets.set_pads_bank0(false);
    });
    while !RESETS.reset_done().read().io_bank0() || !RESETS.reset_done().read().pads_bank0() {}
    drive();
}

/// Drives the pins to the levels that are stored in the flash.
pub fn drive() {
    let Some(Levels { pins, high }) = in_force(LEVELS.map(record)) else { return };
    let (out, enable) = (SIO.gpio_out(0), SIO.gpio_oe(0));
    out.value_set().write_value(pins & high);
    out.value_clr().write_value(pins & !high);
    enable.value_set().write_value(pins);
    for pin in (0..PINS).filter(|pin| pins >> pin & 1 != 0) {
        PADS_BANK0.gpio(pin).modify(|pad| pad.set_od(false));
        IO_BANK0.gpio(pin).ctrl().write(|ctrl| ctrl.set_funcsel(Gpio0ctrlFuncsel::SIO_0 as u8));
    }
}

/// Reads a record of the flash through the memory map.
fn record(offset: u32) -> Record {
    let first = ptr::with_exposed_provenance::<Record>(FLASH + offset as usize);
    #[allow(unsafe_code)]
    // SAFETY: the address lies in the flash, is aligned to words, and nothing writes there now
    unsafe {
        ptr::read_volatile(first)
    }
}
