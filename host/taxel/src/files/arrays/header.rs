//! Header of a NumPy array, before its values: their type, order and shape.

use crate::error::{ArrayError, Context, Error, Result};
use std::fmt;
use std::io::{self, ErrorKind, Read};

/// Magic of the format.
pub const MAGIC: &[u8] = b"\x93NUMPY";

/// Size limit of a header; those of plain arrays have 118 bytes or a little more.
const LONGEST: usize = 1 << 16;

/// The header of an array.
#[derive(Debug, PartialEq, Eq)]
pub struct Header {
    /// Number of bytes before the values.
    pub bytes: u64,
    /// Type of the values; none for records.
    pub dtype: Option<Dtype>,
    /// True if the first index runs fastest.
    pub fortran: bool,
    /// The dimensions.
    pub shape: Vec<u64>,
}

/// Type of the values of an array.
#[derive(Debug, PartialEq, Eq)]
pub struct Dtype {
    /// Name in NumPy, for example `<u2`.
    name: String,
    /// Class of a value: `u` and `i` are integers, `f` floating-point numbers, `U` texts.
    pub class: char,
    /// Bytes of a value; 0 if that is not stated.
    pub width: usize,
    /// True if the first byte of a number is its most significant one.
    pub big_endian: bool,
}

impl fmt::Display for Dtype {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.name)
    }
}

impl Dtype {
    /// Bytes of a character of a text.
    const CHARACTER: usize = 4;

    fn of(name: &str) -> Option<Dtype> {
        let big_endian = match name.chars().next()? {
            '<' | '|' => false,
            '>' => true,
            _ => return None,
        };
        let class = name[1..].chars().next()?;
        let size = name[1 + class.len_utf8()..].parse().unwrap_or(0usize);
        let width = if class == 'U' { size.checked_mul(Dtype::CHARACTER)? } else { size };
        Some(Dtype { name: name.to_string(), class, width, big_endian })
    }
}

impl Header {
    /// Reads everything before the values.
    pub fn read(source: &mut impl Read) -> Result<Header> {
        let mut more = |bytes: usize| -> Result<Vec<u8>> {
            let mut piece = vec![0; bytes];
            source.read_exact(&mut piece).map_err(damaged).context("truncated in its header")?;
            Ok(piece)
        };
        let start = more(MAGIC.len() + 2)?;
        require!(start.starts_with(MAGIC), ArrayError::NotAnArray, "not a NumPy array");
        let version = start[MAGIC.len()];
        require!(
            (1..=3).contains(&version),
            ArrayError::Damaged,
            "has a header of version {version}, expected 1 to 3"
        );
        let length = more(if version == 1 { 2 } else { 4 })?;
        let before = start.len() + length.len();
        let length = length.iter().rev().fold(0, |sum, byte| sum << 8 | usize::from(*byte));
        require!(
            length <= LONGEST,
            ArrayError::Damaged,
            "has a header of {length} bytes, expected at most {LONGEST}"
        );
        let text = more(length)?;
        let header = std::str::from_utf8(&text).ok().and_then(Header::of);
        let header = header.map(|header| Header { bytes: (before + length) as u64, ..header });
        let why = "has a header that is not one of a NumPy array";
        header.ok_or_else(|| error!(ArrayError::Damaged, "{why}"))
    }

    /// Reads the dictionary of three keys, each once, in any order.
    fn of(text: &str) -> Option<Header> {
        let mut literal = Literal(text);
        let (mut dtype, mut fortran, mut shape) = (None, None, None);
        literal.sign('{')?;
        while literal.sign('}').is_none() {
            let key = literal.text()?;
            literal.sign(':')?;
            let is_new = match key {
                "descr" => dtype.replace(literal.dtype()?).is_none(),
                "fortran_order" => fortran.replace(literal.truth()?).is_none(),
                "shape" => shape.replace(literal.sizes()?).is_none(),
                _ => false,
            };
            if !is_new || (literal.sign(',').is_none() && !literal.0.trim_start().starts_with('}')) {
                return None;
            }
        }
        let is_all = literal.0.trim().is_empty();
        is_all.then_some(Header { bytes: 0, dtype: dtype?, fortran: fortran?, shape: shape? })
    }

    /// Bytes of the values; none if there is no such number.
    pub fn body(&self) -> Option<u64> {
        let width = self.dtype.as_ref().map_or(0, |dtype| dtype.width as u64);
        self.shape.iter().try_fold(width, |product, size| product.checked_mul(*size))
    }
}

/// An error of the bytes, unless it is one of the system.
pub fn damaged(error: io::Error) -> Error {
    match error.raw_os_error() {
        None if error.kind() != ErrorKind::UnexpectedEof => ArrayError::Damaged(error.to_string()).into(),
        _ => error.into(),
    }
}

/// The rest of a Python literal, as far as NumPy writes one.
struct Literal<'a>(&'a str);

impl<'a> Literal<'a> {
    /// Takes a sign; none if another one is next.
    fn sign(&mut self, sign: char) -> Option<()> {
        self.0 = self.0.trim_start().strip_prefix(sign)?;
        Some(())
    }

    /// Takes a text in quotes.
    fn text(&mut self) -> Option<&'a str> {
        let rest = self.0.trim_start();
        let quote = rest.chars().next().filter(|sign| matches!(sign, '\'' | '"'))?;
        let (text, rest) = rest[1..].split_once(quote)?;
        self.0 = rest;
        Some(text)
    }

    /// Takes a word or a number.
    fn word(&mut self) -> &'a str {
        let rest = self.0.trim_start();
        let end = rest.find(|sign: char| !sign.is_ascii_alphanumeric()).unwrap_or(rest.len());
        let (word, rest) = rest.split_at(end);
        self.0 = rest;
        word
    }

    fn truth(&mut self) -> Option<bool> {
        match self.word() {
            "True" => Some(true),
            "False" => Some(false),
            _ => None,
        }
    }

    /// Takes a tuple of sizes.
    fn sizes(&mut self) -> Option<Vec<u64>> {
        let mut sizes = Vec::new();
        self.sign('(')?;
        while self.sign(')').is_none() {
            sizes.push(self.word().parse().ok()?);
            if self.sign(',').is_none() && !self.0.trim_start().starts_with(')') {
                return None;
            }
        }
        Some(sizes)
    }

    /// Takes a type: a name, or the list of a record's fields, which is passed over.
    fn dtype(&mut self) -> Option<Option<Dtype>> {
        if self.sign('[').is_none() {
            return Some(Some(Dtype::of(self.text()?)?));
        }
        let mut depth = 1;
        while depth > 0 {
            self.0 = self.0.trim_start_matches(|sign| !matches!(sign, '[' | ']' | '\'' | '"'));
            if self.sign('[').is_some() {
                depth += 1;
            } else if self.sign(']').is_some() {
                depth -= 1;
            } else {
                self.text()?;
            }
        }
        Some(None)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_dictionary_is_read_as_numpy_writes_it() {
        let dtype = |name: &str, class, width, big_endian| {
            Some(Dtype { name: name.to_string(), class, width, big_endian })
        };
        for (text, want) in [
            ("{'descr': '<u2', 'fortran_order': False, 'shape': (2, 3), }  \n", dtype("<u2", 'u', 2, false)),
            ("{\"shape\":(2,3),\"descr\":\">f8\",\"fortran_order\":False}", dtype(">f8", 'f', 8, true)),
            ("{'descr': '<U7', 'fortran_order': False, 'shape': (2, 3)}", dtype("<U7", 'U', 28, false)),
            (
                "{'descr': '<M8[ns]', 'fortran_order': False, 'shape': (2, 3)}",
                dtype("<M8[ns]", 'M', 0, false),
            ),
            (
                "{'descr': [('a]', '<u2', (3,)), ('b', [('c', '|u1')])], 'fortran_order': False, 'shape': (2, 3), }",
                None,
            ),
        ] {
            let want = Header { bytes: 0, dtype: want, fortran: false, shape: vec![2, 3] };
            assert_eq!(Header::of(text), Some(want), "{text}");
        }
        let one = Header::of("{'descr': '|b1', 'fortran_order': True, 'shape': (5,), }").unwrap();
        assert_eq!((one.fortran, &one.shape[..], one.body()), (true, &[5][..], Some(5)));
        let none = Header::of("{'descr': '|b1', 'fortran_order': True, 'shape': (), }").unwrap();
        assert_eq!(none.body(), Some(1));
    }

    #[test]
    fn what_numpy_does_not_write_is_refused() {
        for text in [
            "",
            "{",
            "{}",
            "{'descr': '<u2', 'fortran_order': False}",
            "{'descr': '<u2', 'fortran_order': False, 'shape': (2, 3)",
            "{'descr': '<u2', 'fortran_order': False, 'shape': (2, 3)} more",
            "{'descr': '<u2' 'fortran_order': False, 'shape': (2, 3)}",
            "{'descr': '<u2', 'fortran_order': False, 'shape': (2 3)}",
            "{'descr': '<u2', 'fortran_order': False, 'shape': (2, , 3)}",
            "{'descr': '<u2', 'fortran_order': False, 'shape': [2, 3]}",
            "{'descr': '<u2', 'fortran_order': 0, 'shape': (2, 3)}",
            "{'descr': '<u2', 'fortran_order': False, 'shape': (2, 3), 'shape': (2, 3)}",
            "{'descr': '<u2', 'fortran_order': False, 'shape': (2, 3), 'more': 1}",
            "{'descr': 'u2', 'fortran_order': False, 'shape': (2, 3)}",
            "{'descr': '<', 'fortran_order': False, 'shape': (2, 3)}",
            "{'descr': [('a', '<u2', 'fortran_order': False, 'shape': (2, 3)}",
            "{'descr': '<u2, 'fortran_order': False, 'shape': (2, 3)}",
        ] {
            assert_eq!(Header::of(text), None, "{text}");
        }
    }
}
