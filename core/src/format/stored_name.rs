//! Names in tables that lie in flash: 16 bytes, filled with zeros.

/// Bytes of a stored name.
pub(crate) const STORED_NAME: usize = 16;

/// The name; none if it is no text.
pub(crate) fn stored_name(bytes: &[u8; STORED_NAME]) -> Option<&str> {
    let end = bytes.iter().position(|byte| *byte == 0).unwrap_or(STORED_NAME);
    core::str::from_utf8(bytes.get(..end)?).ok()
}

/// Stores a name in bytes that are zero. False if it is empty or too long.
pub(crate) fn store_name(name: &str, to: &mut [u8; STORED_NAME]) -> bool {
    let place = to.get_mut(..name.len()).filter(|_| !name.is_empty());
    place.is_some_and(|place| {
        place.copy_from_slice(name.as_bytes());
        true
    })
}
