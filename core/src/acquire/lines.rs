//! The board's output pins, and the trait of pins that a self-test needs.

use embedded_hal::digital::{OutputPin, PinState};

/// The weak pull resistor of a pin.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub enum Pull {
    /// none
    #[default]
    None,
    /// to the supply
    Up,
    /// to ground
    Down,
}

/// An output pin that can be released and read.
pub trait ProbePin: OutputPin {
    /// Stops driving the pin, and pulls it.
    fn release(&mut self, pull: Pull) -> Result<(), Self::Error>;
    /// Level at the pin itself, driven or not.
    fn level(&mut self) -> Result<bool, Self::Error>;
}

/// The board's free output pins, looked up by GPIO number, because garments name their pins at run time.
pub struct Lines<P, const PINS: usize> {
    pub(super) pins: heapless::Vec<(u8, P), PINS>,
}

impl<P: OutputPin, const PINS: usize> Lines<P, PINS> {
    /// Takes pairs of GPIO number and pin; pairs beyond the capacity are left out.
    pub fn new(pins: impl IntoIterator<Item = (u8, P)>) -> Self {
        Lines { pins: pins.into_iter().take(PINS).collect() }
    }

    /// Mask of the GPIO numbers.
    pub fn mask(&self) -> u64 {
        self.pins.iter().fold(0, |mask, (number, _)| mask | 1u64.checked_shl(u32::from(*number)).unwrap_or(0))
    }

    /// Drives a pin; none if no pin has that number.
    pub fn drive(&mut self, number: u8, level: bool) -> Option<Result<(), P::Error>> {
        Some(self.pin(number)?.set_state(PinState::from(level)))
    }

    fn pin(&mut self, number: u8) -> Option<&mut P> {
        self.pins.iter_mut().find(|(n, _)| *n == number).map(|(_, pin)| pin)
    }
}

impl<P: ProbePin, const PINS: usize> Lines<P, PINS> {
    /// Stops driving a pin and pulls it; none if no pin has that number.
    pub fn release(&mut self, number: u8, pull: Pull) -> Option<Result<(), P::Error>> {
        Some(self.pin(number)?.release(pull))
    }

    /// Level at a pin; none if no pin has that number.
    pub fn level(&mut self, number: u8) -> Option<Result<bool, P::Error>> {
        Some(self.pin(number)?.level())
    }
}
