//! Reads one NumPy array.

use super::header::{Header, damaged};
use super::room::Room;
use super::{Frames, Shape, count};
use crate::error::{ArrayError, Context, Error, Result};
use std::fmt::Display;
use std::io::{self, BufReader, ErrorKind, Read};

/// Bytes read at once.
const PIECE: usize = 1 << 16;
/// Size limit of an array of texts; names of classes are shorter.
const LONGEST_TEXTS: u64 = 1 << 20;

/// Frames of an array in a file or archive entry of `size` bytes, as far as there is room for them.
pub fn read(source: impl Read, size: u64, room: &mut Room) -> Result<Frames> {
    read_as(source, size, room, Shape::of)
}

/// Counts of a one-dimensional array.
pub fn list(source: impl Read, size: u64) -> Result<Vec<u16>> {
    Ok(read_as(source, size, &mut Room::endless(), Shape::of_list)?.values)
}

/// Texts of a one-dimensional array in NumPy's encoding: four bytes per character, padded with 0.
pub fn texts(mut source: impl Read) -> Result<Vec<String>> {
    let Some(dtype) = Header::read(&mut source)?.dtype else {
        fail!(ArrayError::Unfit, "holds records, expected texts")
    };
    require!(
        dtype.class == 'U' && dtype.width > 0,
        ArrayError::Unfit,
        "holds values of type {dtype}, expected texts"
    );
    let mut body = Vec::new();
    source.take(LONGEST_TEXTS).read_to_end(&mut body).context("damaged")?;
    let text = |cell: &[u8]| -> Option<String> {
        let codes = cell.chunks_exact(4).map(|word| u32::of(word, dtype.big_endian));
        codes.take_while(|code| *code != 0).map(char::from_u32).collect()
    };
    body.chunks_exact(dtype.width)
        .map(|cell| text(cell).ok_or_else(|| error!(ArrayError::Unfit, "holds something that is not text")))
        .collect()
}

/// Values of an array whose dimensions `shape_of` accepts.
fn read_as(
    mut source: impl Read,
    size: u64,
    room: &mut Room,
    shape_of: fn(&[u64]) -> Result<Shape>,
) -> Result<Frames> {
    let header = Header::read(&mut source)?;
    let shape = shape_of(&header.shape)?;
    let Some(dtype) = &header.dtype else { fail!(ArrayError::Unfit, "holds records, expected numbers") };
    let counts: fn(Values<_>) -> Result<Frames> = match (dtype.class, dtype.width) {
        ('u', 1) => Values::counts::<u8>,
        ('u', 2) => Values::counts::<u16>,
        ('u', 4) => Values::counts::<u32>,
        ('u', 8) => Values::counts::<u64>,
        ('i', 1) => Values::counts::<i8>,
        ('i', 2) => Values::counts::<i16>,
        ('i', 4) => Values::counts::<i32>,
        ('i', 8) => Values::counts::<i64>,
        ('f', 4) => Values::counts::<f32>,
        ('f', 8) => Values::counts::<f64>,
        _ => fail!(ArrayError::Unfit, "holds values of type {dtype}, expected integers, f32 or f64"),
    };
    let claimed = header.body().unwrap_or(u64::MAX);
    check_size(&header.shape, claimed, size.saturating_sub(header.bytes))?;
    room.take(shape.values() as u64)?;
    // `size` may be wrong as well, so the bytes read are counted.
    let mut body = Counted { source: source.take(claimed.saturating_add(1)), bytes: 0 };
    let frames = counts(Values {
        source: BufReader::with_capacity(PIECE, &mut body),
        big_endian: dtype.big_endian,
        fortran: header.fortran,
        shape,
    });
    if frames.as_ref().is_err_and(|error| !is_end(error)) {
        return frames;
    }
    // At most one byte is left, which must not exist.
    io::copy(&mut body, &mut io::sink()).context("damaged")?;
    check_size(&header.shape, claimed, body.bytes)?;
    frames
}

/// True if the values ended too early.
fn is_end(error: &Error) -> bool {
    error.io().is_some_and(|cause| cause.kind() == ErrorKind::UnexpectedEof)
}

/// Counts the bytes read.
struct Counted<R> {
    source: R,
    bytes: u64,
}

impl<R: Read> Read for Counted<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = self.source.read(buffer)?;
        self.bytes += count as u64;
        Ok(count)
    }
}

/// Number of dimensions of an array; only its header is read.
pub fn dimensions(mut source: impl Read) -> Result<usize> {
    Ok(Header::read(&mut source)?.shape.len())
}

fn check_size(shape: &[u64], claimed: u64, there: u64) -> Result<()> {
    require!(
        there >= claimed,
        ArrayError::Damaged,
        "truncated: shape {shape:?} takes {claimed} bytes, there are {there}"
    );
    require!(there == claimed, ArrayError::Damaged, "shape {shape:?} takes {claimed} bytes, there are more");
    Ok(())
}

/// A number of a file.
trait Number: Display + Copy {
    /// Bytes of a number.
    const WIDTH: usize;

    /// The number that these [`WIDTH`](Number::WIDTH) bytes are.
    fn of(bytes: &[u8], big_endian: bool) -> Self;

    /// The number as a count; none if it is not an integer in 0 ..= 65535.
    fn count(self) -> Option<u16>;
}

macro_rules! numbers {
    ($($kind:ty: $count:expr),* $(,)?) => {
        $(impl Number for $kind {
            const WIDTH: usize = size_of::<$kind>();

            fn of(bytes: &[u8], big_endian: bool) -> $kind {
                let bytes = bytes.try_into().unwrap_or_default();
                if big_endian { <$kind>::from_be_bytes(bytes) } else { <$kind>::from_le_bytes(bytes) }
            }

            fn count(self) -> Option<u16> {
                let count: fn($kind) -> Option<u16> = $count;
                count(self)
            }
        })*
    };
}

numbers! {
    u8: |v| Some(v.into()),
    u16: Some,
    u32: |v| v.try_into().ok(),
    u64: |v| v.try_into().ok(),
    i8: |v| v.try_into().ok(),
    i16: |v| v.try_into().ok(),
    i32: |v| v.try_into().ok(),
    i64: |v| v.try_into().ok(),
    f32: |v| count(v.into()),
    f64: count,
}

/// The values of an array, in the order of the file.
struct Values<R> {
    source: R,
    big_endian: bool,
    /// The first index runs fastest.
    fortran: bool,
    shape: Shape,
}

impl<R: Read> Values<R> {
    fn counts<T: Number>(mut self) -> Result<Frames> {
        let shape = self.shape;
        let mut counts = vec![0; shape.values()];
        let mut bytes = [0; size_of::<u64>()];
        let bytes = &mut bytes[..T::WIDTH];
        for index in 0..counts.len() {
            self.source.read_exact(bytes).map_err(damaged).context("damaged")?;
            let value = T::of(bytes, self.big_endian);
            let index = if self.fortran { shape.place_of_fortran(index) } else { index };
            counts[index] = value.count().ok_or_else(|| shape.unfit(index, value))?;
        }
        Ok(shape.filled(counts))
    }
}
