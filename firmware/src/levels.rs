//! The outputs before the program: each stands at its fault level as soon as the first instructions run, as
//! kept in the flash.
//!
//! Memory is cleared only after that: at the 6 MHz of a chip that has just started it takes some 60 ms.
//! embassy-rp has its own function there, which resets the levels of all pins; the linker (`--wrap`,
//! build.rs) lets this one go around it. When the clocks start, embassy-rp resets the pads once more, and
//! they are driven again as soon as that is over.

use crate::store::LEVELS;
use core::ptr;
use rp_pac::io::vals::Gpio0ctrlFuncsel;
use rp_pac::{IO_BANK0, PADS_BANK0, RESETS, SIO};
use taxel_core::react::Levels;
use taxel_store::{Record, in_force};

/// Where the flash begins in memory.
const FLASH: usize = 0x1000_0000;
/// The pins of the chip.
const PINS: usize = 30;

#[allow(unsafe_code)] // SAFETY: embassy-rp's function for the same place, by the name that the linker gives it
unsafe extern "C" {
    #[link_name = "__real___pre_init"]
    fn pre_init_of_embassy();
}

/// Runs first, on the stack alone: no memory has been set yet.
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

/// Drives the pins that the flash names to the levels that it names.
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

/// A record of the flash, read through its memory map.
fn record(offset: u32) -> Record {
    let first = ptr::with_exposed_provenance::<Record>(FLASH + offset as usize);
    #[allow(unsafe_code)]
    // SAFETY: the place is one of the flash, whole words, which nothing writes now
    unsafe {
        ptr::read_volatile(first)
    }
}
