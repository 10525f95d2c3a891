//! Checksums at the end of frames.

use serde::Deserialize;

/// A checksum; of 16 bits, the low byte is first.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum FrameCheck {
    /// no checksum
    #[default]
    None,
    /// low byte of the sum
    Sum8,
    /// two's complement of the sum
    Lrc8,
    /// exclusive or
    Xor8,
    /// polynomial 07, start 00
    Crc8,
    /// polynomial A001 reflected, start FFFF
    Crc16Modbus,
    /// polynomial 1021, start FFFF
    Crc16Ccitt,
}

impl FrameCheck {
    /// Bytes of the checksum.
    pub fn length(self) -> usize {
        match self {
            FrameCheck::None => 0,
            FrameCheck::Crc16Modbus | FrameCheck::Crc16Ccitt => 2,
            _ => 1,
        }
    }

    /// True if `sum` is the checksum of `bytes`.
    pub fn agrees(self, bytes: &[u8], sum: &[u8]) -> bool {
        let [low, high] = self.of(bytes).to_le_bytes();
        [low, high][..self.length()] == *sum
    }

    fn of(self, bytes: &[u8]) -> u16 {
        let add = || bytes.iter().fold(0u8, |sum, byte| sum.wrapping_add(*byte));
        match self {
            FrameCheck::None => 0,
            FrameCheck::Sum8 => add().into(),
            FrameCheck::Lrc8 => add().wrapping_neg().into(),
            FrameCheck::Xor8 => bytes.iter().fold(0, |sum, byte| sum ^ byte).into(),
            FrameCheck::Crc8 => {
                bytes.iter().fold(0, |crc, byte| left(crc ^ u16::from(*byte) << 8, 0x0700)) >> 8
            }
            FrameCheck::Crc16Ccitt => {
                bytes.iter().fold(0xFFFF, |crc, byte| left(crc ^ u16::from(*byte) << 8, 0x1021))
            }
            FrameCheck::Crc16Modbus => bytes.iter().fold(0xFFFF, |crc, byte| right(crc ^ u16::from(*byte))),
        }
    }
}

/// Divides eight bits, the high one first.
fn left(crc: u16, polynomial: u16) -> u16 {
    (0..8).fold(crc, |crc, _| if crc & 0x8000 != 0 { crc << 1 ^ polynomial } else { crc << 1 })
}

/// Divides eight bits, the low one first.
fn right(crc: u16) -> u16 {
    (0..8).fold(crc, |crc, _| if crc & 1 != 0 { crc >> 1 ^ 0xA001 } else { crc >> 1 })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_are_those_of_their_names() {
        let sums = [
            (FrameCheck::Sum8, 0xDD),
            (FrameCheck::Lrc8, 0x23),
            (FrameCheck::Xor8, 0x31),
            (FrameCheck::Crc8, 0xF4),
            (FrameCheck::Crc16Modbus, 0x4B37),
            (FrameCheck::Crc16Ccitt, 0x29B1),
        ];
        for (check, sum) in sums {
            assert_eq!(check.of(b"123456789"), sum, "{check:?}");
        }
        assert!(FrameCheck::Crc16Ccitt.agrees(b"123456789", &[0xB1, 0x29]));
    }
}
