//! A postcard serializer that writes number by number, without a buffer in between: with a slice, the crate
//! `postcard` (1.1) costs an M0+ a call of `memcpy` for each number. The test below compares the two.
//!
//! The remaining slice is passed by value from number to number, so that it stays in registers.

use super::error::WireError;
use core::fmt;
use core::mem::take;
use serde::{Serialize, ser};

/// Writes a value into `out`; returns the number of bytes.
pub(crate) fn write<T: Serialize + ?Sized>(value: &T, out: &mut [u8]) -> Result<usize, WireError> {
    let room = out.len();
    match value.serialize(Writer { out }) {
        Ok(rest) => Ok(room - rest.out.len()),
        Err(WriteFault::NoRoom) => Err(WireError::NoRoom),
        Err(WriteFault::Unknown) => Err(WireError::Message),
    }
}

/// Reason why a value was not written.
#[derive(Debug, Clone, Copy)]
pub(crate) enum WriteFault {
    NoRoom,
    /// Messages have no values of this kind.
    Unknown,
}

impl fmt::Display for WriteFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("not written")
    }
}

impl ser::StdError for WriteFault {}

impl ser::Error for WriteFault {
    fn custom<T: fmt::Display>(_: T) -> Self {
        WriteFault::Unknown
    }
}

/// Remaining room for the message.
#[derive(Default)]
struct Writer<'a> {
    out: &'a mut [u8],
}

type Done<'a> = Result<Writer<'a>, WriteFault>;

impl<'a> Writer<'a> {
    #[inline(always)]
    fn byte(self, byte: u8) -> Done<'a> {
        self.bytes([byte]).ok_or(WriteFault::NoRoom)
    }

    /// Writes a varint: 7 bits a byte, the lowest first.
    #[inline(always)]
    fn number(self, number: u32) -> Done<'a> {
        if number < 128 { self.byte(number as u8) } else { self.long(number).ok_or(WriteFault::NoRoom) }
    }

    /// Writes a varint of two bytes or more. Returns an option, which unlike [`Done`] fits in registers.
    #[inline(never)]
    fn long(mut self, mut number: u32) -> Option<Self> {
        while number >= 1 << 14 {
            self = self.bytes([number as u8 | 128, (number >> 7) as u8 | 128])?;
            number >>= 14;
        }
        if number < 128 {
            self.bytes([number as u8])
        } else {
            self.bytes([number as u8 | 128, (number >> 7) as u8])
        }
    }

    #[inline(always)]
    fn bytes<const N: usize>(self, bytes: [u8; N]) -> Option<Self> {
        let (to, out) = self.out.split_first_chunk_mut()?;
        *to = bytes;
        Some(Writer { out })
    }

    /// Writes a varint in two words: an M0+ has no shifts of 64 bits.
    #[inline(always)]
    fn wide(self, number: u64) -> Done<'a> {
        let (low, high) = (number as u32, (number >> 32) as u32);
        if high == 0 { self.number(low) } else { self.wider(low, high).ok_or(WriteFault::NoRoom) }
    }

    #[inline(never)]
    fn wider(mut self, mut low: u32, mut high: u32) -> Option<Self> {
        while high != 0 {
            self = self.bytes([low as u8 | 128])?;
            (low, high) = (low >> 7 | high << 25, high >> 7);
        }
        if low < 128 { self.bytes([low as u8]) } else { self.long(low) }
    }

    fn all(self, bytes: &[u8]) -> Done<'a> {
        let Writer { out } = self.number(bytes.len() as u32)?;
        let (to, out) = out.split_at_mut_checked(bytes.len()).ok_or(WriteFault::NoRoom)?;
        to.iter_mut().zip(bytes).for_each(|(to, byte)| *to = *byte);
        Ok(Writer { out })
    }
}

impl<'a> ser::Serializer for Writer<'a> {
    type Ok = Self;
    type Error = WriteFault;
    type SerializeSeq = Self;
    type SerializeTuple = Self;
    type SerializeTupleStruct = Self;
    type SerializeTupleVariant = Self;
    type SerializeMap = ser::Impossible<Self, WriteFault>;
    type SerializeStruct = Self;
    type SerializeStructVariant = Self;

    fn serialize_bool(self, v: bool) -> Done<'a> {
        self.byte(v.into())
    }
    fn serialize_i8(self, v: i8) -> Done<'a> {
        self.byte(v as u8)
    }
    #[inline(always)]
    fn serialize_i16(self, v: i16) -> Done<'a> {
        self.serialize_i32(v.into())
    }
    #[inline(always)]
    fn serialize_i32(self, v: i32) -> Done<'a> {
        self.number((v << 1 ^ v >> 31) as u32)
    }
    #[inline(always)]
    fn serialize_i64(self, v: i64) -> Done<'a> {
        self.wide((v << 1 ^ v >> 63) as u64)
    }
    fn serialize_u8(self, v: u8) -> Done<'a> {
        self.byte(v)
    }
    #[inline(always)]
    fn serialize_u16(self, v: u16) -> Done<'a> {
        self.number(v.into())
    }
    #[inline(always)]
    fn serialize_u32(self, v: u32) -> Done<'a> {
        self.number(v)
    }
    #[inline(always)]
    fn serialize_u64(self, v: u64) -> Done<'a> {
        self.wide(v)
    }
    fn serialize_f32(self, _: f32) -> Done<'a> {
        Err(WriteFault::Unknown)
    }
    fn serialize_f64(self, _: f64) -> Done<'a> {
        Err(WriteFault::Unknown)
    }
    fn serialize_char(self, _: char) -> Done<'a> {
        Err(WriteFault::Unknown)
    }
    fn serialize_str(self, v: &str) -> Done<'a> {
        self.all(v.as_bytes())
    }
    fn serialize_bytes(self, v: &[u8]) -> Done<'a> {
        self.all(v)
    }
    fn serialize_none(self) -> Done<'a> {
        self.byte(0)
    }
    fn serialize_some<T: Serialize + ?Sized>(self, value: &T) -> Done<'a> {
        value.serialize(self.byte(1)?)
    }
    fn serialize_unit(self) -> Done<'a> {
        Ok(self)
    }
    fn serialize_unit_struct(self, _: &'static str) -> Done<'a> {
        Ok(self)
    }
    fn serialize_unit_variant(self, _: &'static str, index: u32, _: &'static str) -> Done<'a> {
        self.number(index)
    }
    fn serialize_newtype_struct<T: Serialize + ?Sized>(self, _: &'static str, value: &T) -> Done<'a> {
        value.serialize(self)
    }
    fn serialize_newtype_variant<T: Serialize + ?Sized>(
        self,
        _: &'static str,
        index: u32,
        _: &'static str,
        value: &T,
    ) -> Done<'a> {
        value.serialize(self.number(index)?)
    }
    fn serialize_seq(self, length: Option<usize>) -> Done<'a> {
        self.number(length.ok_or(WriteFault::Unknown)? as u32)
    }
    fn serialize_tuple(self, _: usize) -> Done<'a> {
        Ok(self)
    }
    fn serialize_tuple_struct(self, _: &'static str, _: usize) -> Done<'a> {
        Ok(self)
    }
    fn serialize_tuple_variant(self, _: &'static str, index: u32, _: &'static str, _: usize) -> Done<'a> {
        self.number(index)
    }
    fn serialize_map(self, _: Option<usize>) -> Result<Self::SerializeMap, WriteFault> {
        Err(WriteFault::Unknown)
    }
    fn serialize_struct(self, _: &'static str, _: usize) -> Done<'a> {
        Ok(self)
    }
    fn serialize_struct_variant(self, _: &'static str, index: u32, _: &'static str, _: usize) -> Done<'a> {
        self.number(index)
    }
    fn collect_str<T: fmt::Display + ?Sized>(self, _: &T) -> Done<'a> {
        Err(WriteFault::Unknown)
    }
    fn is_human_readable(&self) -> bool {
        false
    }
}

/// Elements and fields follow each other, with nothing between or behind them.
macro_rules! one_by_one {
    ($($of:ident :: $element:ident ($($name:ident)?)),*) => {$(
        impl<'a> ser::$of for Writer<'a> {
            type Ok = Self;
            type Error = WriteFault;

            #[inline(always)]
            fn $element<T: Serialize + ?Sized>(
                &mut self,
                $($name: &'static str,)?
                value: &T,
            ) -> Result<(), WriteFault> {
                $(let _ = $name;)?
                *self = value.serialize(take(self))?;
                Ok(())
            }

            fn end(self) -> Done<'a> {
                Ok(self)
            }
        }
    )*};
}

one_by_one! {
    SerializeSeq::serialize_element(),
    SerializeTuple::serialize_element(),
    SerializeTupleStruct::serialize_field(),
    SerializeTupleVariant::serialize_field(),
    SerializeStruct::serialize_field(name),
    SerializeStructVariant::serialize_field(name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::format::{Micros, name};
    use crate::garment::Garment;
    use crate::scene::Scene;

    #[derive(Serialize)]
    enum Kind {
        Unit,
        Newtype(i8),
        Tuple(u8, i16),
        Struct { a: Option<i64>, b: bool },
    }

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
    fn it_writes_what_postcard_writes() {
        for bits in 0..64 {
            for value in [1u64 << bits, (1 << bits) - 1, u64::MAX << bits] {
                same(&(value, value as u32, value as u16, value as u8, Micros(value)));
                same(&(value as i64, value as i32, value as i16, value as i8));
            }
        }
        same(&[Kind::Unit, Kind::Newtype(-1), Kind::Tuple(200, -300)]);
        same(&[Kind::Struct { a: None, b: true }, Kind::Struct { a: Some(-70), b: false }]);
        same(&(name("name"), "text", &b"bytes"[..], (), [7u16; 3]));
        same(&(Garment::reference(), Scene::shipped()));
        same(&heapless::Vec::<u16, 4>::from_slice(&[300, 2]).unwrap());
    }

    #[test]
    fn what_no_message_has_is_refused() {
        assert_eq!(write(&1.5f32, &mut [0; 9]), Err(WireError::Message));
        assert_eq!(write(&'c', &mut [0; 9]), Err(WireError::Message));
    }
}
