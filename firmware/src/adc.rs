//! The converter: single 12-bit samples of one input, or free-running conversions of several inputs.

use embassy_rp::adc::{Adc, Blocking, Channel};
use rp_pac::{ADC, PADS_BANK0};
use taxel_core::acquire::{CONVERSION_CLOCKS, Pull, PulledAdc, Rounds, ScanError};
use taxel_core::format::Celsius;

/// GPIO number of the converter's first input.
pub const FIRST_INPUT: u8 = 26;

/// The converter with the inputs that the board brings out, beginning with GPIO 26.
pub struct Converter<const INPUTS: usize> {
    // Ownership keeps the converter on and the pins analog; `read` uses the registers directly.
    _adc: Adc<'static, Blocking>,
    _inputs: [Channel<'static>; INPUTS],
}

/// Error of a sample.
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

    /// Takes 2 us for the conversion and 0.2 us around it: half of the overhead of embassy's own reading.
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

impl<const INPUTS: usize> PulledAdc for Converter<INPUTS> {
    fn pull(&mut self, input: u8, pull: Pull) -> Result<(), ConverterError> {
        if usize::from(input.wrapping_sub(FIRST_INPUT)) >= INPUTS {
            return Err(ConverterError::NoInput(input));
        }
        // The pin stays analog: its driver and its digital input remain off.
        PADS_BANK0.gpio(usize::from(input)).modify(|w| {
            w.set_pue(pull == Pull::Up);
            w.set_pde(pull == Pull::Down);
        });
        Ok(())
    }
}

/// Channel of the thermometer.
const THERMOMETER: u8 = 4;

/// Returns the temperature for a code of the thermometer: 27 degrees minus one for each 1.721 mV above 0.706
/// V, at a reference of 3.3 V (RP2040 datasheet, 4.9.5). Rounding loses at most 0.1 degrees; two to three
/// counts of noise are a degree.
pub fn celsius(code: u16) -> Celsius {
    // 2700 + 70_600 / 1.721, minus 330_000 / 1.721 for each 4096 counts.
    let hundredths = 43_723 - ((u32::from(code.min(4095)) * 191_749) >> 12) as i32;
    Celsius(hundredths.clamp(i16::MIN.into(), i16::MAX.into()) as i16)
}

/// Converter channel of an input.
pub const fn channel(input: u8) -> usize {
    (input.wrapping_sub(FIRST_INPUT) & 3) as usize
}

/// Converts the thermometer and these channels in turn until [`halt`], at the pace of `rounds`, with DMA
/// requests.
pub fn run(channels: impl Iterator<Item = usize>, rounds: Rounds) {
    // 0: back to back.
    let divider = if rounds.period_clocks > CONVERSION_CLOCKS { rounds.period_clocks - 1 } else { 0 };
    ADC.div().write(|w| w.set_int(divider.min(u16::MAX.into()) as u16));
    while ADC.fcs().read().level() > 0 {
        ADC.fifo().read();
    }
    ADC.fcs().write(|w| {
        w.set_en(true);
        w.set_dreq_en(true);
        w.set_thresh(1);
        // These two flags are cleared by writing 1.
        w.set_over(true);
        w.set_under(true);
    });
    ADC.cs().write(|w| {
        w.set_en(true);
        w.set_ts_en(true);
        w.set_err_sticky(true);
        w.set_ainsel(THERMOMETER);
        w.set_rrobin(channels.fold(1 << THERMOMETER, |mask, channel| mask | 1 << channel));
        w.set_start_many(true);
    });
}

/// Error if a conversion since [`run`] failed or was not fetched in time.
pub fn check() -> Result<(), ScanError> {
    if ADC.fcs().read().over() {
        return Err(ScanError::OutOfStep);
    }
    if ADC.cs().read().err_sticky() { Err(ScanError::Conversion) } else { Ok(()) }
}

/// Stops [`run`] after the present conversion.
pub fn halt() {
    ADC.cs().write(|w| w.set_en(true));
    while !ADC.cs().read().ready() {}
    ADC.fcs().write(|_| {});
    ADC.div().write(|_| {});
}
