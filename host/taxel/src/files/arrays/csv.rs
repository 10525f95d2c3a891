//! Frames from text.

use super::{Frames, Shape, count, unfit};
use crate::error::{ArrayError, Context, Result};
use std::fs::File;
use std::io::Read;

/// Reads the frames of a file.
pub fn read(mut file: File) -> Result<Frames> {
    let mut text = String::new();
    file.read_to_string(&mut text)
        .map_err(|error| ArrayError::NotAnArray(error.to_string()))
        .context("not a text")?;
    parse(&text)
}

/// Parses the frames of a text.
pub fn parse(text: &str) -> Result<Frames> {
    let mut table = ParsedFrames::default();
    for (line, text) in text.trim_start_matches('\u{feff}').lines().enumerate() {
        match text.trim() {
            "" => table.end_frame(),
            comment if comment.starts_with('#') => Ok(()),
            row => table.push(row),
        }
        .with_context(|| format!("line {}", line + 1))?;
    }
    table.end_frame().context("at its end")?;
    table.finish()
}

/// Frames parsed so far.
#[derive(Default)]
struct ParsedFrames {
    values: Vec<u16>,
    /// Columns of the first row.
    columns: usize,
    /// Rows of the first frame, once it is complete.
    rows: Option<usize>,
    /// Complete frames.
    frames: usize,
    /// Rows of the incomplete frame.
    row: usize,
}

impl ParsedFrames {
    fn push(&mut self, text: &str) -> Result<()> {
        let start = self.values.len();
        for (column, cell) in text.split(',').map(str::trim).enumerate() {
            let number: Option<f64> = cell.parse().ok();
            let number = number
                .ok_or_else(|| error!(ArrayError::Unfit, "column {column}: {cell:?} is not a number"))?;
            let value = count(number).ok_or_else(|| unfit(self.frames, self.row, column, number))?;
            self.values.push(value);
        }
        let columns = self.values.len() - start;
        if start == 0 {
            self.columns = columns;
        }
        require!(
            columns == self.columns,
            ArrayError::Unfit,
            "{columns} columns, and the first row has {}",
            self.columns
        );
        self.row += 1;
        Ok(())
    }

    /// Ends a frame at a blank line or at the end; consecutive blank lines count as one.
    fn end_frame(&mut self) -> Result<()> {
        if self.row > 0 {
            let rows = *self.rows.get_or_insert(self.row);
            require!(
                rows == self.row,
                ArrayError::Unfit,
                "frame {} has {} rows, and the first {rows}",
                self.frames,
                self.row
            );
            self.frames += 1;
            self.row = 0;
        }
        Ok(())
    }

    fn finish(self) -> Result<Frames> {
        let Some(rows) = self.rows else { fail!(ArrayError::Unfit, "there are no values") };
        let shape = Shape::of(&[self.frames as u64, rows as u64, self.columns as u64])?;
        Ok(shape.filled(self.values))
    }
}
