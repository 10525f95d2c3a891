//! Identifies files by size and hash.

use crate::error::{Context, Result};
use crate::files::input;
use std::path::Path;

/// Fingerprint of a file; it does not protect against intent.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fingerprint {
    /// Size of the file.
    pub bytes: usize,
    /// FNV-1a of its bytes, 64 bits in hexadecimal.
    pub fnv1a: String,
}

impl Fingerprint {
    /// Reads a file and hashes it.
    pub fn of(path: &Path) -> Result<Fingerprint> {
        let bytes = input::bytes(path).with_context(|| format!("{}: cannot be read", path.display()))?;
        Ok(Fingerprint { bytes: bytes.len(), fnv1a: format!("{:016x}", fnv1a(&bytes)) })
    }
}

impl std::fmt::Display for Fingerprint {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}-{}", self.bytes, self.fnv1a)
    }
}

fn fnv1a(bytes: &[u8]) -> u64 {
    bytes
        .iter()
        .fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(*byte)).wrapping_mul(0x100_0000_01b3))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hash_is_the_published_one() {
        assert_eq!((fnv1a(b""), fnv1a(b"foobar")), (0xcbf2_9ce4_8422_2325, 0x8594_4171_f739_67e8));
    }
}
