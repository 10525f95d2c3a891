//! Writes messages as postcard, number by number into the room that is left.
//!
//! The crate's own slice writer costs an M0+ a call of `memcpy` for each number. This one stores the one to five
//! bytes of a number directly, and remembers a lack of room in place of returning it from each number.

use super::error::WireError;
use postcard::ser_flavors::Flavor;
use postcard::Result;
use serde::Serialize;

/// Writes a value into `out`; returns the number of bytes.
pub(crate) fn write<T: Serialize + ?Sized>(
    value: &T,
    out: &mut [u8],
) -> core::result::Result<usize, WireError> {
    let room = out.len();
    let rest = postcard::serialize_with_flavor(value, Place { rest: out, is_full: false });
    rest.map_err(|_| WireError::Message)?.map(|rest| room - rest).ok_or(WireError::NoRoom)
}

/// Room for the rest of a message.
struct Place<'a> {
    rest: &'a mut [u8],
    /// Something had no room; nothing is written from then on.
    is_full: bool,
}

impl Place<'_> {
    #[inline(always)]
    fn put<const N: usize>(&mut self, bytes: [u8; N]) {
        match core::mem::take(&mut self.rest).split_first_chunk_mut() {
            Some((to, rest)) => {
                *to = bytes;
                self.rest = rest;
            }
            None => self.is_full = true,
        }
    }

    #[inline(never)]
    fn put_two(&mut self, bytes: [u8; 2]) {
        self.put(bytes);
    }

    #[inline(never)]
    fn put_three(&mut self, bytes: [u8; 3]) {
        self.put(bytes);
    }

    #[inline(never)]
    fn put_each(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.put([*byte]);
        }
    }
}

impl Flavor for Place<'_> {
    /// Remaining room, if all had room.
    type Output = Option<usize>;

    #[inline(always)]
    fn try_push(&mut self, byte: u8) -> Result<()> {
        self.put([byte]);
        Ok(())
    }

    #[inline(always)]
    fn try_extend(&mut self, bytes: &[u8]) -> Result<()> {
        match *bytes {
            [a] => self.put([a]),
            [a, b] => self.put_two([a, b]),
            [a, b, c] => self.put_three([a, b, c]),
            _ => self.put_each(bytes),
        }
        Ok(())
    }

    fn finalize(self) -> Result<Option<usize>> {
        Ok((!self.is_full).then_some(self.rest.len()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::format::{Micros, name};
    use crate::garment::Garment;
    use crate::scene::Scene;

    fn same<T: Serialize>(value: &T) {
        let (mut mine, mut theirs) = ([0; 2048], [0; 2048]);
        let theirs = postcard::to_slice(value, &mut theirs).unwrap();
        assert_eq!(write(value, &mut mine).unwrap(), theirs.len());
        assert_eq!(mine[..theirs.len()], *theirs);
        for room in 0..theirs.len().min(64) {
            assert_eq!(write(value, &mut mine[..room]), Err(WireError::NoRoom));
        }
    }

    #[test]
    fn it_writes_what_the_crate_writes() {
        for bits in 0..64 {
            for value in [1u64 << bits, (1 << bits) - 1, u64::MAX << bits] {
                same(&(value, value as u32, value as u16, value as u8, Micros(value)));
                same(&(value as i64, value as i32, value as i16, value as i8));
            }
        }
        same(&(name("name"), "text", &b"bytes"[..], (), [7u16; 3], Some(-70), None::<u8>, true));
        same(&(Garment::reference(), Scene::shipped()));
        same(&heapless::Vec::<u16, 4>::from_slice(&[300, 2]).unwrap());
    }

    #[test]
    fn a_list_of_unknown_length_is_refused() {
        struct List;
        impl Serialize for List {
            fn serialize<S: serde::Serializer>(&self, to: S) -> core::result::Result<S::Ok, S::Error> {
                to.serialize_seq(None).map(|_| unreachable!("postcard writes lengths first"))
            }
        }
        assert_eq!(write(&List, &mut [0; 9]), Err(WireError::Message));
    }
}
