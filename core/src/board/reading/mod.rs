//! Reads a garment and a scene in place, field by field. Derived code makes a copy at every level, and a
//! microcontroller's stack has no room for several maps of 64 concepts.

mod garment;
mod scene;

pub(super) use garment::garment;
pub(super) use scene::scene;

use super::refusal::Refusal;
use crate::wire::{WireError, decode};
use heapless::Vec;
use serde::Deserialize;

/// Decodes a large value, called `what` in the error. Own frame: its stack is free again on return.
#[inline(never)]
pub(super) fn value<'a, T: Deserialize<'a>>(what: &str, bytes: &'a [u8]) -> Result<T, Refusal> {
    decode(bytes).map_err(|error| match error {
        WireError::LeftOver => format_args!("{what}: bytes after its end").into(),
        _ => format_args!("{what}: these {} bytes are none that this board can hold", bytes.len()).into(),
    })
}

/// Unread bytes of a message, which errors call `what`.
struct Unread<'a> {
    what: &'static str,
    bytes: &'a [u8],
}

impl<'a> Unread<'a> {
    fn next<T: Deserialize<'a>>(&mut self, field: &str) -> Result<T, Refusal> {
        let what = self.what;
        match postcard::take_from_bytes(self.bytes) {
            Ok((value, rest)) => {
                self.bytes = rest;
                Ok(value)
            }
            Err(postcard::Error::DeserializeUnexpectedEnd) => {
                Err(format_args!("{what}: it ends within {field}").into())
            }
            Err(_) => Err(format_args!("{what}: {field} cannot be read").into()),
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
        let found: u32 = self.next(field)?;
        if found as usize > N {
            let what = self.what;
            return Err(format_args!("{what}: {found} {field}, and there is room for {N}").into());
        }
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
