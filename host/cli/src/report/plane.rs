//! A panel from above: pressure as colour, contours at the limits of the ranges, contacts and their peaks.

use super::contour;
use super::svg::{colour, escaped};
use std::fmt::{Result, Write};
use taxel_core::body::Placed;
use taxel_core::garment::Area;

/// Width of a taxel, SVG units.
const CELL: f64 = 11.0;
/// Margins for the axes and the title.
const MARGIN: [f64; 4] = [26.0, 30.0, 12.0, 22.0];
/// Taxels between two marks of an axis.
const STEP: u16 = 4;

/// Overlay on the pressure of a panel.
pub struct PlaneOverlay<'a> {
    pub contacts: &'a [Placed],
    /// Numbers of the taxels of the garment on which it folds.
    pub folding: &'a [u16],
    /// Contours, counts.
    pub limits: &'a [u16],
}

/// Draws a panel; colours end at `top` counts.
pub fn draw(area: &Area, values: &[u16], top: u16, over: &PlaneOverlay<'_>) -> String {
    let mut svg = String::new();
    // Writing to a string cannot fail.
    let _ = Plane::of(area).write(&mut svg, area, values, top, over);
    svg
}

/// Geometry of the drawing.
struct Plane {
    cell: [f64; 2],
}

impl Plane {
    fn of(area: &Area) -> Plane {
        let [x, y] = area.pitch_um.map(f64::from);
        let ratio = if x > 0.0 && y > 0.0 { (y / x).clamp(0.25, 4.0) } else { 1.0 };
        Plane { cell: [CELL, CELL * ratio] }
    }

    /// Position of a taxel's centre.
    fn place(&self, x: f64, y: f64) -> [f64; 2] {
        [MARGIN[0] + (x + 0.5) * self.cell[0], MARGIN[1] + (y + 0.5) * self.cell[1]]
    }

    fn write(
        &self,
        svg: &mut String,
        area: &Area,
        values: &[u16],
        top: u16,
        over: &PlaneOverlay<'_>,
    ) -> Result {
        let [w, h] = self.cell;
        let (wide, high) = (f64::from(area.columns) * w, f64::from(area.rows) * h);
        let size = [MARGIN[0] + wide + MARGIN[2], MARGIN[1] + high + MARGIN[3]];
        write!(
            svg,
            "<svg viewBox=\"0 0 {:.0} {:.0}\" width=\"{:.0}\" role=\"img\" aria-label=\"Pressure on the {}\">",
            size[0],
            size[1],
            size[0],
            escaped(&area.name)
        )?;
        writeln!(svg, "<text x=\"{}\" y=\"14\" class=\"title\">{}</text>", MARGIN[0], escaped(&area.name))?;
        let (left, upper) = (MARGIN[0], MARGIN[1]);
        let ground = colour(0.0, top);
        writeln!(
            svg,
            "<rect x=\"{left}\" y=\"{upper}\" width=\"{wide:.1}\" height=\"{high:.1}\" fill=\"{ground}\"/>"
        )?;
        let columns = usize::from(area.columns).max(1);
        for (index, value) in values.iter().enumerate().filter(|(_, value)| **value > 0) {
            let (x, y) = (left + (index % columns) as f64 * w, upper + (index / columns) as f64 * h);
            let fill = colour(f64::from(*value), top);
            // Slightly wider, so that no seams show.
            writeln!(
                svg,
                "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{:.1}\" height=\"{:.1}\" fill=\"{fill}\"/>",
                w + 0.2,
                h + 0.2
            )?;
        }
        self.levels(svg, values, columns, over.limits)?;
        self.folding(svg, area, over.folding)?;
        for placed in over.contacts {
            self.contact(svg, placed)?;
        }
        self.axes(svg, area)?;
        writeln!(svg, "</svg>")
    }

    fn levels(&self, svg: &mut String, values: &[u16], columns: usize, limits: &[u16]) -> Result {
        for limit in limits.iter().filter(|limit| **limit > 0) {
            write!(svg, "<path class=\"level\" d=\"")?;
            for [x0, y0, x1, y1] in contour::lines(values, columns, f64::from(*limit)) {
                let ([x0, y0], [x1, y1]) = (self.place(x0, y0), self.place(x1, y1));
                write!(svg, "M{x0:.1} {y0:.1}L{x1:.1} {y1:.1}")?;
            }
            writeln!(svg, "\"/>")?;
        }
        Ok(())
    }

    /// Strokes the taxels on which the garment folds.
    fn folding(&self, svg: &mut String, area: &Area, folding: &[u16]) -> Result {
        let taxels = usize::from(area.rows) * usize::from(area.columns);
        let own = folding.iter().filter_map(|taxel| usize::from(*taxel).checked_sub(area.base.into()));
        let own: Vec<usize> = own.filter(|taxel| *taxel < taxels).collect();
        if own.is_empty() {
            return Ok(());
        }
        write!(svg, "<path class=\"fold\" d=\"")?;
        let columns = usize::from(area.columns).max(1);
        for taxel in own {
            let [x, y] = self.place((taxel % columns) as f64, (taxel / columns) as f64);
            write!(svg, "M{:.1} {:.1}l5 -5", x - 2.5, y + 2.5)?;
        }
        writeln!(svg, "\"/>")
    }

    /// Draws centroid, axis, id and peak.
    fn contact(&self, svg: &mut String, placed: &Placed) -> Result {
        let contact = &placed.contact;
        let (cx, cy) = (contact.x.to_f64(), contact.y.to_f64());
        let [x, y] = self.place(cx, cy);
        if let Some(azimuth) = contact.azimuth {
            let (sin, cos) = azimuth.to_radians().sin_cos();
            let half = f64::from(contact.area).sqrt() * 0.6;
            let ([x0, y0], [x1, y1]) =
                (self.place(cx - half * cos, cy - half * sin), self.place(cx + half * cos, cy + half * sin));
            writeln!(svg, "<path class=\"axis\" d=\"M{x0:.1} {y0:.1}L{x1:.1} {y1:.1}\"/>")?;
        }
        writeln!(svg, "<circle class=\"centre\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"2.5\"/>")?;
        let [px, py] = self.place(f64::from(contact.peak_at.column), f64::from(contact.peak_at.row));
        writeln!(svg, "<path class=\"peak\" d=\"M{:.1} {py:.1}h6m-3 -3v6\"/>", px - 3.0)?;
        writeln!(svg, "<text class=\"id\" x=\"{:.1}\" y=\"{:.1}\">#{}</text>", x + 5.0, y - 5.0, contact.id)
    }

    fn axes(&self, svg: &mut String, area: &Area) -> Result {
        for column in (0..area.columns).step_by(usize::from(STEP)) {
            let [x, _] = self.place(f64::from(column), 0.0);
            let y = MARGIN[1] + f64::from(area.rows) * self.cell[1] + 13.0;
            writeln!(
                svg,
                "<text class=\"mark\" x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"middle\">{column}</text>"
            )?;
        }
        for row in (0..area.rows).step_by(usize::from(STEP)) {
            let [_, y] = self.place(0.0, f64::from(row));
            let x = MARGIN[0] - 5.0;
            writeln!(
                svg,
                "<text class=\"mark\" x=\"{x:.1}\" y=\"{:.1}\" text-anchor=\"end\">{row}</text>",
                y + 3.5
            )?;
        }
        Ok(())
    }
}
