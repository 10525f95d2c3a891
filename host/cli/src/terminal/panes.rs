//! Panes beside the maps: contacts and intention.

use super::ramp::color;
use crate::palette::{Rgb, intention as colour_of};
use crate::watch::narrate::force;
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Modifier, Style};
use taxel::client::Client;
use taxel_core::body::Placed;
use taxel_core::format::Q15;
use taxel_core::intent::Leading;

/// Colours of concepts that are no intentions, and of what is negative.
const BLUE: Rgb = [86, 180, 233];
const GREY: Rgb = [128, 128, 128];

/// Draws a heading and as many of the lines as fit.
pub fn list(title: &str, lines: &[String], space: Rect, buffer: &mut Buffer) {
    let bold = Style::new().add_modifier(Modifier::BOLD);
    let width = usize::from(space.width);
    for (row, y) in (space.y..space.bottom()).enumerate() {
        match row.checked_sub(1) {
            None => drop(buffer.set_stringn(space.x, y, title, width, bold)),
            Some(row) => {
                let Some(line) = lines.get(row) else { break };
                buffer.set_stringn(space.x, y, line, width, Style::new());
            }
        }
    }
}

/// The heading of [`contact`].
pub const CONTACTS: &str = " id region     shape        force area  axis    mm/s";

/// Formats a contact as a line.
pub fn contact(client: &Client, placed: &Placed, counts_per_newton: Option<f32>) -> String {
    let contact = &placed.contact;
    let axis = contact.azimuth.map_or("   -".into(), |a| format!("{:3.0}°", a.to_radians().to_degrees()));
    let speed = client.layout().map_or(0, |layout| placed.speed(layout)) / 10;
    let region = client.region_name(placed.region);
    let shape = client.shape_name(placed.shape.class);
    let force = match counts_per_newton {
        Some(_) => force(contact.total, counts_per_newton),
        None => contact.total.to_string(),
    };
    let slip = if contact.slip { " slip" } else { "" };
    format!(
        "{:>3} {region:<10.10} {shape:<9.9} {force:>8} {:>4}  {axis} {speed:>7}{slip}",
        contact.id, contact.area
    )
}

/// Draws the leading intention, and a bar for every concept: intentions, their consequences, inputs.
pub fn intention(client: &Client, space: Rect, buffer: &mut Buffer) {
    if space.is_empty() {
        return;
    }
    let leading = client.leading();
    let bold = Style::new().add_modifier(Modifier::BOLD);
    let (x, _) = buffer.set_stringn(space.x, space.y, "intention ", usize::from(space.width), bold);
    let room = usize::from(space.right().saturating_sub(x));
    buffer.set_stringn(x, space.y, leading.as_str(), room, bold.fg(color(colour_of(leading))));
    let activations = client.activations_of_leading();
    for (row, concept) in order(client).into_iter().enumerate().take(usize::from(space.height) - 1) {
        let (Some(name), Some(value)) = (client.concepts().get(concept), activations.get(concept)) else {
            continue;
        };
        let known = Leading::INTENTIONS.into_iter().find(|l| l.as_str() == name.as_str());
        let colour = known.map_or(BLUE, colour_of);
        bar(name, *value, colour, Rect { y: space.y + 1 + row as u16, height: 1, ..space }, buffer);
    }
}

/// Indices of the concepts in display order.
fn order(client: &Client) -> Vec<usize> {
    let map = client.worn().and_then(|worn| worn.scene.intent.as_ref()).map(|intent| &intent.map);
    let is_input =
        |i: usize| map.is_some_and(|m| m.inputs.iter().any(|input| usize::from(input.concept) == i));
    let names = client.concepts();
    let is_intention = |i: usize| {
        let name = names.get(i).map_or("", |name| name.as_str());
        Leading::INTENTIONS.iter().any(|l| l.as_str() == name)
    };
    let mut order: Vec<usize> = (0..names.len()).collect();
    order.sort_by_key(|i| if is_intention(*i) { 0 } else { 1 + u8::from(is_input(*i)) });
    order
}

/// Draws `name ████▌   0.45`.
fn bar(name: &str, value: Q15, colour: Rgb, space: Rect, buffer: &mut Buffer) {
    const EIGHTHS: [&str; 8] = ["", "▏", "▎", "▍", "▌", "▋", "▊", "▉"];
    buffer.set_stringn(space.x, space.y, format!("{name:<11.11}"), usize::from(space.width), Style::new());
    let room = space.width.saturating_sub(18).min(24);
    let value = value.to_f64();
    let eighths = (value.abs().min(1.0) * f64::from(room) * 8.0).round() as usize;
    let filled = "█".repeat(eighths / 8) + EIGHTHS[eighths % 8];
    let start = space.x + 11;
    // Negative values are grey.
    let style = Style::new().fg(color(if value < 0.0 { GREY } else { colour }));
    buffer.set_stringn(start, space.y, filled, usize::from(space.width.saturating_sub(11)), style);
    let end = start + room + 1;
    let left = usize::from(space.right().saturating_sub(end));
    buffer.set_stringn(end, space.y, format!("{value:5.2}"), left, Style::new());
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::watch::{LiveArgs, watch};
    use taxel::client::Event;
    use taxel::session::Show;
    use taxel::source::{SourceOptions, open};

    /// The bar, and the reported activation, of each announced intention.
    #[derive(Default)]
    struct Bars(Vec<[String; 2]>);

    impl Show<anyhow::Error> for Bars {
        fn event(&mut self, client: &Client, event: &Event) -> anyhow::Result<()> {
            let Event::Intent(report) = event else { return Ok(()) };
            let mut buffer = Buffer::empty(Rect::new(0, 0, 40, 12));
            intention(client, buffer.area, &mut buffer);
            let row = |y: u16| -> String { (0..40).map(|x| buffer[(x, y)].symbol()).collect() };
            if report.leading != Leading::None {
                assert!(row(0).contains(report.leading.as_str()));
                let at = client.concepts().iter().position(|name| name.as_str() == report.leading.as_str());
                let told = at.map_or(0.0, |at| report.concepts[at].to_f64());
                let bar = (1..12).map(row).find(|row| row.starts_with(report.leading.as_str()));
                self.0.push([bar.unwrap().trim().to_string(), format!("{told:.2}")]);
            }
            Ok(())
        }
    }

    #[test]
    fn the_bars_are_those_of_the_moment_at_which_the_heading_led() {
        let (spec, mut bars) = ("sim:pat".parse::<taxel::source::SourceSpec>().unwrap(), Bars::default());
        let source = open(&spec, &SourceOptions::default()).unwrap();
        watch(&LiveArgs::of(spec), source, &mut bars).unwrap();
        assert!(bars.0.iter().any(|[_, told]| told == "0.00"), "announced a moment longer: {:?}", bars.0);
        assert!(bars.0.iter().all(|[bar, _]| !bar.ends_with("0.00")), "{:?}", bars.0);
    }
}
