//! Marks for the emulator, which watches one word of memory and sums up the cycles between two marks by
//! stage. On a board a mark is a store.

use core::sync::atomic::{AtomicU32, Ordering};

// The emulator finds the word by its name.
#[allow(unsafe_code)] // SAFETY: no other symbol has this name
#[unsafe(no_mangle)]
static TAXEL_MARK: AtomicU32 = AtomicU32::new(0);

/// Marks the beginning of the stage of this number.
#[inline]
pub fn mark(stage: u32) {
    TAXEL_MARK.store(stage, Ordering::Relaxed);
}
