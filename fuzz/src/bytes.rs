//! A fuzzer's bytes, read as numbers and pieces. Behind their end everything is zero or empty, so that any
//! bytes are a list of actions, and a byte that the fuzzer changes moves nothing else.

use serde::Deserialize;

/// The bytes of an input that are left.
#[derive(Debug, Clone)]
pub struct Bytes<'a>(&'a [u8]);

impl<'a> Bytes<'a> {
    /// All of them.
    pub fn new(bytes: &'a [u8]) -> Bytes<'a> {
        Bytes(bytes)
    }

    /// Whether none are left.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// One byte.
    pub fn byte(&mut self) -> u8 {
        self.array::<1>()[0]
    }

    /// A number of 16 bits.
    pub fn short(&mut self) -> u16 {
        u16::from_le_bytes(self.array())
    }

    /// A number of 32 bits.
    pub fn word(&mut self) -> u32 {
        u32::from_le_bytes(self.array())
    }

    fn array<const N: usize>(&mut self) -> [u8; N] {
        let mut array = [0; N];
        let taken = self.take(N);
        array[..taken.len()].copy_from_slice(taken);
        array
    }

    /// Up to `most` bytes.
    fn take(&mut self, most: usize) -> &'a [u8] {
        let (taken, rest) = self.0.split_at(most.min(self.0.len()));
        self.0 = rest;
        taken
    }

    /// As many bytes as the two before them say, or all that are left.
    pub fn piece(&mut self) -> &'a [u8] {
        let length = self.short();
        self.take(length.into())
    }

    /// All that are left.
    pub fn rest(&mut self) -> &'a [u8] {
        std::mem::take(&mut self.0)
    }

    /// A value as it travels; none: the bytes are none, and are left where they are.
    pub fn value<T: Deserialize<'a>>(&mut self) -> Option<T> {
        let (value, rest) = postcard::take_from_bytes(self.0).ok()?;
        self.0 = rest;
        Some(value)
    }

    /// `good` with up to seven of its bytes changed.
    pub fn change(&mut self, mut good: Vec<u8>) -> Vec<u8> {
        for _ in 0..self.byte() % 8 {
            let (place, change) = (usize::from(self.short()), self.byte());
            let length = good.len().max(1);
            good.get_mut(place % length).into_iter().for_each(|byte| *byte ^= change);
        }
        good
    }
}
