//! The pins of a board: those that garments and scenes may use, and the use of the others.

use core::fmt;

/// Pins that a board brings out, as bit masks over GPIO numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Pins {
    /// Pins free to drive select lines and reactions.
    pub outputs: u64,
    /// Converter inputs.
    pub inputs: u64,
    /// Number of GPIOs of the chip: GP0 to GP`gpios - 1`.
    pub gpios: u8,
    /// Pins that the board uses itself, with the use as the end of a sentence.
    pub taken: &'static [(u8, &'static str)],
}

impl Pins {
    /// No restriction: for simulations and recordings.
    pub const ANY: Pins = Pins { outputs: u64::MAX, inputs: u64::MAX, gpios: 64, taken: &[] };

    /// Adafruit Feather RP2040, and boards with the same use of pins.
    pub const FEATHER: Pins = Pins {
        // GP2, GP3, GP6 to GP12, GP18 to GP20, GP24, GP25.
        outputs: 0x031c_1fcc,
        // GP26 to GP29.
        inputs: 0xf << 26,
        gpios: 30,
        taken: &[
            (0, "the UART transmits there"),
            (1, "the UART receives there"),
            (13, "the heartbeat LED is there"),
        ],
    };

    /// True if a garment or a scene may drive the pin.
    pub const fn is_output(&self, pin: u8) -> bool {
        pin < 64 && self.outputs >> pin & 1 == 1
    }

    /// True if the pin is a converter input.
    pub const fn is_input(&self, pin: u8) -> bool {
        pin < 64 && self.inputs >> pin & 1 == 1
    }

    /// Reason why a garment may not drive the pin.
    pub fn why_no_output(&self, pin: u8) -> NotFree {
        match self.taken.iter().find(|(taken, _)| *taken == pin) {
            Some((_, other)) => NotFree::Taken(other),
            None if pin >= self.gpios => NotFree::Beyond { gpios: self.gpios },
            None if self.is_input(pin) => NotFree::Input,
            None => NotFree::Hidden,
        }
    }
}

/// Reason why a pin is no free output.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NotFree {
    /// The board uses the pin; the use as the end of a sentence.
    Taken(&'static str),
    /// The chip has fewer GPIOs.
    Beyond {
        /// number of GPIOs
        gpios: u8,
    },
    /// The pin is a converter input.
    Input,
    /// The board does not bring the pin out.
    Hidden,
}

impl fmt::Display for NotFree {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NotFree::Taken(other) => f.write_str(other),
            NotFree::Beyond { gpios } => write!(f, "the chip ends at GP{}", gpios.saturating_sub(1)),
            NotFree::Input => f.write_str("it is a converter input"),
            NotFree::Hidden => f.write_str("it is not brought out"),
        }
    }
}

/// A mask of pins as text: `GP2, GP3, GP6 to GP12`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PinList(pub u64);

impl fmt::Display for PinList {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let has = |pin: u32| pin < 64 && self.0 >> pin & 1 == 1;
        let mut comma = "";
        for first in (0..64).filter(|pin| has(*pin) && (*pin == 0 || !has(pin - 1))) {
            let last = (first..64).take_while(|pin| has(*pin)).last().unwrap_or(first);
            write!(f, "{comma}GP{first}")?;
            comma = ", ";
            match last - first {
                0 => {}
                1 => write!(f, ", GP{last}")?,
                _ => write!(f, " to GP{last}")?,
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    extern crate std;

    use super::*;
    use std::string::ToString;

    #[test]
    fn pins_are_reported_as_people_write_them() {
        let feather = Pins::FEATHER;
        assert_eq!(PinList(feather.inputs).to_string(), "GP26 to GP29");
        assert_eq!(PinList(feather.outputs).to_string(), "GP2, GP3, GP6 to GP12, GP18 to GP20, GP24, GP25");
        assert_eq!(PinList(u64::MAX).to_string(), "GP0 to GP63");
    }

    #[test]
    fn a_pin_is_free_or_it_is_said_what_it_is_for() {
        let feather = Pins::FEATHER;
        let why = |pin| feather.why_no_output(pin).to_string();
        assert_eq!(why(13), "the heartbeat LED is there");
        assert_eq!((why(4), why(28)), ("it is not brought out".into(), "it is a converter input".into()));
        assert_eq!((why(30), why(255)), ("the chip ends at GP29".into(), "the chip ends at GP29".into()));
        for pin in 0..=u8::MAX {
            let taken = feather.taken.iter().any(|(taken, _)| *taken == pin);
            assert!(!(feather.is_output(pin) && (taken || feather.is_input(pin) || pin >= feather.gpios)));
        }
    }
}
