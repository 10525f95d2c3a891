//! Limits at which a recording continues in another file.

use std::str::FromStr;
use std::time::Duration;

/// Units of size, bytes.
const BYTES: [(&str, u64); 4] = [("B", 1), ("kB", 1000), ("MB", 1_000_000), ("GB", 1_000_000_000)];

/// Largest extent of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rotate {
    /// Board time.
    After(Duration),
    /// Bytes.
    Bytes(u64),
}

impl FromStr for Rotate {
    type Err = String;

    fn from_str(text: &str) -> Result<Rotate, String> {
        let time = humantime::parse_duration(text).ok().filter(|time| !time.is_zero());
        time.map(Rotate::After).or_else(|| bytes(text).map(Rotate::Bytes)).ok_or_else(|| {
            format!("\"{text}\": it must be a time or a size such as 30s, 10min, 2h, 500MB, 1GB")
        })
    }
}

/// A size above 0, with its unit.
fn bytes(text: &str) -> Option<u64> {
    let unit = text.trim_start_matches(|c: char| c.is_ascii_digit());
    let number = text[..text.len() - unit.len()].parse::<u64>().ok().filter(|number| *number > 0)?;
    let (_, size) = BYTES.iter().find(|(name, _)| *name == unit.trim_start())?;
    number.checked_mul(*size)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_and_sizes_are_read() {
        let read = |text: &str| text.parse::<Rotate>();
        assert_eq!(read("10min"), Ok(Rotate::After(Duration::from_secs(600))));
        assert_eq!(read("90 s"), Ok(Rotate::After(Duration::from_secs(90))));
        assert_eq!(read("1GB"), Ok(Rotate::Bytes(1_000_000_000)));
        for wrong in ["", "10", "min", "0s", "-1s", "0B", "1.5GB", "99999999999999999999B"] {
            assert!(read(wrong).unwrap_err().contains("10min"), "{wrong}");
        }
    }
}
