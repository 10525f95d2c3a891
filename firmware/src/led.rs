//! The heartbeat, on a pin that somebody may ground at the start.

use embassy_rp::gpio::{Drive, Flex};

/// Time for the pin's level to follow, cycles: some 10 us.
const FOLLOWED: u32 = 1250;

/// The LED.
pub struct Led {
    pin: Flex<'static>,
    grounded: bool,
}

impl Led {
    /// Drives the pin high and looks at it: no LED pulls it below half of the supply, a wire to ground does.
    /// Where one does it is driven no more.
    pub fn new(mut pin: Flex<'static>) -> Led {
        // What the pin gives into a wire to ground meanwhile is least so.
        pin.set_drive_strength(Drive::_2mA);
        pin.set_high();
        pin.set_as_output();
        cortex_m::asm::delay(FOLLOWED);
        let grounded = pin.is_low();
        pin.set_low();
        if grounded {
            pin.set_as_input();
        }
        Led { pin, grounded }
    }

    /// The pin was connected to ground when the board started.
    pub fn was_grounded(&self) -> bool {
        self.grounded
    }

    /// On or off, in turn; it stays dark where the pin was grounded.
    pub fn toggle(&mut self) {
        if !self.grounded {
            self.pin.toggle();
        }
    }
}
