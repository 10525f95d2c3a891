//! The panic handler of examples that must not link if a panic is reachable.

use core::panic::PanicInfo;

unsafe extern "C" {
    /// The linker reports this name if a panic is reachable.
    fn a_panic_is_reachable() -> !;
}

#[panic_handler]
fn panic(_: &PanicInfo) -> ! {
    // SAFETY: no image that links calls it.
    unsafe { a_panic_is_reachable() }
}
