//! Writes the terminal's display as SVG, for documents.

use super::View;
use anyhow::Result;
use ratatui::buffer::{Buffer, Cell};
use ratatui::layout::Rect;
use ratatui::style::{Color, Modifier};
use std::fmt::Write;
use taxel::client::{Client, Event};
use taxel::files::output::Output;
use taxel::session::Show;

/// A character cell, SVG units.
const CELL: [u32; 2] = [8, 16];
const INK: &str = "#d8dee9";
const PAPER: &str = "#12141a";
/// Size of the terminal that is drawn, characters.
const SIZE: [u16; 2] = [100, 40];

/// Writes the last display to a file.
pub struct Painter {
    view: View,
    /// None once written.
    output: Option<Output>,
}

impl Painter {
    /// A writer for this view.
    pub fn new(view: View, output: Output) -> Painter {
        Painter { view, output: Some(output) }
    }
}

impl Show<anyhow::Error> for Painter {
    fn event(&mut self, client: &Client, event: &Event) -> Result<()> {
        self.view.event(client, event);
        Ok(())
    }

    fn end(&mut self, client: &Client) -> Result<()> {
        let mut buffer = Buffer::empty(Rect::new(0, 0, SIZE[0], SIZE[1]));
        self.view.draw(client, &mut buffer);
        Ok(self.output.take().map_or(Ok(()), |output| output.write(picture(&buffer).as_bytes()))?)
    }
}

/// Encodes a buffer as SVG: backgrounds and blocks become rectangles, the rest text.
pub fn picture(buffer: &Buffer) -> String {
    let (width, height) = (u32::from(buffer.area.width) * CELL[0], u32::from(buffer.area.height) * CELL[1]);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"-8 -8 {} {}\" \
         font-family=\"DejaVu Sans Mono, Menlo, Consolas, monospace\" font-size=\"13\" shape-rendering=\"crispEdges\">\n\
         <rect x=\"-8\" y=\"-8\" width=\"100%\" height=\"100%\" rx=\"6\" fill=\"{PAPER}\"/>\n",
        width + 16,
        height + 16
    );
    // Writing to a string cannot fail.
    for y in 0..buffer.area.height {
        let _ = blocks(buffer, y, &mut svg);
        let _ = text(buffer, y, &mut svg);
    }
    svg += "</svg>\n";
    svg
}

/// Writes the rectangles of one row: coloured halves of cells, with neighbours of one colour merged.
fn blocks(buffer: &Buffer, y: u16, svg: &mut String) -> std::fmt::Result {
    let top = u32::from(y) * CELL[1];
    let half = CELL[1] / 2;
    for (upper, y) in [(true, top), (false, top + half)] {
        let colours: Vec<_> = row(buffer, y_of(y)).map(|cell| half_colour(cell, upper)).collect();
        let mut x = 0;
        for run in colours.chunk_by(|a, b| a == b) {
            if let Some(Some(fill)) = run.first() {
                let (at, width) = (x * CELL[0], run.len() as u32 * CELL[0]);
                writeln!(
                    svg,
                    "<rect x=\"{at}\" y=\"{y}\" width=\"{width}\" height=\"{half}\" fill=\"{fill}\"/>"
                )?;
            }
            x += run.len() as u32;
        }
    }
    for (x, cell) in row(buffer, y).enumerate() {
        if let Some(eighths) = level(cell.symbol()) {
            let (at, high, fill) = (x as u32 * CELL[0], eighths * CELL[1] / 8, hex(cell.fg, INK));
            let y = top + CELL[1] - high;
            writeln!(
                svg,
                "<rect x=\"{at}\" y=\"{y}\" width=\"{}\" height=\"{high}\" fill=\"{fill}\"/>",
                CELL[0]
            )?;
        }
        if let Some(eighths) = bar(cell.symbol()) {
            let (at, width, fill) = (x as u32 * CELL[0], eighths * CELL[0] / 8, hex(cell.fg, INK));
            let high = CELL[1] - 4;
            writeln!(
                svg,
                "<rect x=\"{at}\" y=\"{}\" width=\"{width}\" height=\"{high}\" fill=\"{fill}\"/>",
                top + 2
            )?;
        }
    }
    Ok(())
}

/// SVG y of a row.
fn y_of(y: u32) -> u16 {
    (y / CELL[1]) as u16
}

fn row(buffer: &Buffer, y: u16) -> impl Iterator<Item = &Cell> {
    (0..buffer.area.width).filter_map(move |x| buffer.cell((x, y)))
}

/// Colour of half a cell; none for the background.
fn half_colour(cell: &Cell, upper: bool) -> Option<String> {
    let colour = if upper && cell.symbol() == "▀" { cell.fg } else { cell.bg };
    (colour != Color::Reset).then(|| hex(colour, PAPER))
}

/// Eighths of a cell that a bar character fills from the left.
fn bar(symbol: &str) -> Option<u32> {
    "▏▎▍▌▋▊▉█".chars().position(|c| symbol.starts_with(c)).map(|index| index as u32 + 1)
}

/// Eighths of a cell that a level character fills from below.
fn level(symbol: &str) -> Option<u32> {
    "▁▂▃▄▅▆▇".chars().position(|c| symbol.starts_with(c)).map(|index| index as u32 + 1)
}

/// Writes the text of one row, with neighbours of one style merged.
fn text(buffer: &Buffer, y: u16, svg: &mut String) -> std::fmt::Result {
    let cells: Vec<_> = row(buffer, y).collect();
    let is_text = |cell: &Cell| {
        let symbol = cell.symbol();
        symbol != "▀" && bar(symbol).is_none() && level(symbol).is_none()
    };
    let mut x = 0;
    for run in cells.chunk_by(|a, b| is_text(a) == is_text(b) && a.fg == b.fg && a.modifier == b.modifier) {
        let (at, width) = (x * CELL[0], run.len() as u32 * CELL[0]);
        x += run.len() as u32;
        let words: String = run.iter().map(|cell| cell.symbol()).collect();
        let (Some(first), false) = (run.first().filter(|cell| is_text(cell)), words.trim().is_empty()) else {
            continue;
        };
        let weight = if first.modifier.contains(Modifier::BOLD) { " font-weight=\"bold\"" } else { "" };
        let escaped = words.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;");
        writeln!(
            svg,
            "<text x=\"{at}\" y=\"{}\" textLength=\"{width}\" xml:space=\"preserve\" fill=\"{}\"{weight}>{escaped}</text>",
            u32::from(y) * CELL[1] + 12,
            hex(first.fg, INK)
        )?;
    }
    Ok(())
}

fn hex(colour: Color, otherwise: &str) -> String {
    match colour {
        Color::Rgb(r, g, b) => format!("#{r:02x}{g:02x}{b:02x}"),
        Color::White => "#ffffff".into(),
        Color::Black => "#000000".into(),
        _ => otherwise.into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ratatui::style::Style;

    #[test]
    fn cells_become_rectangles_and_text() {
        let mut buffer = Buffer::empty(Rect::new(0, 0, 8, 1));
        buffer.set_string(0, 0, "▀▀", Style::new().fg(Color::Rgb(1, 2, 3)).bg(Color::Rgb(4, 5, 6)));
        buffer.set_string(2, 0, "a<b", Style::new());
        buffer.set_string(6, 0, "▌", Style::new().fg(Color::Rgb(7, 8, 9)));
        let svg = picture(&buffer);
        for part in [
            "<rect x=\"0\" y=\"0\" width=\"16\" height=\"8\" fill=\"#010203\"/>",
            "<rect x=\"0\" y=\"8\" width=\"16\" height=\"8\" fill=\"#040506\"/>",
            "<rect x=\"48\" y=\"2\" width=\"4\" height=\"12\" fill=\"#070809\"/>",
            ">a&lt;b ",
        ] {
            assert!(svg.contains(part), "{svg}");
        }
    }
}
