//! A table: one row a taxel and frame.
//!
//! | column | what |
//! |---|---|
//! | `time` | the board's, s |
//! | `panel`, `row`, `column` | where the taxel is |
//! | `x`, `y` | on its panel, mm from the first taxel; empty where the pitch is unknown |
//! | `link` | of the robot |
//! | `X`, `Y`, `Z` | in the link's frame, m; empty: a garment does not say yet how a panel lies on its link |
//! | `volts` | at the converter, of its 3.3 V; where raw codes were recorded |
//! | `pressure`, `unit` | conditioned, and its unit: counts |

use super::frames::{self, Frames};
use anyhow::{Context, Result};
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;

/// The converter's reference, V, and its largest code.
const REFERENCE: [f64; 2] = [3.3, 4095.0];

/// Writes the table; the number of frames.
pub fn write(frames: &Frames<'_>, touched: bool, path: &Path) -> Result<u64> {
    let mut out = BufWriter::new(File::create(path).context("it cannot be written")?);
    writeln!(out, "time,panel,row,column,x,y,link,X,Y,Z,volts,pressure,unit")?;
    let count = frames.each(|frame| {
        let time = frame.board_us as f64 / 1e6;
        let raw = frame.client.raw();
        for area in frame.layout.areas() {
            let [x, y] = area.pitch_um.map(|um| f64::from(um) / 1000.0);
            let place = |index: u16, pitch: f64| {
                if pitch > 0.0 { format!("{:.3}", f64::from(index) * pitch) } else { String::new() }
            };
            let cells = (0..area.rows).flat_map(|row| (0..area.columns).map(move |column| (row, column)));
            for ((row, column), (taxel, value)) in
                cells.zip((usize::from(area.base)..).zip(frames::panel(area, frame.values)))
            {
                if touched && *value == 0 {
                    continue;
                }
                let volts = raw.get(taxel).map_or(String::new(), |code| {
                    format!("{:.4}", f64::from(*code) * REFERENCE[0] / REFERENCE[1])
                });
                writeln!(
                    out,
                    "{time:.6},{},{row},{column},{},{},{},,,,{volts},{value},counts",
                    quoted(&area.name),
                    place(column, x),
                    place(row, y),
                    quoted(&area.link)
                )?;
            }
        }
        Ok(())
    })?;
    out.flush()?;
    Ok(count)
}

/// A name as a field.
fn quoted(name: &str) -> String {
    if name.contains([',', '"', '\n']) { format!("\"{}\"", name.replace('"', "\"\"")) } else { name.into() }
}
