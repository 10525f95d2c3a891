//! Numbers in bytes.

use serde::Deserialize;

/// Form of a number in a frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum NumberForm {
    /// 0 to 255
    U8,
    /// little-endian
    U16le,
    /// big-endian
    U16be,
    /// little-endian, two's complement
    I16le,
    /// big-endian, two's complement
    I16be,
    /// two numbers in three bytes, the high bits first
    U12be,
    /// little-endian
    U32le,
    /// big-endian
    U32be,
    /// little-endian
    F32le,
    /// big-endian
    F32be,
}

impl NumberForm {
    /// Bits of a number.
    pub fn bits(self) -> usize {
        match self {
            NumberForm::U8 => 8,
            NumberForm::U12be => 12,
            NumberForm::U16le | NumberForm::U16be | NumberForm::I16le | NumberForm::I16be => 16,
            NumberForm::U32le | NumberForm::U32be | NumberForm::F32le | NumberForm::F32be => 32,
        }
    }

    /// True if it counts: a whole number of whole bytes, never negative.
    pub fn counts(self) -> bool {
        use NumberForm::{U8, U16be, U16le, U32be, U32le};
        matches!(self, U8 | U16le | U16be | U32le | U32be)
    }

    /// Appends the numbers in these bytes.
    pub fn read(self, bytes: &[u8], values: &mut Vec<f64>) {
        let two = |read: fn([u8; 2]) -> f64| bytes.as_chunks().0.iter().map(move |bytes| read(*bytes));
        let four = |read: fn([u8; 4]) -> f64| bytes.as_chunks().0.iter().map(move |bytes| read(*bytes));
        match self {
            NumberForm::U8 => values.extend(bytes.iter().map(|byte| f64::from(*byte))),
            NumberForm::U16le => values.extend(two(|bytes| u16::from_le_bytes(bytes).into())),
            NumberForm::U16be => values.extend(two(|bytes| u16::from_be_bytes(bytes).into())),
            NumberForm::I16le => values.extend(two(|bytes| i16::from_le_bytes(bytes).into())),
            NumberForm::I16be => values.extend(two(|bytes| i16::from_be_bytes(bytes).into())),
            NumberForm::U32le => values.extend(four(|bytes| u32::from_le_bytes(bytes).into())),
            NumberForm::U32be => values.extend(four(|bytes| u32::from_be_bytes(bytes).into())),
            NumberForm::F32le => values.extend(four(|bytes| f32::from_le_bytes(bytes).into())),
            NumberForm::F32be => values.extend(four(|bytes| f32::from_be_bytes(bytes).into())),
            NumberForm::U12be => values.extend(bytes.as_chunks().0.iter().flat_map(|[a, b, c]: &[u8; 3]| {
                let [a, b, c] = [*a, *b, *c].map(u16::from);
                [a << 4 | b >> 4, (b & 15) << 8 | c].map(f64::from)
            })),
        }
    }

    /// Reads a counting number at the start of these bytes.
    pub fn count(self, bytes: &[u8]) -> u32 {
        let mut values = Vec::new();
        self.read(bytes.get(..self.bits() / 8).unwrap_or(&[]), &mut values);
        values.first().map_or(0, |value| *value as u32)
    }
}
