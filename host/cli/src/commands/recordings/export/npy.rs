//! NumPy arrays of an archive, each written to a file of its own until all are complete: an archive takes one
//! after the other, a recording yields all at once.

use super::archive::Archive;
use anyhow::Result;
use std::fs::File;
use std::io::{BufReader, BufWriter, Seek, Write};
use std::path::Path;
use taxel::files::output::Scratch;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipArchive};

/// Deflate level: most of a garment is 0 most of the time, which even the fastest level compresses to a
/// hundredth.
const LEVEL: i64 = 1;
/// Bytes compressed at once.
const PIECE: usize = 1 << 16;

/// A number with a little-endian NumPy type.
pub trait Number: Copy {
    /// Name of the type in NumPy.
    const KIND: &'static str;
    /// Appends its bytes.
    fn put(self, out: &mut Vec<u8>);
}

macro_rules! numbers {
    ($($kind:ty: $name:expr),*) => {
        $(impl Number for $kind {
            const KIND: &'static str = $name;
            fn put(self, out: &mut Vec<u8>) {
                out.extend_from_slice(&self.to_le_bytes());
            }
        })*
    };
}

numbers!(u16: "<u2", u32: "<u4", u64: "<u8", f64: "<f8");

/// An array being written.
pub struct Array {
    archive: Archive<BufWriter<File>>,
    scratch: Scratch,
    waiting: Vec<u8>,
}

impl Array {
    /// Begins an array with this name, type and shape, beside the `output`.
    pub fn begin(output: &Path, name: &str, kind: &str, shape: &[u64]) -> Result<Array> {
        let scratch = Scratch::beside(output)?;
        let mut archive = Archive::new(BufWriter::new(scratch.file.try_clone()?));
        let options = SimpleFileOptions::default().large_file(true);
        let options = options.compression_method(CompressionMethod::Deflated).compression_level(Some(LEVEL));
        archive.zip.start_file(format!("{name}.npy"), options)?;
        Ok(Array { archive, scratch, waiting: head(kind, shape) })
    }

    /// Adds numbers.
    pub fn put<T: Number>(&mut self, values: impl IntoIterator<Item = T>) -> Result<()> {
        values.into_iter().for_each(|value| value.put(&mut self.waiting));
        if self.waiting.len() >= PIECE {
            self.archive.zip.write_all(&self.waiting)?;
            self.waiting.clear();
        }
        Ok(())
    }

    /// Copies the array into an archive.
    pub fn finish(mut self, into: &mut Archive<impl Write + Seek>) -> Result<()> {
        self.archive.zip.write_all(&self.waiting)?;
        self.archive.finish()?.flush()?;
        let mut archive = ZipArchive::new(BufReader::new(&self.scratch.file))?;
        Ok(into.zip.raw_copy_file(archive.by_index_raw(0)?)?)
    }
}

/// Header of an array: version 1 of the format, padded to a multiple of 64 bytes.
fn head(kind: &str, shape: &[u64]) -> Vec<u8> {
    let sizes: String = shape.iter().map(|size| format!("{size}, ")).collect();
    let mut text =
        format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': ({}), }}", sizes.trim_end());
    // Magic, version, length of the text; the text ends with a newline.
    let before = 10;
    while (before + text.len() + 1) % 64 != 0 {
        text.push(' ');
    }
    text.push('\n');
    let mut head = b"\x93NUMPY\x01\x00".to_vec();
    head.extend((text.len() as u16).to_le_bytes());
    head.extend(text.bytes());
    head
}
