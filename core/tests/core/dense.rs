//! The image by its definition: every taxel of every frame, nothing left out and nothing carried from image to image.

#![allow(dead_code)]

use taxel_core::condition::{ConditionConfig, Filter};
use taxel_core::format::Code;
use taxel_core::garment::Layout;

/// Calibration; the baseline of each frame is for the caller to set.
pub struct Dense {
    pub config: ConditionConfig,
    pub falling: bool,
    pub rest: Vec<u16>,
    pub gain: Vec<u16>,
}

impl Dense {
    /// Gains of 1 but for absent taxels.
    pub fn new(layout: &Layout, config: ConditionConfig, falling: bool, rest: u16) -> Dense {
        let mut gain = Vec::new();
        for (panel, area) in layout.areas().iter().enumerate() {
            for (row, column) in (0..area.rows).flat_map(|row| (0..area.columns).map(move |c| (row, c))) {
                gain.push(if layout.is_absent(panel as u8, row, column) { 0 } else { 4096 });
            }
        }
        Dense { config, falling, rest: vec![rest; layout.taxels()], gain }
    }

    /// The image of a frame.
    pub fn process(&self, layout: &Layout, codes: &[Code], panels: u8) -> Vec<u16> {
        let values: Vec<u16> =
            (0..layout.taxels()).map(|taxel| self.value(layout, codes, panels, taxel)).collect();
        filtered(layout, self.config.filter, &values)
    }

    fn value(&self, layout: &Layout, codes: &[Code], panels: u8, taxel: usize) -> u16 {
        let panel = layout.areas().iter().rposition(|area| usize::from(area.base) <= taxel).unwrap();
        let Some(code) = codes.get(taxel).filter(|_| panels >> panel & 1 == 1) else { return 0 };
        let (code, rest) = (i64::from(code.0), i64::from(self.rest[taxel]));
        let difference = if self.falling { rest - code } else { code - rest }.max(0);
        let value = ((difference * i64::from(self.gain[taxel]) + 2048) >> 12).min(65535) as u16;
        if value < self.config.floor { 0 } else { value }
    }
}

/// All nine of the neighbourhood with the border replicated, or the eight that exist.
fn filtered(layout: &Layout, filter: Filter, values: &[u16]) -> Vec<u16> {
    let mut out = Vec::new();
    for area in layout.areas() {
        let (rows, columns) = (i32::from(area.rows), i32::from(area.columns));
        let at = |y: i32, x: i32| values[usize::from(area.base) + (y * columns + x) as usize];
        for (y, x) in (0..rows).flat_map(|y| (0..columns).map(move |x| (y, x))) {
            let nine = (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| (y + dy, x + dx)));
            let inside = |(y, x): &(i32, i32)| (0..rows).contains(y) && (0..columns).contains(x);
            out.push(match filter {
                Filter::Off => at(y, x),
                Filter::Median => {
                    let mut nine: Vec<u16> =
                        nine.map(|(y, x)| at(y.clamp(0, rows - 1), x.clamp(0, columns - 1))).collect();
                    nine.sort_unstable();
                    nine[4]
                }
                Filter::Square => {
                    let there = |y: i32, x: i32| if inside(&(y, x)) { u32::from(at(y, x)) } else { 0 };
                    let corners = [(y - 1, x - 1), (y - 1, x), (y, x - 1), (y, x)];
                    let sum = |(y, x)| there(y, x) + there(y, x + 1) + there(y + 1, x) + there(y + 1, x + 1);
                    let best = corners.map(sum).into_iter().max().unwrap_or(0);
                    at(y, x).min(((best + 2) / 4) as u16)
                }
                Filter::Conservative => {
                    let eight = nine.filter(|place| *place != (y, x)).filter(inside);
                    let eight: Vec<u16> = eight.map(|(y, x)| at(y, x)).collect();
                    match (eight.iter().min(), eight.iter().max()) {
                        (Some(low), Some(high)) => at(y, x).clamp(*low, *high),
                        _ => at(y, x),
                    }
                }
            });
        }
    }
    out
}
