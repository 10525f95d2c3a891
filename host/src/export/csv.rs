//! A table: one row a taxel and frame.
//!
//! | column | what |
//! |---|---|
//! | `time` | the board's, s |
//! | `panel`, `row`, `column` | where the taxel is |
//! | `x`, `y` | on its panel, mm from the first taxel; empty where the pitch is unknown |
//! | `link` | of the robot |
//! | `X`, `Y`, `Z` | in the link's frame, m; empty: a garment does not say yet how a panel lies on its link |
//! | `volts` | at the converter; where raw codes of the scan were recorded (`taxel record --raw`) |
//! | `pressure`, `unit` | conditioned: `kPa`, `N` on the taxel where the pitch is unknown, `counts` where nothing says what a newton shows |

use super::frames::{self, Frame, Frames};
use anyhow::{Context, Result};
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;
use taxel_core::garment::Area;

/// The converter's largest code, whatever the bits that are kept: fewer bits are spread over the same range.
const GREATEST: f64 = 4095.0;

/// What the table holds.
#[derive(Debug, Clone, Copy)]
pub struct Table {
    /// Only taxels with pressure.
    pub touched: bool,
    /// The converter's reference, V.
    pub reference: f64,
}

impl Table {
    /// Writes the table; the number of frames.
    pub fn write(&self, frames: &Frames<'_>, path: &Path) -> Result<u64> {
        let mut out = BufWriter::new(File::create(path).context("it cannot be written")?);
        writeln!(out, "time,panel,row,column,x,y,link,X,Y,Z,volts,pressure,unit")?;
        let count = frames.each(|frame| {
            let mut areas = frame.worn.layout.areas().iter().enumerate();
            areas.try_for_each(|(panel, area)| self.panel(&mut out, frame, panel, area))
        })?;
        out.flush()?;
        Ok(count)
    }

    fn panel(&self, out: &mut impl Write, frame: &Frame, panel: usize, area: &Area) -> Result<()> {
        let time = frame.board_us as f64 / 1e6;
        let (name, link) = (quoted(&area.name), quoted(&area.link));
        let units = &frame.worn.units;
        let unit = units.name(panel);
        let [x, y] = area.pitch_um.map(|um| f64::from(um) / 1000.0);
        let place = |index: u16, pitch: f64| {
            if pitch > 0.0 { format!("{:.3}", f64::from(index) * pitch) } else { String::new() }
        };
        let cells = (0..area.rows).flat_map(|row| (0..area.columns).map(move |column| (row, column)));
        let taxels = usize::from(area.base)..;
        for ((row, column), (taxel, counts)) in cells.zip(taxels.zip(frames::panel(area, &frame.values))) {
            if self.touched && *counts == 0 {
                continue;
            }
            let volts = frame
                .codes
                .get(taxel)
                .map_or(String::new(), |code| format!("{:.4}", f64::from(*code) * self.reference / GREATEST));
            let value = units.value(panel, *counts);
            let pressure = if unit == "counts" { value.to_string() } else { format!("{value:.4}") };
            let (x, y) = (place(column, x), place(row, y));
            writeln!(out, "{time:.6},{name},{row},{column},{x},{y},{link},,,,{volts},{pressure},{unit}")?;
        }
        Ok(())
    }
}

/// A name as a field.
fn quoted(name: &str) -> String {
    if name.contains([',', '"', '\n']) { format!("\"{}\"", name.replace('"', "\"\"")) } else { name.into() }
}
