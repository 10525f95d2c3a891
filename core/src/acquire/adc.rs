//! The converter, as scans and self-tests need it.

use super::lines::Pull;

/// A converter with numbered inputs (embedded-hal 1.0 has no trait for one).
pub trait Adc {
    /// Error of a conversion.
    type Error;
    /// One 12-bit sample, 0 ..= 4095, of the input on GPIO `input`.
    fn read(&mut self, input: u8) -> Result<u16, Self::Error>;
}

impl<A: Adc> Adc for &mut A {
    type Error = A::Error;
    fn read(&mut self, input: u8) -> Result<u16, A::Error> {
        (**self).read(input)
    }
}

/// A converter whose inputs can be pulled.
pub trait PulledAdc: Adc {
    /// Sets the pull of the input on GPIO `input`.
    fn pull(&mut self, input: u8, pull: Pull) -> Result<(), Self::Error>;
}
