//! The reflex: the interrupt at the end of a sub-field checks its codes and asserts pins; the loop tells what
//! is watched.

use core::cell::RefCell;
use embassy_sync::blocking_mutex::{Mutex, raw::CriticalSectionRawMutex};
use rp_pac::SIO;
use taxel_core::acquire::{Fields, Read};
use taxel_core::format::{Code, Micros};
use taxel_core::reflex::{Early, Reflex, Reflexes};

static REFLEX: Mutex<CriticalSectionRawMutex, RefCell<Reflex<{ crate::TAXELS }>>> =
    Mutex::new(RefCell::new(Reflex::new()));

/// With the interrupts off: for some 100 cycles, or 3,000 where a sub-field is checked.
fn with<T>(act: impl FnOnce(&mut Reflex<{ crate::TAXELS }>) -> T) -> T {
    REFLEX.lock(|reflex| act(&mut reflex.borrow_mut()))
}

/// As [`Reflex::begin`]. The chain stands still.
pub fn begin(fields: &Fields, falling: bool) {
    with(|reflex| reflex.begin(fields.clone(), falling));
}

/// As [`Reflex::order`].
pub fn order(field: usize, address: usize, taxels: Read) {
    with(|reflex| reflex.order(field, address, taxels));
}

/// As [`Reflex::watch`].
pub fn watch(reflexes: Option<&Reflexes>, active: u8, limit: impl Fn(u16) -> Option<u16>) {
    with(|reflex| reflex.watch(reflexes, active, limit));
}

/// As [`Reflex::told`].
pub fn told() -> Option<Early> {
    with(Reflex::told)
}

/// As [`Reflex::driven`].
pub fn driven(pin: u8, level: bool) {
    with(|reflex| reflex.driven(pin, level));
}

/// As [`Reflex::check`], of codes that lie in the order of the whole scan; asserts the pins of what begins.
pub fn check(field: usize, codes: &[Code], frame: &mut [Code], now: Micros) {
    with(|reflex| {
        let codes = codes.get(reflex.fields().span(field)).unwrap_or(&[]);
        let begun = reflex.check(field, codes, frame, now);
        for (pin, level) in reflex.pins(begun) {
            // The pin has been an output since the scene put it to rest.
            let (out, bit) = (SIO.gpio_out(0), 1 << (pin & 31));
            if level { out.value_set().write_value(bit) } else { out.value_clr().write_value(bit) }
        }
    });
}
