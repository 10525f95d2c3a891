//! The brown-out threshold: below it the chip resets itself. At a lower voltage the processor might write
//! garbage into the flash.

use rp_pac::VREG_AND_CHIP_RESET;

/// 0.946 V of 1.1 V, the highest step that leaves room for the regulator's 3 % and the comparator's own error
/// (RP2040 datasheet, 2.10.6); the chip starts with 0.86 V.
const THRESHOLD: u8 = 0b1011;

/// Raises the threshold of the brown-out detector.
pub fn watch() {
    VREG_AND_CHIP_RESET.bod().modify(|bod| {
        bod.set_vsel(THRESHOLD);
        bod.set_en(true);
    });
}
