//! The calibration from which the gains come.

use core::fmt;
use serde::{Deserialize, Serialize};

/// Identity, date and error of the calibration in force. Its curves are on the host, in the file of that id.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Certificate {
    /// CRC-32/ISO-HDLC of gains and curves.
    pub id: u32,
    /// Number of taxels of its garment.
    pub taxels: u16,
    /// 2000 ..= 9999
    pub year: u16,
    /// 1 ..= 12
    pub month: u8,
    /// 1 ..= 31
    pub day: u8,
    /// Error of the forces of the weights used for it, 1/100 % rms.
    pub error: u16,
}

impl Certificate {
    /// Error if the date is impossible: the reason.
    pub fn check(&self) -> Result<(), &'static str> {
        match (self.year, self.month, self.day) {
            (2000..=9999, 1..=12, 1..=31) => Ok(()),
            (2000..=9999, 1..=12, _) => Err("the day of a calibration must be 1 to 31"),
            (2000..=9999, ..) => Err("the month of a calibration must be 1 to 12"),
            _ => Err("the year of a calibration must be 2000 to 9999"),
        }
    }
}

/// The text of `Hello`: `id 3fa9c21b, 2026-11-21, 1.25 %`.
impl fmt::Display for Certificate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Certificate { id, year, month, day, error, .. } = self;
        write!(f, "id {id:08x}, {year:04}-{month:02}-{day:02}, {}.{:02} %", error / 100, error % 100)
    }
}
