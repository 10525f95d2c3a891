//! Panels of a frame, and their JSON text. The general serializer takes most of what a recording costs for
//! these numbers, one for each taxel of each frame; the text is the same.

use crate::error::Result;
use serde::Serialize;
use std::io::Write;
use std::ops::Range;

/// Pressure of a panel.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PanelImage<'a> {
    /// Name of the panel.
    pub name: &'a str,
    /// Sum of its pressure, counts.
    pub total: u32,
    /// Pressure of each taxel by row, counts.
    pub rows: Vec<&'a [u16]>,
}

/// The taxels of a panel.
#[derive(Debug, Clone, Copy)]
pub struct PanelValues<'a> {
    /// Name of the panel.
    pub name: &'a str,
    /// Number of its columns; at least 1.
    pub columns: usize,
    /// Pressure of its taxels by row, counts.
    pub values: &'a [u16],
    /// Sum of it, counts.
    pub total: u32,
}

impl<'a> PanelValues<'a> {
    /// The taxels of a panel with so many columns, by row.
    pub fn new(name: &'a str, columns: u16, values: &'a [u16]) -> PanelValues<'a> {
        let total = values.iter().map(|value| u32::from(*value)).sum();
        // A panel with taxels has columns.
        PanelValues { name, columns: usize::from(columns.max(1)), values, total }
    }
}

/// Where the last row without pressure is in the text, and the number of its taxels.
type EmptyRow = Option<(usize, Range<usize>)>;

/// Values whose text is made at a time.
const PIECE: usize = 32;
/// Longest number and its comma, bytes.
const LONGEST: usize = 6;

/// Appends the panels, each as a [`PanelImage`], with a comma between two.
pub fn append(text: &mut Vec<u8>, panels: &[PanelValues<'_>]) -> Result<()> {
    let mut empty = None;
    for (index, panel) in panels.iter().enumerate() {
        if index > 0 {
            text.push(b',');
        }
        text.extend_from_slice(b"{\"name\":");
        serde_json::to_writer(&mut *text, panel.name)?;
        write!(text, ",\"total\":{},\"rows\":[", panel.total)?;
        panel.values.chunks(panel.columns).for_each(|row| append_row(text, row, &mut empty));
        end(text, b"]}");
    }
    Ok(())
}

/// Appends a row and a comma. Most rows have no pressure: their text is that of the last such row.
fn append_row(text: &mut Vec<u8>, row: &[u16], empty: &mut EmptyRow) {
    // All of them at once: faster than to look for the first that is not 0.
    let is_empty = row.iter().fold(0, |all, value| all | value) == 0;
    if let Some((length, range)) = empty
        && is_empty
        && *length == row.len()
    {
        text.extend_from_within(range.clone());
    } else {
        let start = text.len();
        text.push(b'[');
        row.chunks(PIECE).for_each(|values| append_numbers(text, values));
        end(text, b"]");
        if is_empty {
            // Without its comma, which the end of the panel takes away.
            *empty = Some((row.len(), start..text.len()));
        }
    }
    text.push(b',');
}

/// Appends at most [`PIECE`] numbers, each with a comma.
fn append_numbers(text: &mut Vec<u8>, values: &[u16]) {
    let (mut digits, mut length) = ([b','; LONGEST * PIECE], 0);
    for value in values {
        let mut rest = *value;
        let end = length + rest.checked_ilog10().map_or(1, |log| 1 + log as usize);
        for digit in digits[length..end].iter_mut().rev() {
            *digit = b'0' + (rest % 10) as u8;
            rest /= 10;
        }
        length = end + 1;
    }
    text.extend_from_slice(&digits[..length]);
}

/// Ends a list: its last comma goes.
fn end(text: &mut Vec<u8>, by: &[u8]) {
    text.pop_if(|last| *last == b',');
    text.extend_from_slice(by);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_text_is_that_of_the_general_serializer() {
        let mut random = 1u32;
        let mut next = || {
            random = random.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            // Zeros in runs, and numbers of all lengths.
            if random >> 30 == 0 { (random >> 8) as u16 >> (random >> 24 & 15) } else { 0 }
        };
        for (rows, columns) in [(0, 1u16), (1, 1), (3, 16), (32, 64), (2, 100)] {
            let values: Vec<u16> = (0..rows * usize::from(columns)).map(|_| next()).collect();
            let ends = [0, 9, 10, 99, 100, 999, 1000, 9999, 10_000, 65_535];
            let panel = |name, columns, values| PanelValues::new(name, columns, values);
            let zeros = [0; 30];
            let panels = [
                panel("none", 10, &zeros),
                panel("mat", columns, &values),
                panel("left \"arm\"\n", 5, &ends),
                panel("none, too", 10, &zeros),
                panel("of other rows", 15, &zeros),
                panel("of fewer", 15, &zeros[..15]),
                panel("of one row", 7, &zeros[..7]),
                panel("of one row, too", 7, &zeros[..7]),
            ];
            let mut text = b"[".to_vec();
            append(&mut text, &panels).unwrap();
            text.push(b']');
            let wanted = panels.map(|panel| PanelImage {
                name: panel.name,
                total: panel.values.iter().map(|value| u32::from(*value)).sum(),
                rows: panel.values.chunks(panel.columns).collect(),
            });
            assert_eq!(String::from_utf8(text).unwrap(), serde_json::to_string(&wanted).unwrap());
        }
    }
}
