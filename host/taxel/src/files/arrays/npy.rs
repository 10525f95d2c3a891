//! Reads one NumPy array.

use super::room::Room;
use super::{Frames, Shape, count};
use crate::error::{ArrayError, Context, Error, Result};
use npyz::{DType, Deserialize, Endianness, NpyFile, NpyHeader, Order, TypeChar};
use std::fmt::Display;
use std::io::{self, BufReader, ErrorKind, Read};

/// Magic of the format.
pub const MAGIC: &[u8] = b"\x93NUMPY";

/// Size limit of a header; those of plain arrays have 118 bytes or a little more.
const LONGEST_HEADER: usize = 1 << 16;
/// Deepest nesting of brackets in a header: the dictionary, a list of fields, a field, the shape of a field.
const DEEPEST: i32 = 4;
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
    let header = parse(&head(&mut source)?)?;
    let DType::Plain(kind) = header.dtype() else {
        fail!(ArrayError::Unfit, "holds records, expected texts")
    };
    let width = kind.num_bytes().unwrap_or(0);
    require!(
        kind.type_char() == TypeChar::UnicodeStr && width > 0,
        ArrayError::Unfit,
        "holds values of type {kind}, expected texts"
    );
    let mut body = Vec::new();
    source.take(LONGEST_TEXTS).read_to_end(&mut body).context("damaged")?;
    let little = kind.endianness() != Endianness::Big;
    let text = |cell: &[u8]| -> Option<String> {
        let words = cell.chunks_exact(4).map(|word| word.try_into().unwrap_or([0; 4]));
        let codes =
            words.map(|word| if little { u32::from_le_bytes(word) } else { u32::from_be_bytes(word) });
        codes.take_while(|code| *code != 0).map(char::from_u32).collect()
    };
    body.chunks_exact(width)
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
    let head = head(&mut source)?;
    let header = parse(&head)?;
    let shape = shape_of(header.shape())?;
    let DType::Plain(kind) = header.dtype() else {
        fail!(ArrayError::Unfit, "holds records, expected numbers")
    };
    let width = kind.num_bytes().unwrap_or(0) as u64;
    let claimed = (shape.values() as u64).saturating_mul(width);
    let there = size.saturating_sub(head.len() as u64);
    check_size(header.shape(), claimed, there)?;
    room.take(shape.values() as u64)?;
    let dimensions = header.shape().to_vec();
    // `size` may be wrong as well, so the bytes read are counted.
    let mut body = Counted { source: source.take(claimed.saturating_add(1)), bytes: 0 };
    let file = NpyFile::with_header(header, BufReader::with_capacity(PIECE, &mut body));
    let frames = match (kind.type_char(), width) {
        (TypeChar::Uint, 1) => counts::<u8>(file, shape),
        (TypeChar::Uint, 2) => counts::<u16>(file, shape),
        (TypeChar::Uint, 4) => counts::<u32>(file, shape),
        (TypeChar::Uint, 8) => counts::<u64>(file, shape),
        (TypeChar::Int, 1) => counts::<i8>(file, shape),
        (TypeChar::Int, 2) => counts::<i16>(file, shape),
        (TypeChar::Int, 4) => counts::<i32>(file, shape),
        (TypeChar::Int, 8) => counts::<i64>(file, shape),
        (TypeChar::Float, 4) => counts::<f32>(file, shape),
        (TypeChar::Float, 8) => counts::<f64>(file, shape),
        _ => fail!(ArrayError::Unfit, "holds values of type {kind}, expected integers, f32 or f64"),
    };
    if frames.as_ref().is_err_and(|error| !is_end(error)) {
        return frames;
    }
    // At most one byte is left, which must not exist.
    io::copy(&mut body, &mut io::sink()).context("damaged")?;
    check_size(&dimensions, claimed, body.bytes)?;
    frames
}

/// True if the values ended too early.
fn is_end(error: &Error) -> bool {
    error.io().is_some_and(|cause| cause.kind() == ErrorKind::UnexpectedEof)
}

/// An error of the bytes, unless it is one of the system.
fn damaged(error: io::Error) -> Error {
    match error.raw_os_error() {
        None if error.kind() != ErrorKind::UnexpectedEof => ArrayError::Damaged(error.to_string()).into(),
        _ => error.into(),
    }
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
    Ok(parse(&head(&mut source)?)?.shape().len())
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

/// Reads everything before the values.
fn head(source: &mut impl Read) -> Result<Vec<u8>> {
    let mut head = Vec::new();
    let mut more = |count: usize| -> Result<Vec<u8>> {
        let start = head.len();
        head.resize(start + count, 0);
        source.read_exact(&mut head[start..]).map_err(damaged).context("truncated in its header")?;
        Ok(head[start..].to_vec())
    };
    let start = more(8)?;
    require!(start.starts_with(MAGIC), ArrayError::NotAnArray, "not a NumPy array");
    let length = more(if start[6] == 1 { 2 } else { 4 })?;
    let length = length.iter().rev().fold(0, |sum, byte| sum << 8 | usize::from(*byte));
    require!(
        length <= LONGEST_HEADER,
        ArrayError::Damaged,
        "has a header of {length} bytes, expected at most {LONGEST_HEADER}"
    );
    more(length)?;
    Ok(head)
}

fn parse(head: &[u8]) -> Result<NpyHeader> {
    require!(is_tame(head), ArrayError::Damaged, "has a header that is not one of a NumPy array");
    NpyHeader::from_reader(head).map_err(damaged).context("has a header that is not one of a NumPy array")
}

/// npyz multiplies dimensions without a check, nests brackets without a limit, and tries each bracket that is
/// not closed in several ways, which takes twice as long for each one inside another. Headers that would
/// exploit that are refused.
fn is_tame(head: &[u8]) -> bool {
    let text = String::from_utf8_lossy(head);
    let mut depth = 0;
    let is_flat = text.chars().all(|sign| {
        match sign {
            '(' | '[' | '{' => depth += 1,
            ')' | ']' | '}' => depth -= 1,
            _ => {}
        }
        depth <= DEEPEST
    });
    let brackets = text.matches(['(', '[', '{']).count();
    let product = || {
        let (_, after) = text.split_once("shape")?;
        let (_, list) = after.split_once('(')?;
        let (list, rest) = list.split_once(')')?;
        let sizes = list.split(',').map(str::trim).filter(|size| !size.is_empty());
        let mut sizes = sizes.map(|size| size.parse::<u64>().ok());
        let product = sizes.try_fold(1u64, |product, size| product.checked_mul(size?.max(1)));
        product.filter(|_| !rest.contains("shape"))
    };
    is_flat && brackets <= 64 && product().is_some()
}

/// Type of a number in a file.
trait Cell: Deserialize + Display + Copy {
    /// The number as a count; none if it is not an integer in 0 ..= 65535.
    fn count(self) -> Option<u16>;
}

macro_rules! cells {
    ($($kind:ty: $count:expr),* $(,)?) => {
        $(impl Cell for $kind {
            fn count(self) -> Option<u16> {
                let count: fn($kind) -> Option<u16> = $count;
                count(self)
            }
        })*
    };
}

cells! {
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

fn counts<T: Cell>(file: NpyFile<impl Read>, shape: Shape) -> Result<Frames> {
    let fortran = file.order() == Order::Fortran;
    require!(
        !fortran || file.shape().len() < 4,
        ArrayError::Unfit,
        "has four dimensions in Fortran order, expected C order"
    );
    let mut counts = vec![0; shape.values()];
    for (index, value) in file.data::<T>().map_err(Error::other)?.enumerate() {
        let value = value.map_err(damaged).context("damaged")?;
        let index = if fortran { shape.place_of_fortran(index) } else { index };
        counts[index] = value.count().ok_or_else(|| shape.unfit(index, value))?;
    }
    Ok(shape.filled(counts))
}
