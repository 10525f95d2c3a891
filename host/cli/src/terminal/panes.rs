//! Panes beside the maps: contacts and concepts.

use super::ramp::color;
use crate::palette::{FEELING, Rgb, intention as colour_of};
use crate::watch::shape::shape;
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Modifier, Style};
use std::cmp::Reverse;
use taxel::client::Client;
use taxel::fcm::layers::{self, Role};
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
pub fn contact(client: &Client, placed: &Placed) -> String {
    let contact = &placed.contact;
    let axis = contact.azimuth.map_or("   -".into(), |a| format!("{:3.0}°", a.to_radians().to_degrees()));
    let speed = client.layout().map_or(0, |layout| placed.speed(layout)) / 10;
    let region = client.region_name(placed.region);
    let shape = shape(client, placed);
    let force = client.force(placed);
    let force = force.map_or_else(|| contact.total.to_string(), |newtons| format!("{newtons:.1} N"));
    let slip = if contact.slip { " slip" } else { "" };
    format!(
        "{:>3} {region:<10.10} {shape:<9.9} {force:>8} {:>4}  {axis} {speed:>7}{slip}",
        contact.id, contact.area
    )
}

/// Titles of the groups of concepts, in reading order.
const GROUPS: [(Role, &str); 3] =
    [(Role::Meaning, "what it means"), (Role::Feeling, "feelings"), (Role::Felt, "what is felt")];

/// Rows that [`concepts`] needs: a title for each group, and its concepts.
pub fn rows(client: &Client) -> u16 {
    let groups = groups(client);
    (groups.len() + groups.iter().map(|(_, group)| group.len()).sum::<usize>()) as u16
}

/// Draws a bar for every concept, by groups: meanings, feelings, and what is felt, the strongest first.
pub fn concepts(client: &Client, space: Rect, buffer: &mut Buffer) {
    let activations = client.activations_of_leading();
    let value = |at: usize| activations.get(at).copied().unwrap_or(Q15(0));
    let mut lines = space.rows();
    for (role, mut group) in groups(client) {
        if role == Role::Felt {
            group.sort_by_key(|at| Reverse(value(*at).0.abs()));
        }
        let Some(line) = lines.next() else { return };
        let title = GROUPS.iter().find(|(known, _)| *known == role).map_or("", |(_, title)| title);
        let bold = Style::new().add_modifier(Modifier::BOLD);
        buffer.set_stringn(line.x, line.y, title, usize::from(line.width), bold);
        for (at, line) in group.into_iter().zip(lines.by_ref()) {
            let name = client.concepts().get(at).map_or("", |name| name.as_str());
            let known = Leading::INTENTIONS.into_iter().find(|leading| leading.as_str() == name);
            let other = if role == Role::Feeling { FEELING } else { BLUE };
            bar(name, value(at), known.map_or(other, colour_of), line, buffer);
        }
    }
}

/// Indices of the concepts of each group that has some.
fn groups(client: &Client) -> Vec<(Role, Vec<usize>)> {
    let intent = client.description().and_then(|description| description.scene.intent.as_ref());
    let roles = intent.map_or_else(Vec::new, |intent| layers::of_config(&intent.map));
    let of = |role: Role| (0..roles.len()).filter(|at| roles[*at].1 == role).collect::<Vec<_>>();
    GROUPS.iter().map(|(role, _)| (*role, of(*role))).filter(|(_, group)| !group.is_empty()).collect()
}

/// Draws `name ████▌   0.45`.
fn bar(name: &str, value: Q15, colour: Rgb, space: Rect, buffer: &mut Buffer) {
    const EIGHTHS: [&str; 8] = ["", "▏", "▎", "▍", "▌", "▋", "▊", "▉"];
    buffer.set_stringn(space.x, space.y, format!("{name:<11.11}"), usize::from(space.width), Style::new());
    let room = space.width.saturating_sub(18).min(40);
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
    use crate::watch::{WatchOptions, watch};
    use taxel::client::Event;
    use taxel::client::Stamp;
    use taxel::session::Observer;
    use taxel::source::{SourceOptions, open};

    /// The bar, and the reported activation, of each announced intention.
    #[derive(Default)]
    struct Bars(Vec<[String; 2]>);

    impl Observer for Bars {
        fn event(&mut self, client: &Client, event: &Event, _: Stamp) -> taxel::Result<()> {
            let Event::Intent(report) = event else { return Ok(()) };
            let mut buffer = Buffer::empty(Rect::new(0, 0, 40, 12));
            concepts(client, buffer.area, &mut buffer);
            let row = |y: u16| -> String { (0..40).map(|x| buffer[(x, y)].symbol()).collect() };
            if report.leading != Leading::None {
                let at = client.concepts().iter().position(|name| name.as_str() == report.leading.as_str());
                let reported = at.map_or(0.0, |at| report.concepts[at].to_f64());
                let bar = (1..12).map(row).find(|row| row.starts_with(report.leading.as_str()));
                self.0.push([bar.unwrap().trim().to_string(), format!("{reported:.2}")]);
            }
            Ok(())
        }
    }

    #[test]
    fn the_bars_are_those_of_the_moment_at_which_the_heading_led() {
        let (spec, mut bars) = ("sim:pat".parse::<taxel::source::SourceSpec>().unwrap(), Bars::default());
        let source = open(&spec, &SourceOptions::default()).unwrap();
        watch(&WatchOptions::of(spec), source, &mut bars).unwrap();
        assert!(
            bars.0.iter().any(|[_, reported]| reported == "0.00"),
            "announced a moment longer: {:?}",
            bars.0
        );
        assert!(bars.0.iter().all(|[bar, _]| !bar.ends_with("0.00")), "{:?}", bars.0);
    }
}
