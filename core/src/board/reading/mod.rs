//! Reads a garment and a scene in place, field by field. Derived code makes a copy at every level, and a
//! microcontroller's stack has no room for several maps of 64 concepts.

mod garment;
mod scene;

pub(super) use garment::garment;
pub(super) use scene::scene;

use super::refusal::Refusal;
use heapless::Vec;
use serde::Deserialize;

/// Decodes a large value, called `what` in the error. Own frame: its stack is free again on return.
#[inline(never)]
pub(super) fn value<'a, T: Deserialize<'a>>(what: &str, bytes: &'a [u8]) -> Result<T, Refusal> {
    match postcard::take_from_bytes(bytes) {
        Ok((value, [])) => Ok(value),
        Ok(_) => Err(unreadable(what, bytes, true)),
        Err(_) => Err(unreadable(what, bytes, false)),
    }
}

/// Refusal of bytes that cannot be read, or of those after the end of what was read.
fn unreadable(what: &str, bytes: &[u8], is_left_over: bool) -> Refusal {
    if is_left_over {
        return format_args!("{what}: bytes after its end").into();
    }
    format_args!("{what}: these {} bytes are none that this board can hold", bytes.len()).into()
}

/// Unread bytes of a message, which errors call `what`.
struct Unread<'a> {
    what: &'static str,
    bytes: &'a [u8],
}

impl<'a> Unread<'a> {
    fn next<T: Deserialize<'a>>(&mut self, field: &str) -> Result<T, Refusal> {
        match postcard::take_from_bytes(self.bytes) {
            Ok((value, rest)) => {
                self.bytes = rest;
                Ok(value)
            }
            Err(error) => Err(self.refuse(field, &error)),
        }
    }

    /// Number of what follows, of which there is room for so many.
    #[inline(never)] // for size: once, not for each list
    fn count(&mut self, field: &str, room: usize) -> Result<u32, Refusal> {
        let found: u32 = self.next(field)?;
        if found as usize > room {
            let what = self.what;
            return Err(format_args!("{what}: {found} {field}, and there is room for {room}").into());
        }
        Ok(found)
    }

    /// Refusal of a field that cannot be read.
    #[inline(never)] // for size: once, not for each type
    fn refuse(&self, field: &str, error: &postcard::Error) -> Refusal {
        let what = self.what;
        match error {
            postcard::Error::DeserializeUnexpectedEnd => {
                format_args!("{what}: it ends within {field}").into()
            }
            _ => format_args!("{what}: {field} cannot be read").into(),
        }
    }

    fn put<T: Deserialize<'a>>(&mut self, field: &str, to: &mut T) -> Result<(), Refusal> {
        *to = self.next(field)?;
        Ok(())
    }

    fn list<T: Deserialize<'a>, const N: usize>(
        &mut self,
        field: &str,
        to: &mut Vec<T, N>,
    ) -> Result<(), Refusal> {
        to.clear();
        let found = self.count(field, N)?;
        for _ in 0..found {
            // There is room for `found` of them.
            let _ = to.push(self.next(field)?);
        }
        Ok(())
    }

    /// Refuses bytes that are left over.
    fn end(&self) -> Result<(), Refusal> {
        match self.bytes {
            [] => Ok(()),
            rest => Err(format_args!("{}: bytes after its end: {}", self.what, rest.len()).into()),
        }
    }
}
