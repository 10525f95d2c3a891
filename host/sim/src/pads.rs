//! Electrical state of the pins: drivers, the board's pull resistors, and faults of the wires.

use taxel_core::acquire::Pull;
use taxel_core::selftest::{Fault, PinFault};

/// Pull resistor of a pin, kOhm.
const PULL_KOHM: f64 = 55.0;
/// Default source resistance of a converter's input, kOhm.
const SOURCE_KOHM: f64 = 1.0;

/// Drive of the board's pins, bit `n` for GPIO `n`.
#[derive(Debug, Default, Clone, Copy)]
pub(super) struct Drive {
    /// Driven.
    pub on: u64,
    /// Driven high, if driven.
    pub high: u64,
    /// Pulled to the supply.
    pub up: u64,
    /// Pulled to ground.
    pub down: u64,
}

impl Drive {
    /// Sets the pulls of the pins in a mask.
    pub fn pull(&mut self, mask: u64, pull: Pull) {
        self.up = self.up & !mask | if pull == Pull::Up { mask } else { 0 };
        self.down = self.down & !mask | if pull == Pull::Down { mask } else { 0 };
    }
}

/// Levels of all pins. A bridge is stronger than a resistor; if two outputs fight over one, the low one wins.
pub(super) fn levels(drive: Drive, faults: &[PinFault]) -> u64 {
    let mut levels = drive.on & drive.high | !drive.on & drive.up;
    for PinFault { pin, fault } in faults {
        let own = mask(*pin);
        match fault {
            Fault::StuckHigh => levels |= own,
            Fault::StuckLow => levels &= !own,
            Fault::Bridged(other) => {
                let both = own | mask(*other);
                let strong = if drive.on & both == 0 { both } else { drive.on & both };
                levels = if levels & strong == strong { levels | both } else { levels & !both };
            }
            Fault::Open | Fault::Grounded | Fault::Supplied => {}
        }
    }
    levels
}

/// Code of an input that a source drives to `settled`. `held`: last sampled code, which an undriven input
/// keeps.
pub(super) fn code(
    input: u8,
    drive: Drive,
    faults: &[PinFault],
    source_kohm: f64,
    settled: u16,
    held: u16,
) -> u16 {
    let pulled = match (drive.up & mask(input) != 0, drive.down & mask(input) != 0) {
        (true, _) => Some(super::FULL_SCALE),
        (false, true) => Some(0),
        (false, false) => None,
    };
    match faults.iter().find(|fault| fault.pin == input).map(|fault| fault.fault) {
        Some(Fault::Grounded) => return 0,
        Some(Fault::Supplied) => return super::FULL_SCALE,
        Some(Fault::Open) => return pulled.unwrap_or(held),
        _ => {}
    }
    let Some(end) = pulled else { return settled };
    let source = if source_kohm > 0.0 { source_kohm } else { SOURCE_KOHM };
    let (settled, end) = (f64::from(settled), f64::from(end));
    (settled + (end - settled) * source / (source + PULL_KOHM)).round() as u16
}

fn mask(pin: u8) -> u64 {
    1u64.checked_shl(pin.into()).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pins_show_what_drives_them_or_what_is_wrong_with_them() {
        let drive = Drive { on: 0b0011, high: 0b0001, up: 0b0100, down: 0b1000 };
        let with = |fault| levels(drive, &[fault]);
        assert_eq!(levels(drive, &[]), 0b0101);
        assert_eq!(with(PinFault { pin: 1, fault: Fault::StuckHigh }), 0b0111);
        assert_eq!(with(PinFault { pin: 0, fault: Fault::StuckLow }), 0b0100);
        assert_eq!(with(PinFault { pin: 0, fault: Fault::Bridged(3) }), 0b1101, "driven against a resistor");
        assert_eq!(with(PinFault { pin: 1, fault: Fault::Bridged(2) }), 0b0001);
        assert_eq!(with(PinFault { pin: 0, fault: Fault::Bridged(1) }), 0b0100, "ground wins");
    }

    #[test]
    fn a_resistor_moves_an_open_input_all_the_way_and_a_source_a_little() {
        let mut drive = Drive::default();
        let open = [PinFault { pin: 26, fault: Fault::Open }];
        assert_eq!(code(26, drive, &[], 0.0, 100, 7), 100);
        assert_eq!(code(26, drive, &open, 0.0, 100, 7), 7);
        drive.pull(1 << 26, Pull::Up);
        assert_eq!(code(26, drive, &[], 0.0, 100, 7), 171);
        assert_eq!(code(26, drive, &open, 0.0, 100, 7), 4095);
        drive.pull(1 << 26, Pull::Down);
        assert_eq!(code(26, drive, &[], 10.0, 100, 7), 85);
        assert_eq!(code(26, drive, &open, 0.0, 100, 7), 0);
    }
}
