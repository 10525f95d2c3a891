//! A table: one row per taxel and frame.
//!
//! | column | what |
//! |---|---|
//! | `time_us` | start of the scan in board time, us |
//! | `panel_name`, `row`, `column` | place of the taxel |
//! | `x_mm`, `y_mm` | on its panel, mm from the first taxel; empty if the pitch is unknown |
//! | `link` | link of the robot |
//! | `x_m`, `y_m`, `z_m` | in the link's frame, m; empty, because a garment does not give the place of a panel on its link |
//! | `volts` | at the converter; empty if the scan's raw codes were not recorded (`taxel record --raw`) |
//! | `pressure`, `unit` | conditioned: `kPa`, `N` on the taxel if the pitch is unknown, `counts` if newtons are unknown |
//! | `force_basis` | what kPa and N rest on: `calibrated`, `nominal`, `simulated`; empty for counts |
//!
//! Rows are assembled from texts that are formatted once: the beginning of a taxel's rows, each voltage, each
//! pressure.

use super::frames::{self, Frame, Frames, RecordedGarment};
use anyhow::Result;
use std::io::Write;
use std::rc::Rc;
use taxel_core::garment::Area;

/// The converter's largest code at any depth: fewer bits are spread over the same range.
const GREATEST: f64 = 4095.0;
/// Bytes written at once.
const PIECE: usize = 1 << 16;

/// Options of the table.
#[derive(Debug, Clone, Copy)]
pub struct ContactTable {
    /// Only taxels with pressure.
    pub touched: bool,
    /// Reference voltage of the converter, V.
    pub reference: f64,
}

impl ContactTable {
    /// Writes the table. Returns the number of frames, and of those with voltages.
    pub fn write(&self, frames: &Frames<'_>, out: &mut impl Write) -> Result<[u64; 2]> {
        let mut texts = Texts::default();
        texts.buffer.extend(
            b"time_us,panel_name,row,column,x_mm,y_mm,link,x_m,y_m,z_m,volts,pressure,unit,force_basis\n",
        );
        let mut with_volts = 0;
        let count = frames.each("exporting", |frame| {
            with_volts += u64::from(!frame.codes.is_empty());
            self.frame(frame, &mut texts, out)
        })?;
        out.write_all(&texts.buffer)?;
        Ok([count, with_volts])
    }

    fn frame(&self, frame: &Frame, texts: &mut Texts, out: &mut impl Write) -> Result<()> {
        let time = frame.board_us.to_string();
        let recorded = &frame.recorded;
        for (panel, area) in recorded.layout.areas().iter().enumerate() {
            let values = frames::panel(area, &frame.values);
            let codes = frames::panel(area, &frame.codes);
            if texts.panels.len() == panel {
                texts.panels.push(PanelRows::of(area));
            }
            let Texts { buffer, panels, volts } = texts;
            let PanelRows { heads, tails } = &mut panels[panel];
            for (index, (counts, head)) in values.iter().zip(heads).enumerate() {
                if self.touched && *counts == 0 {
                    continue;
                }
                buffer.extend_from_slice(time.as_bytes());
                buffer.extend_from_slice(head.as_bytes());
                if let Some(code) = codes.get(index) {
                    volts.put(*code, buffer, || {
                        format!("{:.4}", f64::from(*code) * self.reference / GREATEST)
                    });
                }
                tails.put(*counts, buffer, || tail(recorded, panel, *counts));
            }
            if buffer.len() >= PIECE {
                out.write_all(buffer)?;
                buffer.clear();
            }
        }
        Ok(())
    }
}

/// End of a row: pressure and unit.
fn tail(recorded: &Rc<RecordedGarment>, panel: usize, counts: u16) -> String {
    let (unit, value) = (recorded.units.name(panel), recorded.units.value(panel, counts));
    let pressure = if unit == "counts" { value.to_string() } else { format!("{value:.4}") };
    let basis = if unit == "counts" { "" } else { recorded.units.basis() };
    format!(",{pressure},{unit},{basis}\n")
}

/// Texts of a recording, and rows to be written.
#[derive(Default)]
struct Texts {
    buffer: Vec<u8>,
    panels: Vec<PanelRows>,
    volts: Memo,
}

/// Beginnings of the rows of each taxel after the time, and ends of the rows by pressure.
struct PanelRows {
    heads: Vec<String>,
    tails: Memo,
}

impl PanelRows {
    fn of(area: &Area) -> PanelRows {
        let [x, y] = area.pitch_um.map(|um| f64::from(um) / 1000.0);
        let place = |index: u16, pitch: f64| {
            if pitch > 0.0 { format!("{:.3}", f64::from(index) * pitch) } else { String::new() }
        };
        let (name, link) = (quoted(&area.name), quoted(&area.link));
        let cells = (0..area.rows).flat_map(|row| (0..area.columns).map(move |column| (row, column)));
        let head = |(row, column)| {
            format!(",{name},{row},{column},{},{},{link},,,,", place(column, x), place(row, y))
        };
        PanelRows { heads: cells.map(head).collect(), tails: Memo::default() }
    }
}

/// Texts by number, each formatted once.
#[derive(Default)]
struct Memo(Vec<Option<Box<str>>>);

impl Memo {
    fn put(&mut self, number: u16, out: &mut Vec<u8>, make: impl FnOnce() -> String) {
        let index = usize::from(number);
        if self.0.len() <= index {
            self.0.resize(index + 1, None);
        }
        let text = self.0[index].get_or_insert_with(|| make().into());
        out.extend_from_slice(text.as_bytes());
    }
}

/// Formats a name as a field. An apostrophe precedes a name that a spreadsheet would take for a formula.
pub fn quoted(name: &str) -> String {
    let before = if name.starts_with(['=', '+', '-', '@', '\t', '\r']) { "'" } else { "" };
    let quote = if name.contains([',', '"', '\n', '\r']) { "\"" } else { "" };
    format!("{quote}{before}{}{quote}", name.replace('"', "\"\""))
}
