//! Limits the memory of arrays.

use crate::error::{ArrayError, Result};

/// Bytes of a value in memory.
const VALUE: u64 = size_of::<u16>() as u64;

/// Remaining memory.
#[derive(Debug, Clone, Copy)]
pub struct Room {
    /// Bytes of the file.
    file: u64,
    left: u64,
}

impl Room {
    /// The size of a file, and this many bytes beyond.
    pub fn of(file: u64, beyond: u64) -> Room {
        Room { file, left: file.saturating_add(beyond) }
    }

    /// No limit.
    pub fn endless() -> Room {
        Room { file: 0, left: u64::MAX }
    }

    /// Reserves memory for this many values.
    pub fn take(&mut self, values: u64) -> Result<()> {
        let bytes = values.saturating_mul(VALUE);
        let mib = |bytes: u64| bytes.div_ceil(1 << 20);
        require!(
            bytes <= self.left,
            ArrayError::TooLarge,
            "its {values} values take {} MiB of memory, and of a compressed file of {} MiB {} more are read: save it \
             uncompressed (numpy.savez), or in parts",
            mib(bytes),
            mib(self.file),
            mib(self.left)
        );
        self.left -= bytes;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_taken_is_gone() {
        let mut room = Room::of(1 << 20, 3 << 20);
        room.take(1 << 20).unwrap();
        let why = room.take((1 << 20) + 1).unwrap_err().to_string();
        assert!(
            why.starts_with(
                "its 1048577 values take 3 MiB of memory, and of a compressed file of 1 MiB 2 more"
            ),
            "{why}"
        );
        room.take(1 << 20).unwrap();
        assert!(room.take(1).is_err());
        Room::endless().take(u64::MAX / 4).unwrap();
        assert!(Room::of(5, 5).take(u64::MAX).is_err());
    }
}
