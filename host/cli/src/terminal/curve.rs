//! The total force of the last half minute as a curve, in the colour of the intention that leads.

use super::ramp::color;
use crate::palette::{Rgb, intention};
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use std::collections::VecDeque;
use taxel::client::Client;
use taxel_core::format::Micros;
use taxel_core::intent::Leading;

/// Time of the whole curve, us.
const SPAN: u64 = 30_000_000;
/// Time of a point, us: the curve is as fine as the widest terminal.
const POINT: u64 = 50_000;
/// Colour of a force without a meaning.
const FORCE: Rgb = [152, 162, 175];
const EIGHTHS: [&str; 8] = [" ", "▁", "▂", "▃", "▄", "▅", "▆", "▇"];

/// Greatest total, counts, and intention of each point.
#[derive(Debug, Default, Clone)]
pub struct Curve {
    points: VecDeque<(u64, u32, Leading)>,
}

impl Curve {
    /// Adds a frame; a clock that steps back begins anew.
    pub fn add(&mut self, client: &Client, time: Micros) {
        let at = time.0 / POINT;
        let total =
            client.contacts().iter().fold(0u32, |sum, placed| sum.saturating_add(placed.contact.total));
        match self.points.back_mut() {
            Some((last, most, leading)) if *last == at => {
                *most = total.max(*most);
                *leading = client.leading();
            }
            Some((last, ..)) if *last > at => self.points.clear(),
            _ => {}
        }
        if self.points.back().is_none_or(|(last, ..)| *last < at) {
            self.points.push_back((at, total, client.leading()));
        }
        while self.points.front().is_some_and(|(first, ..)| at - first >= SPAN / POINT) {
            self.points.pop_front();
        }
    }

    /// Greatest total, counts.
    pub fn most(&self) -> u32 {
        self.points.iter().map(|(_, total, _)| *total).max().unwrap_or(0)
    }

    /// Draws it; the newest point is at the right.
    pub fn draw(&self, space: Rect, buffer: &mut Buffer) {
        let (Some((newest, ..)), false) = (self.points.back(), space.is_empty()) else { return };
        let (most, width) = (self.most().max(1), u64::from(space.width));
        let mut columns = vec![(0, Leading::None); usize::from(space.width)];
        for (at, total, leading) in &self.points {
            let back = (newest - at) * width * POINT / SPAN;
            let Some(column) = (width - 1).checked_sub(back) else { continue };
            let column = &mut columns[column as usize];
            *column = (column.0.max(*total), if *total > 0 { *leading } else { column.1 });
        }
        for (x, (total, leading)) in (space.x..).zip(columns) {
            let colour = color(if leading == Leading::None { FORCE } else { intention(leading) });
            let full = u64::from(space.height) * 8;
            let eighths = (u64::from(total) * full).div_ceil(u64::from(most)) as u16;
            for row in 0..space.height {
                let Some(cell) = buffer.cell_mut((x, space.bottom() - 1 - row)) else { continue };
                match eighths.saturating_sub(8 * row) {
                    // Both colours: a character alone may leave a gap.
                    8.. => cell.set_symbol("█").set_style(Style::new().fg(colour).bg(colour)),
                    part => cell.set_symbol(EIGHTHS[usize::from(part)]).set_style(Style::new().fg(colour)),
                };
            }
        }
    }
}
