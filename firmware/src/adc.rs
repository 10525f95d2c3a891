//! The converter: one 12-bit sample at a time, of the input that is asked for.

use embassy_rp::adc::{Adc, Blocking, Channel};
use rp_pac::ADC;

/// GPIO number of the converter's first input.
pub const FIRST_INPUT: u8 = 26;

/// GPIO numbers of so many inputs, as a mask.
pub const fn mask(inputs: usize) -> u64 {
    ((1 << inputs) - 1) << FIRST_INPUT
}

/// The converter with the inputs that the board brings out, beginning with GPIO 26.
pub struct Converter<const INPUTS: usize> {
    // These keep the converter on and the pins analog; the samples are taken past them, see `read`.
    _adc: Adc<'static, Blocking>,
    _inputs: [Channel<'static>; INPUTS],
}

/// Why there is no sample.
#[derive(Debug, Clone, Copy, PartialEq, Eq, defmt::Format)]
pub enum ConverterError {
    /// The board has no converter input on this pin.
    NoInput(u8),
    /// The converter reported a failed conversion of this pin.
    Conversion(u8),
}

impl<const INPUTS: usize> Converter<INPUTS> {
    /// Takes the converter and its inputs, in the order of their pins.
    pub fn new(adc: Adc<'static, Blocking>, inputs: [Channel<'static>; INPUTS]) -> Self {
        Converter { _adc: adc, _inputs: inputs }
    }
}

impl<const INPUTS: usize> taxel_core::acquire::Adc for Converter<INPUTS> {
    type Error = ConverterError;

    /// Takes 2 us for the conversion and 0.2 us around it: half of what embassy's own reading takes around it.
    #[inline]
    fn read(&mut self, input: u8) -> Result<u16, ConverterError> {
        let channel = input.wrapping_sub(FIRST_INPUT);
        if usize::from(channel) >= INPUTS {
            return Err(ConverterError::NoInput(input));
        }
        ADC.cs().write(|w| {
            w.set_en(true);
            w.set_ainsel(channel);
            w.set_start_once(true);
        });
        let status = loop {
            let status = ADC.cs().read();
            if status.ready() {
                break status;
            }
        };
        if status.err() { Err(ConverterError::Conversion(input)) } else { Ok(ADC.result().read().result()) }
    }
}
