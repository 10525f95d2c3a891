//! Panels of a frame, and their JSON text. The general serializer takes most of what a recording costs for these
//! numbers, one for each taxel of each frame; the text is the same.

use crate::error::Result;
use serde::Serialize;

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

/// Zeros of a row.
const ZEROS: &[u8; 64] = b"0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,";

/// Appends the panels, with a comma between two.
pub fn append(text: &mut Vec<u8>, panels: &[PanelImage<'_>]) -> Result<()> {
    for (index, panel) in panels.iter().enumerate() {
        if index > 0 {
            text.push(b',');
        }
        text.extend_from_slice(b"{\"name\":");
        serde_json::to_writer(&mut *text, panel.name)?;
        text.extend_from_slice(format!(",\"total\":{},\"rows\":[", panel.total).as_bytes());
        for row in &panel.rows {
            append_row(text, row);
        }
        end(text, b"]}");
    }
    Ok(())
}

/// Appends a row and a comma.
fn append_row(text: &mut Vec<u8>, row: &[u16]) {
    text.push(b'[');
    for run in row.chunk_by(|a, b| (*a == 0) == (*b == 0)) {
        if run[0] == 0 {
            run.chunks(ZEROS.len() / 2).for_each(|zeros| text.extend_from_slice(&ZEROS[..2 * zeros.len()]));
        } else {
            run.iter().for_each(|value| append_number(text, *value));
        }
    }
    end(text, b"],");
}

/// Appends a number and a comma.
fn append_number(text: &mut Vec<u8>, value: u16) {
    let (mut digits, mut first, mut rest) = (*b"00000,", 5, value);
    while rest > 0 || first == 5 {
        first -= 1;
        digits[first] = b'0' + (rest % 10) as u8;
        rest /= 10;
    }
    text.extend_from_slice(&digits[first..]);
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
        for (rows, columns) in [(0, 1), (1, 1), (3, 16), (32, 64), (2, 100)] {
            let values: Vec<u16> = (0..rows * columns).map(|_| next()).collect();
            let ends = [0, 9, 10, 99, 100, 999, 1000, 9999, 10_000, 65_535];
            let panel = |name, values| PanelImage { name, total: 7, rows: values };
            let panels = [
                panel("mat", values.chunks(columns).collect()),
                panel("left \"arm\"\n", vec![&ends[..], &[]]),
            ];
            let mut text = b"[".to_vec();
            append(&mut text, &panels).unwrap();
            text.push(b']');
            assert_eq!(String::from_utf8(text).unwrap(), serde_json::to_string(&panels).unwrap());
        }
    }
}
