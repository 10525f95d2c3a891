//! What lies below the stack may not be touched: memory ends there, and the memory protection unit makes a
//! fault of every access for certain, whatever the chip's bus does with such an address. The stack can then
//! not even push what an exception needs, the processor locks up, and the watchdog restarts the board.

use cortex_m::peripheral::MPU;

/// The end of the memory: memory.x puts the stack at its beginning.
const GUARDED: u32 = 0x1fff_0000;
/// A region of 2^(15 + 1) bytes; its attributes allow no access, and no execution.
const REGION: u32 = 1 << 28 | 15 << 1 | 1;
/// Region 0 by number.
const BY_NUMBER: u32 = 1 << 4;
/// All that no region covers stays as it is; the unit is on.
const ON: u32 = 1 << 2 | 1;

/// Puts the guard up.
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
