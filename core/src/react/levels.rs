//! Initial levels of the outputs: while a board starts, before its first perceived frame.

use super::config::ReactionConfig;

/// Levels of pins. Bit `i`: GPIO `i`.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub struct Levels {
    /// Pins that are driven.
    pub pins: u32,
    /// Pins that are high.
    pub high: u32,
}

impl Levels {
    /// Levels of all outputs of a table. A pin is asserted if a reaction to a fault or to blindness asserts
    /// it, because a board that starts can rule out neither; otherwise it is at rest.
    pub fn of(rows: &[ReactionConfig]) -> Levels {
        let mut levels = Levels::default();
        for row in rows {
            let Some(line) = row.output else { continue };
            let bit = 1u32.checked_shl(line.pin.into()).unwrap_or(0);
            let is_known = levels.pins & bit != 0;
            let asserted = row.cause.is_open_at_start();
            levels.pins |= bit;
            if asserted || !is_known {
                let high = asserted != line.inverted;
                levels.high = levels.high & !bit | if high { bit } else { 0 };
            }
        }
        levels
    }
}

#[cfg(test)]
mod tests {
    use super::super::Cause;
    use super::*;
    use crate::format::Name;
    use crate::garment::Line;

    #[test]
    fn a_pin_is_asserted_where_one_of_its_rows_looks_at_the_board() {
        let row = |cause, pin, inverted| ReactionConfig {
            name: Name::new(),
            cause,
            region: Name::new(),
            level: 1,
            hysteresis: 0,
            hold_ms: 0,
            output: Some(Line { pin, inverted }),
        };
        let table = [
            row(Cause::Blind, 3, false),
            row(Cause::Pressure, 3, false),
            row(Cause::Pressure, 4, true),
            row(Cause::Fault, 4, true),
            row(Cause::Pressure, 5, false),
            row(Cause::Faulty, 6, true),
            row(Cause::Silent, 31, true),
            row(Cause::Watching, 32, true),
            ReactionConfig { output: None, ..row(Cause::Fault, 7, false) },
        ];
        let bits = |pins: &[u8]| pins.iter().fold(0, |bits, pin| bits | 1 << pin);
        assert_eq!(Levels::of(&table), Levels { pins: bits(&[3, 4, 5, 6, 31]), high: bits(&[3, 6, 31]) });
        assert_eq!(Levels::of(&[]), Levels::default());
    }
}
