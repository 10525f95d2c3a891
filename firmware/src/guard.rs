//! Stack guard. The memory ends below the stack, and the memory protection unit turns every access there into
//! a fault, whatever the chip's bus does with such an address. The stack then has no room for the exception
//! frame either, so the processor locks up, and the watchdog restarts the board.

use cortex_m::peripheral::MPU;

/// Start of the guarded region, which ends where the memory begins: memory.x puts the stack there.
const GUARDED: u32 = 0x1fff_0000;
/// A region of 2^(15 + 1) bytes without access and without execution.
const REGION: u32 = 1 << 28 | 15 << 1 | 1;
/// Selects region 0 by its number.
const BY_NUMBER: u32 = 1 << 4;
/// Enables the unit; addresses outside the region keep their default attributes.
const ON: u32 = 1 << 2 | 1;

/// Enables the guard.
pub fn put_up() {
    #[allow(unsafe_code)]
    // SAFETY: nothing else uses the unit, and no code or data of the program lie in the region.
    unsafe {
        let mpu = &*MPU::PTR;
        mpu.rbar.write(GUARDED | BY_NUMBER);
        mpu.rasr.write(REGION);
        mpu.ctrl.write(ON);
    }
    cortex_m::asm::dsb();
    cortex_m::asm::isb();
}
