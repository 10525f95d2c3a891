//! The bytes of a message from which its fields are read, whichever version wrote them.
//!
//! A later version adds fields at the end of a message. Whoever does not know them passes them over; whoever
//! misses them reads zeros, which are 0, none and empty. So a new field means by zero what was so before.

use postcard::de_flavors::Flavor;
use postcard::{Error, Result};

/// Part of a message that is still to be read.
pub(super) struct Rest<'de>(pub &'de [u8]);

impl<'de> Flavor<'de> for Rest<'de> {
    type Remainder = &'de [u8];
    type Source = &'de [u8];

    fn pop(&mut self) -> Result<u8> {
        let Some((first, rest)) = self.0.split_first() else { return Ok(0) };
        self.0 = rest;
        Ok(*first)
    }

    fn size_hint(&self) -> Option<usize> {
        Some(self.0.len())
    }

    fn try_take_n(&mut self, count: usize) -> Result<&'de [u8]> {
        let (taken, rest) = self.0.split_at_checked(count).ok_or(Error::DeserializeUnexpectedEnd)?;
        self.0 = rest;
        Ok(taken)
    }

    fn finalize(self) -> Result<&'de [u8]> {
        Ok(self.0)
    }
}
