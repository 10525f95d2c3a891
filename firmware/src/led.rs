//! The heartbeat LED, on a pin that may be grounded at power-up to request the shipped settings.

use embassy_rp::gpio::{Drive, Flex};

/// Time until the pin's level is valid, cycles: some 10 us.
const FOLLOWED: u32 = 1250;

/// The LED.
pub struct Led {
    pin: Flex<'static>,
    grounded: bool,
}

impl Led {
    /// Drives the pin high and reads it back: an LED does not pull it below half of the supply, but a wire to
    /// ground does. A grounded pin is then no longer driven.
    pub fn new(mut pin: Flex<'static>) -> Led {
        // Limits the current into a wire to ground.
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

    /// True if the pin was connected to ground when the board started.
    pub fn was_grounded(&self) -> bool {
        self.grounded
    }

    /// Toggles the LED; it stays dark if the pin was grounded.
    pub fn toggle(&mut self) {
        if !self.grounded {
            self.pin.toggle();
        }
    }
}
