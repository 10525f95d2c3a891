//! Recorded frames from files: NumPy's `.npy` and `.npz`, and CSV.
//!
//! | file | frames |
//! |---|---|
//! | `.npy` | one array `[frames, rows, columns]` or `[rows, columns]`, of integers or of floats that hold integers |
//! | `.npz` | named arrays like that |
//! | `.csv`, `.txt` | a row per line, numbers separated by commas, a blank line between frames; `#` starts a comment |
//!
//! Every value is an integer in 0 ..= 65535; else the error names file, array, frame, row and column (all
//! from 0).

mod csv;
mod header;
mod npy;
mod npz;
mod room;

use super::input;
use crate::error::{ArrayError, Context, Error, FileError, Result, UsageError};
use room::Room;
use std::fs::File;
use std::io::{Read, Seek};
use std::path::Path;

/// Frames of one array, all of the same size.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Frames {
    /// Rows of a frame (y).
    pub rows: u16,
    /// Columns of a frame (x).
    pub columns: u16,
    /// Number of frames, at least one.
    pub count: usize,
    /// Values in frame order; each frame in row order.
    pub values: Vec<u16>,
}

impl Frames {
    /// Returns frame `n`; none past the last.
    pub fn frame(&self, n: usize) -> Option<&[u16]> {
        self.iter().nth(n)
    }

    /// Iterates over the frames.
    pub fn iter(&self) -> std::slice::ChunksExact<'_, u16> {
        self.values.chunks_exact(usize::from(self.rows) * usize::from(self.columns))
    }
}

/// Reads the array with this name; without a name the only array whose shape is that of frames.
pub fn read(path: &Path, array: Option<&str>) -> Result<Frames> {
    let read = || match (open(path)?, array) {
        (OpenFile::Archive(mut archive), Some(name)) => archive.named(name),
        (OpenFile::Archive(mut archive), None) => archive.only(),
        (_, Some(name)) => {
            fail!(UsageError::Argument, "holds one array without a name, so array {name} cannot be chosen")
        }
        (single, None) => single.frames(),
    };
    read().with_context(|| path.display().to_string())
}

/// Reads all arrays of two or three dimensions, ordered by name. A single unnamed array gets the name of the
/// file.
pub fn read_all(path: &Path) -> Result<Vec<(String, Frames)>> {
    let read = || match open(path)? {
        OpenFile::Archive(mut archive) => archive.all(),
        single => {
            let name = path.file_stem().unwrap_or_default().to_string_lossy();
            Ok(vec![(name.into_owned(), single.frames()?)])
        }
    };
    read().with_context(|| path.display().to_string())
}

/// Names of an archive's arrays, in order; none for other files.
pub fn names(path: &Path) -> Result<Vec<String>> {
    archive(path, |archive| Ok(archive.names().to_vec()))
}

/// Reads a one-dimensional array of counts, such as labels, from an archive; none if it is missing.
pub fn list(path: &Path, array: &str) -> Result<Option<Vec<u16>>> {
    archive(path, |archive| archive.list(array))
}

/// Reads a one-dimensional array of texts, such as class names, from an archive; none if it is missing.
pub fn texts(path: &Path, array: &str) -> Result<Option<Vec<String>>> {
    archive(path, |archive| archive.texts(array))
}

/// Reads from an archive; returns the default for other files.
fn archive<T: Default>(path: &Path, read: impl FnOnce(&mut npz::Archive) -> Result<T>) -> Result<T> {
    let read = || match open(path)? {
        OpenFile::Archive(mut archive) => read(&mut archive),
        _ => Ok(T::default()),
    };
    read().with_context(|| path.display().to_string())
}

/// An open file of known kind.
enum OpenFile {
    Array(File, u64),
    Archive(npz::Archive),
    Text(File),
}

impl OpenFile {
    fn frames(self) -> Result<Frames> {
        match self {
            // Values are uncompressed, so they take at most twice the size of the file.
            OpenFile::Array(file, size) => npy::read(file, size, &mut Room::endless()),
            OpenFile::Archive(mut archive) => archive.only(),
            OpenFile::Text(file) => csv::read(file),
        }
    }
}

/// Opens a file. Its kind is detected by its first bytes; by its name if they are not conclusive.
fn open(path: &Path) -> Result<OpenFile> {
    let mut file = input::open(path).context("cannot be read")?;
    let mut start = Vec::new();
    let unread = |error| FileError::read(path, error);
    (&file).take(8).read_to_end(&mut start).map_err(unread).context("cannot be read")?;
    let size = file.metadata().context("cannot be read")?.len();
    file.rewind().context("cannot be read")?;
    let extension = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    match extension.as_str() {
        _ if start.starts_with(header::MAGIC) => Ok(OpenFile::Array(file, size)),
        _ if start.starts_with(b"PK") => npz::Archive::open(file).map(OpenFile::Archive),
        "csv" | "txt" => Ok(OpenFile::Text(file)),
        "npy" => fail!(ArrayError::NotAnArray, "not a NumPy array"),
        "npz" => fail!(ArrayError::NotAnArray, "not a NumPy archive"),
        _ => fail!(ArrayError::NotAnArray, "not an array file: expected .npy, .npz or .csv"),
    }
}

/// Shape of an array of frames.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Shape {
    frames: usize,
    rows: u16,
    columns: u16,
}

impl Shape {
    /// Shape from the dimensions of an array. The number of values fits a `usize`.
    fn of(dimensions: &[u64]) -> Result<Shape> {
        let (frames, rows, columns) = match *dimensions {
            [rows, columns] => (1, rows, columns),
            [frames, rows, columns] => (frames, rows, columns),
            // Recordings of equal length, one after the other.
            [recordings, frames, rows, columns] => (recordings.saturating_mul(frames), rows, columns),
            _ => fail!(
                ArrayError::Unfit,
                "shape {dimensions:?}: expected [frames, rows, columns] or [rows, columns]"
            ),
        };
        if dimensions.contains(&0) {
            fail!(ArrayError::Unfit, "shape {dimensions:?}: there are no values");
        }
        let small = |n: u64| u16::try_from(n).ok();
        let checked = || {
            let shape =
                Shape { frames: frames.try_into().ok()?, rows: small(rows)?, columns: small(columns)? };
            shape.frames.checked_mul(shape.area()).map(|_| shape)
        };
        checked().ok_or_else(|| {
            error!(ArrayError::Unfit, "shape {dimensions:?}: a frame has at most 65535 rows and columns")
        })
    }

    /// Shape of a one-dimensional array: one frame of one row.
    fn of_list(dimensions: &[u64]) -> Result<Shape> {
        match *dimensions {
            [n @ 1..=65535] => Ok(Shape { frames: 1, rows: 1, columns: n as u16 }),
            _ => {
                fail!(ArrayError::Unfit, "shape {dimensions:?}: expected one dimension of 1 to 65535 values")
            }
        }
    }

    fn area(self) -> usize {
        usize::from(self.rows) * usize::from(self.columns)
    }

    fn values(self) -> usize {
        self.frames * self.area()
    }

    /// Converts index `index` in Fortran order to frame and row order.
    fn place_of_fortran(self, index: usize) -> usize {
        let (rest, frame) = (index / self.frames, index % self.frames);
        let (column, row) = (rest / usize::from(self.rows), rest % usize::from(self.rows));
        frame * self.area() + row * usize::from(self.columns) + column
    }

    /// Error about the value at `index`, in frame and row order.
    fn unfit(self, index: usize, value: impl std::fmt::Display) -> Error {
        let (frame, taxel) = (index / self.area(), index % self.area());
        let (row, column) = (taxel / usize::from(self.columns), taxel % usize::from(self.columns));
        unfit(frame, row, column, value)
    }

    fn filled(self, values: Vec<u16>) -> Frames {
        Frames { rows: self.rows, columns: self.columns, count: self.frames, values }
    }
}

fn unfit(frame: usize, row: usize, column: usize, value: impl std::fmt::Display) -> Error {
    error!(
        ArrayError::Unfit,
        "frame {frame}, row {row}, column {column}: {value} is not an integer in 0 ..= 65535"
    )
}

/// Converts a float that is exactly a count.
fn count(value: f64) -> Option<u16> {
    (value.fract() == 0.0 && (0.0..=65535.0).contains(&value)).then_some(value as u16)
}

#[cfg(test)]
mod tests;
