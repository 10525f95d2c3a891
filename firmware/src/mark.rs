//! Marks for the emulator: it watches one word of memory and sums the cycles between two marks by stage, and another and
//! compares the frame that it names with what the garment showed. On a board a mark is a store.

use core::sync::atomic::{AtomicU32, Ordering};
use taxel_core::format::Code;

// The emulator finds the words by their names.
#[allow(unsafe_code)] // SAFETY: no other symbol has this name
#[unsafe(no_mangle)]
static TAXEL_MARK: AtomicU32 = AtomicU32::new(0);

#[allow(unsafe_code)] // SAFETY: no other symbol has this name
#[unsafe(no_mangle)]
static TAXEL_LENT: AtomicU32 = AtomicU32::new(0);

/// Says that the stage of this number begins.
#[inline]
pub fn mark(stage: u32) {
    TAXEL_MARK.store(stage, Ordering::Relaxed);
}

/// Says that these codes are complete and about to be perceived.
#[inline]
pub fn lent(codes: &[Code]) {
    TAXEL_LENT.store(codes.as_ptr() as u32, Ordering::Relaxed);
}
