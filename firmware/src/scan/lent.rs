//! Marks frames for the emulator, which watches one word of memory and compares the frame at that address
//! with the simulated garment. On a board this is a store.

use core::sync::atomic::{AtomicU32, Ordering};
use taxel_core::format::Code;

// The emulator finds the word by its name.
#[allow(unsafe_code)] // SAFETY: no other symbol has this name
#[unsafe(no_mangle)]
static TAXEL_LENT: AtomicU32 = AtomicU32::new(0);

/// Marks these codes as complete and about to be perceived.
#[inline]
pub fn mark(codes: &[Code]) {
    TAXEL_LENT.store(codes.as_ptr() as u32, Ordering::Relaxed);
}
