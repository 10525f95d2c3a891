//! Draws panels as pressure maps, two pixels in a character cell.

use super::ramp::{Paint, color, glyph};
use crate::palette::{Rgb, mix, pressure};
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Color, Modifier, Style};
use taxel::client::Client;
use taxel_core::garment::{Area, Layout};

const WHITE: Rgb = [255; 3];
/// Characters between two panels.
const GAP: u16 = 2;
/// Colour of a position without a taxel.
const ABSENT: Rgb = [0; 3];

/// Pixels per taxel, or taxels per pixel where space is short.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Zoom {
    Up(u16),
    Down(u16),
}

impl Zoom {
    /// Returns the largest zoom at which a panel fits into `width` by `height` pixels.
    fn fit(area: &Area, width: u16, height: u16) -> Zoom {
        let (columns, rows) = (area.columns.max(1), area.rows.max(1));
        match (width / columns).min(height / rows) {
            0 => Zoom::Down(columns.div_ceil(width.max(1)).max(rows.div_ceil(height.max(1)))),
            up => Zoom::Up(up),
        }
    }

    /// Number of pixels for `taxels` taxels.
    fn pixels(self, taxels: u16) -> u16 {
        match self {
            Zoom::Up(up) => taxels.saturating_mul(up),
            Zoom::Down(down) => taxels.div_ceil(down),
        }
    }

    /// First and last taxel under a pixel.
    fn taxels(self, pixel: u16, count: u16) -> (u16, u16) {
        let (first, last) = match self {
            Zoom::Up(up) => (pixel / up, pixel / up),
            Zoom::Down(down) => (pixel * down, pixel * down + down - 1),
        };
        (first, last.min(count.saturating_sub(1)))
    }

    /// Pixel of a position in taxels.
    fn place(self, at: f64) -> f64 {
        match self {
            Zoom::Up(up) => (at + 0.5) * f64::from(up),
            Zoom::Down(down) => (at + 0.5) / f64::from(down),
        }
    }
}

/// Layout of the panels: `across` of them side by side, each in a cell of this many characters.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Grid {
    across: u16,
    cell: [u16; 2],
}

impl Grid {
    /// Returns the grid that shows all panels of a garment as large as possible; none if nothing fits.
    pub fn fit(layout: &Layout, space: Rect) -> Option<Grid> {
        let count = layout.areas().len() as u16;
        let grid = |across: u16| Grid {
            across,
            cell: [space.width / across, space.height / count.div_ceil(across)],
        };
        let size = |across: &u16| {
            let fits = |area: &Area| match grid(*across).zoom(area) {
                Zoom::Up(up) => i32::from(up),
                Zoom::Down(down) => -i32::from(down),
            };
            layout.areas().iter().map(fits).min()
        };
        // Among equals the narrowest, which leaves most space beside it.
        let mut grid = grid((1..=count).rev().max_by_key(size)?);
        if grid.cell[0] < 2 || grid.cell[1] < 2 {
            return None;
        }
        let widest = layout.areas().iter().map(|area| grid.zoom(area).pixels(area.columns) + GAP).max();
        grid.cell[0] = grid.cell[0].min(widest?);
        Some(grid)
    }

    /// Width, characters.
    pub fn width(&self) -> u16 {
        self.across * self.cell[0]
    }

    /// Zoom of a panel in its cell. The cell's first row is the name, its last column a gap.
    fn zoom(&self, area: &Area) -> Zoom {
        let [width, height] = self.cell;
        Zoom::fit(area, width.saturating_sub(1), height.saturating_sub(1) * 2)
    }

    /// Draws all panels on a scale that ends at `top` counts.
    pub fn draw(&self, client: &Client, (top, paint): (u16, Paint), space: Rect, buffer: &mut Buffer) {
        let Some(layout) = client.layout() else { return };
        let [width, height] = self.cell;
        for (index, area) in layout.areas().iter().enumerate() {
            let (column, row) = (index as u16 % self.across, index as u16 / self.across);
            let place = Rect::new(space.x + column * width, space.y + row * height, width - 1, height);
            let panel = DrawnPanel { client, layout, area, index: index as u8, top, paint };
            panel.draw(self.zoom(area), place, buffer);
        }
    }
}

struct DrawnPanel<'a> {
    client: &'a Client,
    layout: &'a Layout,
    area: &'a Area,
    index: u8,
    top: u16,
    paint: Paint,
}

impl DrawnPanel<'_> {
    /// Draws the name, and the map below it.
    fn draw(&self, zoom: Zoom, place: Rect, buffer: &mut Buffer) {
        let bold = Style::new().add_modifier(Modifier::BOLD);
        buffer.set_stringn(place.x, place.y, &self.area.name, usize::from(place.width), bold);
        let (width, height) = (zoom.pixels(self.area.columns), zoom.pixels(self.area.rows));
        for y in 0..height.div_ceil(2) {
            for x in 0..width {
                let Some(cell) = buffer.cell_mut((place.x + x, place.y + 1 + y)) else { continue };
                let lower = Some(2 * y + 1).filter(|lower| *lower < height);
                match self.paint {
                    Paint::Colours => {
                        cell.set_char('▀').set_fg(color(self.color(zoom, x, 2 * y)));
                        cell.set_bg(lower.map_or(Color::Reset, |lower| color(self.color(zoom, x, lower))));
                    }
                    Paint::Glyphs => {
                        let values = [Some(2 * y), lower].map(|y| self.value(zoom, x, y?));
                        let most = values.into_iter().flatten().max();
                        cell.set_char(most.map_or(' ', |value| glyph(value, self.top)));
                    }
                }
            }
        }
        let below = Rect { y: place.y + 1, height: place.height - 1, ..place };
        self.markers(zoom, below, buffer);
    }

    /// Returns the greatest value under a pixel; none where there is no taxel.
    fn value(&self, zoom: Zoom, x: u16, y: u16) -> Option<u16> {
        let (top, bottom) = zoom.taxels(y, self.area.rows);
        let (left, right) = zoom.taxels(x, self.area.columns);
        let image = self.client.image().map_or(&[][..], |(_, image)| image);
        let at = |row: u16, column: u16| {
            let number = usize::from(self.area.base) + usize::from(row) * usize::from(self.area.columns);
            let value = image.get(number + usize::from(column)).copied().unwrap_or(0);
            (!self.layout.is_absent(self.index, row, column)).then_some(value)
        };
        (top..=bottom).flat_map(|row| (left..=right).filter_map(move |column| at(row, column))).max()
    }

    /// True if a pixel belongs to a contact.
    fn inside(&self, zoom: Zoom, x: Option<u16>, y: Option<u16>) -> bool {
        let low = self.client.description().map_or(1, |description| description.scene.contact.low.max(1));
        let (Some(x), Some(y)) = (x, y) else { return false };
        let on_map = x < zoom.pixels(self.area.columns) && y < zoom.pixels(self.area.rows);
        on_map && self.value(zoom, x, y).is_some_and(|value| value >= low)
    }

    /// Colour of a pixel's pressure, lighter along the contour of a contact.
    fn color(&self, zoom: Zoom, x: u16, y: u16) -> Rgb {
        let Some(value) = self.value(zoom, x, y) else { return ABSENT };
        let plain = pressure(value, self.top);
        if self.client.contacts().is_empty() || !self.inside(zoom, Some(x), Some(y)) {
            return plain;
        }
        let (x, y) = (Some(x), Some(y));
        let next = |at: Option<u16>| at.map(|at| at + 1);
        let before = |at: Option<u16>| at.and_then(|at| at.checked_sub(1));
        let around = [(before(x), y), (next(x), y), (x, before(y)), (x, next(y))];
        let edge = around.into_iter().any(|(x, y)| !self.inside(zoom, x, y));
        if edge { mix(plain, WHITE, 0.5) } else { plain }
    }

    /// Draws the id of each contact at its centroid.
    fn markers(&self, zoom: Zoom, place: Rect, buffer: &mut Buffer) {
        for placed in self.client.contacts().iter().filter(|p| p.contact.panel == self.index) {
            let id = placed.contact.id.to_string();
            let x = zoom.place(placed.contact.x.to_f64()) - id.len() as f64 / 2.0;
            let y = zoom.place(placed.contact.y.to_f64()) / 2.0;
            let within =
                |at: f64, start: u16, room: u16| start + (at.max(0.0) as u16).min(room.saturating_sub(1));
            let (x, y) = (within(x, place.x, place.width), within(y, place.y, place.height));
            let style = Style::new().add_modifier(Modifier::BOLD);
            let style = match self.paint {
                Paint::Colours => style.fg(Color::White).bg(Color::Black),
                Paint::Glyphs => style.add_modifier(Modifier::REVERSED),
            };
            buffer.set_stringn(x, y, id, usize::from(place.right().saturating_sub(x)), style);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panel_is_drawn_as_large_as_it_fits() {
        let layout = Layout::build(&taxel_core::garment::Garment::recorded(32, 16), 512, 4095).unwrap();
        let fit = |width, height| Zoom::fit(&layout.areas()[0], width, height);
        assert_eq!([fit(16, 32), fit(47, 200), fit(15, 32)], [Zoom::Up(1), Zoom::Up(2), Zoom::Down(2)]);
        assert_eq!([fit(100, 7), fit(0, 0)], [Zoom::Down(5), Zoom::Down(32)]);
        assert_eq!(Zoom::Down(5).pixels(32), 7);
        assert_eq!(Zoom::Down(5).taxels(6, 32), (30, 31));
        assert_eq!(Zoom::Up(3).taxels(5, 16), (1, 1));
    }
}
