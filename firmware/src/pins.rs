//! Select lines: pins looked up by number, because a garment names its pins at run time.

use core::convert::Infallible;
use embassy_rp::{Peri, gpio};
use embedded_hal::digital::{ErrorType, OutputPin};
use taxel_core::acquire::{ProbePin, Pull};

/// A free pin. It stays high-impedance until it is driven, so that a pin which no garment names has no
/// effect.
pub struct LinePin(gpio::Flex<'static>);

impl LinePin {
    /// Takes the pin; returns its number with it.
    pub fn new(pin: Peri<'static, gpio::AnyPin>) -> (u8, LinePin) {
        use gpio::Pin;
        (pin.pin(), LinePin(gpio::Flex::new(pin)))
    }
}

impl ErrorType for LinePin {
    type Error = Infallible;
}

// The level is set before the driver is switched on, so that no other level ever shows.
impl OutputPin for LinePin {
    #[inline]
    fn set_low(&mut self) -> Result<(), Infallible> {
        self.0.set_low();
        self.0.set_as_output();
        Ok(())
    }

    #[inline]
    fn set_high(&mut self) -> Result<(), Infallible> {
        self.0.set_high();
        self.0.set_as_output();
        Ok(())
    }
}

impl ProbePin for LinePin {
    fn release(&mut self, pull: Pull) -> Result<(), Infallible> {
        self.0.set_pull(match pull {
            Pull::None => gpio::Pull::None,
            Pull::Up => gpio::Pull::Up,
            Pull::Down => gpio::Pull::Down,
        });
        self.0.set_as_input();
        Ok(())
    }

    fn level(&mut self) -> Result<bool, Infallible> {
        Ok(self.0.is_high())
    }
}
