//! Detects that two names lead to one file.

use std::fs::{self, Metadata};
use std::path::Path;

/// True if both names exist and lead to one file or folder: by another spelling (`./a`, or case on file
/// systems that ignore it), a symbolic link or a hard link.
///
/// Hard links are not recognised on systems without file numbers.
pub fn is_same(a: &Path, b: &Path) -> bool {
    let (Ok(of_a), Ok(of_b)) = (fs::metadata(a), fs::metadata(b)) else { return false };
    let number = number(&of_a);
    if number.is_some() && number == self::number(&of_b) {
        return true;
    }
    matches!((fs::canonicalize(a), fs::canonicalize(b)), (Ok(a), Ok(b)) if a == b)
}

/// Device, and number of the file on it.
#[cfg(unix)]
fn number(of: &Metadata) -> Option<[u64; 2]> {
    use std::os::unix::fs::MetadataExt;
    Some([of.dev(), of.ino()])
}

#[cfg(not(unix))]
fn number(_: &Metadata) -> Option<[u64; 2]> {
    None
}
