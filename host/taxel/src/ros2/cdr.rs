//! Common Data Representation, little-endian, as used by ROS 2: each number is aligned to its own size,
//! counted from behind the header of four bytes; sequences and strings are preceded by their length (u32),
//! strings end with a 0.

/// A message being written.
#[derive(Debug, Clone)]
pub struct Cdr {
    bytes: Vec<u8>,
}

/// Header before the message: the representation, plain and little-endian.
const HEAD: [u8; 4] = [0, 1, 0, 0];

impl Default for Cdr {
    fn default() -> Cdr {
        Cdr { bytes: HEAD.to_vec() }
    }
}

impl Cdr {
    fn aligned<const N: usize>(mut self, number: [u8; N]) -> Cdr {
        let over = (self.bytes.len() - HEAD.len()) % N;
        if over > 0 {
            self.bytes.resize(self.bytes.len() + N - over, 0);
        }
        self.bytes.extend(number);
        self
    }

    /// `uint8`, `byte` or `bool`
    pub fn u8(self, value: u8) -> Cdr {
        self.aligned([value])
    }

    /// `uint16`
    pub fn u16(self, value: u16) -> Cdr {
        self.aligned(value.to_le_bytes())
    }

    /// `int32`
    pub fn i32(self, value: i32) -> Cdr {
        self.aligned(value.to_le_bytes())
    }

    /// `uint32`
    pub fn u32(self, value: u32) -> Cdr {
        self.aligned(value.to_le_bytes())
    }

    /// `uint64`
    pub fn u64(self, value: u64) -> Cdr {
        self.aligned(value.to_le_bytes())
    }

    /// `float64`
    pub fn f64(self, value: f64) -> Cdr {
        self.aligned(value.to_le_bytes())
    }

    /// `string`
    pub fn text(self, text: &str) -> Cdr {
        let mut cdr = self.u32(text.len() as u32 + 1);
        cdr.bytes.extend(text.bytes());
        cdr.bytes.push(0);
        cdr
    }

    /// Numbers, one after another.
    pub(crate) fn f64s(self, values: impl IntoIterator<Item = f64>) -> Cdr {
        values.into_iter().fold(self, Cdr::f64)
    }

    /// A sequence: its length, and what `add` writes for each element.
    pub fn list<T>(self, all: &[T], add: impl FnMut(Cdr, &T) -> Cdr) -> Cdr {
        all.iter().fold(self.u32(all.len() as u32), add)
    }

    /// `builtin_interfaces/Time`: seconds and nanoseconds.
    pub fn time(self, us: u64) -> Cdr {
        self.i32((us / 1_000_000) as i32).u32((us % 1_000_000) as u32 * 1000)
    }

    /// `uint8[]`
    pub fn data(self, data: &[u8]) -> Cdr {
        let mut cdr = self.u32(data.len() as u32);
        cdr.bytes.extend_from_slice(data);
        cdr
    }

    /// The message, behind the header of four bytes.
    pub fn finish(self) -> Vec<u8> {
        self.bytes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_aligned_behind_the_head() {
        let bytes = Cdr::default().text("ab").u8(7).f64(1.0).u8(1).i32(-1).data(&[9]).finish();
        let expected = [
            &[0, 1, 0, 0][..],
            &[3, 0, 0, 0, b'a', b'b', 0, 7],
            &1f64.to_le_bytes(),
            &[1, 0, 0, 0, 255, 255, 255, 255, 1, 0, 0, 0, 9],
        ];
        assert_eq!(bytes, expected.concat());
    }
}
