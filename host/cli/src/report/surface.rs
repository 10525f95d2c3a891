//! A panel as a surface whose height is the pressure, seen from the side and above, with its peaks.

use super::scale::PageUnit;
use super::svg::{colour, escaped};
use std::fmt::{Result, Write};
use taxel_core::body::Placed;
use taxel_core::garment::Area;

/// The drawing, SVG units.
const SIZE: [f64; 2] = [380.0, 330.0];
/// Height of the greatest pressure; its number fits even at the far corner.
const HIGH: f64 = 135.0;
/// Position of the panel's centre.
const MIDDLE: [f64; 2] = [190.0, 240.0];
/// View: rotated about the vertical by 50 degrees (cosine, sine), seen from 30 degrees above (sine).
const TURN: [f64; 2] = [0.642_787_6, 0.766_044_4];
const ABOVE: f64 = 0.5;
/// Half the extent of a panel's longer side.
const REACH: f64 = 185.0;

/// Draws a panel; colours and heights end at `top` counts.
pub fn draw(area: &Area, values: &[u16], contacts: &[Placed], top: u16, scale: PageUnit) -> String {
    let mut svg = String::new();
    // Writing to a string cannot fail.
    let _ = Projection::of(area, top, scale).write(&mut svg, area, values, contacts);
    svg
}

/// Projection of taxels and counts.
struct Projection {
    middle: [f64; 2],
    scale: [f64; 2],
    top: u16,
    unit: PageUnit,
}

impl Projection {
    fn of(area: &Area, top: u16, unit: PageUnit) -> Projection {
        let taxels = [area.columns, area.rows].map(|count| f64::from(count.max(2)) - 1.0);
        let pitch = if area.pitch_um.contains(&0) { [1.0; 2] } else { area.pitch_um.map(f64::from) };
        let long = (taxels[0] * pitch[0]).max(taxels[1] * pitch[1]);
        Projection {
            middle: taxels.map(|count| count / 2.0),
            scale: pitch.map(|pitch| pitch * REACH * 1.8 / long),
            top: top.max(1),
            unit,
        }
    }

    /// Position in the drawing.
    fn place(&self, x: f64, y: f64, value: f64) -> [f64; 2] {
        let [u, v] = [(x - self.middle[0]) * self.scale[0], (y - self.middle[1]) * self.scale[1]];
        let across = u * TURN[0] - v * TURN[1];
        let deep = u * TURN[1] + v * TURN[0];
        [MIDDLE[0] + across, MIDDLE[1] + deep * ABOVE - HIGH * value / f64::from(self.top)]
    }

    fn write(&self, svg: &mut String, area: &Area, values: &[u16], contacts: &[Placed]) -> Result {
        let (rows, columns) = (usize::from(area.rows), usize::from(area.columns));
        let at =
            |row: usize, column: usize| values.get(row * columns + column).map_or(0.0, |v| f64::from(*v));
        writeln!(svg, "<svg viewBox=\"0 0 {} {}\" width=\"{}\" role=\"img\">", SIZE[0], SIZE[1], SIZE[0])?;
        writeln!(svg, "<text x=\"8\" y=\"16\" class=\"title\">{}</text>", escaped(&area.name))?;
        writeln!(svg, "<g class=\"face\">")?;
        // From back to front: the view is from the last row and column.
        for row in 0..rows.saturating_sub(1) {
            for column in 0..columns.saturating_sub(1) {
                let corners = [(0, 0), (0, 1), (1, 1), (1, 0)].map(|(y, x)| (row + y, column + x));
                let mean = corners.iter().map(|(r, c)| at(*r, *c)).sum::<f64>() / 4.0;
                write!(svg, "<path fill=\"{}\" d=\"", colour(mean, self.top))?;
                for (index, (r, c)) in corners.into_iter().enumerate() {
                    let [x, y] = self.place(c as f64, r as f64, at(r, c));
                    write!(svg, "{}{x:.1} {y:.1}", if index == 0 { 'M' } else { 'L' })?;
                }
                writeln!(svg, "Z\"/>")?;
            }
        }
        writeln!(svg, "</g>")?;
        for placed in contacts {
            self.peak(svg, placed)?;
        }
        writeln!(svg, "</svg>")
    }

    fn peak(&self, svg: &mut String, placed: &Placed) -> Result {
        let contact = &placed.contact;
        let (column, row) = (f64::from(contact.peak_at.column), f64::from(contact.peak_at.row));
        let [x, y] = self.place(column, row, contact.peak.into());
        writeln!(svg, "<path class=\"stalk\" d=\"M{x:.1} {y:.1}v-14\"/>")?;
        writeln!(
            svg,
            "<text class=\"value\" x=\"{x:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>",
            y - 17.0,
            self.unit.told(contact.peak)
        )
    }
}
