//! Names in tables that lie in flash, filled with zeros.

/// Bytes of the stored name of a joint.
pub(crate) const STORED_NAME: usize = 16;

/// The name; none if it is no text.
pub(crate) fn stored_name<const N: usize>(bytes: &[u8; N]) -> Option<&str> {
    let end = bytes.iter().position(|byte| *byte == 0).unwrap_or(N);
    core::str::from_utf8(bytes.get(..end)?).ok()
}

/// Stores a name in bytes that are zero. False if it is empty or too long.
pub(crate) fn store_name<const N: usize>(name: &str, to: &mut [u8; N]) -> bool {
    let place = to.get_mut(..name.len()).filter(|_| !name.is_empty());
    place.is_some_and(|place| {
        place.copy_from_slice(name.as_bytes());
        true
    })
}
