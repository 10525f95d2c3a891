//! The reflex: the interrupt at the end of a sub-field checks its codes and asserts pins; the main loop sets
//! what it watches.

use core::cell::RefCell;
use embassy_sync::blocking_mutex::{Mutex, raw::CriticalSectionRawMutex};
use rp_pac::SIO;
use taxel_core::acquire::{Fields, Read, Reflex};
use taxel_core::capacity::TAXELS;
use taxel_core::format::{Code, Micros};
use taxel_core::reflex::{Early, Reflexes};

/// Taxels that are checked: none in an image without reflexes.
const CHECKED: usize = if cfg!(feature = "reflex") { TAXELS } else { 0 };

static REFLEX: Mutex<CriticalSectionRawMutex, RefCell<Reflex<CHECKED>>> =
    Mutex::new(RefCell::new(Reflex::new()));

/// Runs `act` with interrupts off: for some 100 cycles, or 3,000 to check a sub-field.
fn with<T>(act: impl FnOnce(&mut Reflex<CHECKED>) -> T) -> T {
    REFLEX.lock(|reflex| act(&mut reflex.borrow_mut()))
}

/// Calls [`Reflex::begin`], while the chain stands still.
pub fn begin(fields: &Fields, falling: bool) {
    with(|reflex| reflex.begin(fields.clone(), falling));
}

/// Calls [`Reflex::order`].
pub fn order(field: usize, address: usize, taxels: Read) {
    with(|reflex| reflex.order(field, address, taxels));
}

/// Calls [`Reflex::watch`].
pub fn watch(reflexes: Option<&Reflexes>, active: u8, limit: impl Fn(u16) -> Option<u16>) {
    with(|reflex| reflex.watch(reflexes, active, limit));
}

/// Calls [`Reflex::take_early`].
pub fn take_early() -> Option<Early> {
    with(Reflex::take_early)
}

/// Calls [`Reflex::driven`].
pub fn driven(pin: u8, level: bool) {
    with(|reflex| reflex.driven(pin, level));
}

/// Calls [`Reflex::check`] with the codes in the order of the whole scan, and asserts the pins of reactions
/// that begin.
pub fn check(field: usize, codes: &[Code], frame: &mut [Code], now: Micros) {
    with(|reflex| {
        let codes = codes.get(reflex.fields().span(field)).unwrap_or(&[]);
        let begun = reflex.check(field, codes, frame, now);
        for (pin, level) in reflex.pins(begun) {
            // The pin is an output since the scene set it to its rest level.
            let (out, bit) = (SIO.gpio_out(0), 1 << (pin & 31));
            if level { out.value_set().write_value(bit) } else { out.value_clr().write_value(bit) }
        }
    });
}
