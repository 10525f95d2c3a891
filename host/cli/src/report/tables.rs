//! Contacts, events and health as tables.

use super::seen::{LISTED, Seen, SeenContact};
use super::svg::escaped;
use std::fmt::Write;

/// The contacts, each at its greatest total, in order of onset.
pub fn contacts(seen: &Seen) -> String {
    if seen.contacts.is_empty() {
        return "<p>Nothing touched the garment.</p>\n".into();
    }
    let mut strongest: Vec<_> = seen.contacts.values().collect();
    strongest.sort_by_key(|contact| std::cmp::Reverse(contact.placed.contact.total));
    strongest.truncate(LISTED);
    strongest.sort_by_key(|contact| contact.placed.contact.id);
    let unit = seen.scale().unit();
    let mut html = format!(
        "<table><tr><th>contact</th><th>panel</th><th>onset, s</th><th>duration, s</th><th>total, {unit}</th>\
         <th>peak, {unit}</th><th>at row, column</th><th>area, taxels</th><th>centroid x, y</th>\
         <th>azimuth</th><th>shape</th></tr>\n",
    );
    strongest.iter().for_each(|contact| row(seen, contact, &mut html));
    html += "</table>\n";
    if seen.touches > LISTED as u64 {
        // Writing to a string cannot fail.
        let _ = writeln!(html, "<p>The {LISTED} strongest of {}.</p>", seen.touches);
    }
    html
}

fn row(seen: &Seen, SeenContact { placed, shape }: &SeenContact, html: &mut String) {
    let contact = &placed.contact;
    let panel = seen.areas().get(usize::from(contact.panel)).map_or("", |area| area.name.as_str());
    let azimuth =
        contact.azimuth.map_or("none".into(), |turn| format!("{:.0}&deg;", turn.to_radians().to_degrees()));
    let _ = writeln!(
        html,
        "<tr><td>#{}</td><td>{}</td><td>{:.3}</td><td>{:.3}</td><td>{}</td><td>{}</td><td>{}, {}</td><td>{}</td>\
         <td>{:.2}, {:.2}</td><td>{azimuth}</td><td>{}</td></tr>",
        contact.id,
        escaped(panel),
        contact.onset.0 as f64 / 1e6,
        f64::from(contact.duration_ms) / 1000.0,
        seen.scale().text_of(contact.total),
        seen.scale().text_of(contact.peak),
        contact.peak_at.row,
        contact.peak_at.column,
        contact.area,
        contact.x.to_f64(),
        contact.y.to_f64(),
        escaped(shape),
    );
}

/// Events in sentences.
pub fn events(seen: &Seen) -> String {
    let mut html = format!("<pre>{}</pre>\n", escaped(&seen.sentences.join("\n")));
    if seen.unsaid > 0 {
        let _ = writeln!(html, "<p>And {} more.</p>", seen.unsaid);
    }
    html
}

/// Counters of the board and of the line, and the faulty taxels.
pub fn health(seen: &Seen) -> String {
    let mut rows = vec![
        ("frames received", seen.counts.frames),
        ("messages lost on the line", seen.counts.lost),
        ("frames thinned", seen.counts.thinned),
        ("frames that were not messages", seen.counts.refused()),
        ("restarts of the board", seen.counts.restarts),
    ];
    if let Some(health) = &seen.health {
        let board = [
            ("scans", health.scans),
            ("scans failed", health.failed),
            ("scans not fetched in time", health.overruns),
            ("guaranteed messages lost", health.lost),
            ("last scan, us", health.scan_us),
            ("last perception, us", health.process_us),
        ];
        rows.extend(board.map(|(name, count)| (name, count.into())));
    }
    let mut html = String::from("<table>");
    rows.iter().for_each(|(name, count)| _ = writeln!(html, "<tr><td>{name}</td><td>{count}</td></tr>"));
    html += "</table>\n";
    if !seen.skipped.is_none() {
        let _ = writeln!(html, "<p>Of the recording: {}.</p>", seen.skipped);
    }
    if seen.faulty.is_empty() {
        return html + "<p>No faulty taxels.</p>\n";
    }
    let layout = seen.description.as_ref().map(|description| &description.layout);
    let faulty = seen.faulty.iter().map(|(taxel, health)| {
        let place = layout.and_then(|layout| Some((layout, layout.place(usize::from(*taxel))?)));
        let place = place.map_or(format!("taxel {taxel}"), |(layout, place)| {
            let panel = layout.areas().get(usize::from(place.panel)).map_or("", |area| area.name.as_str());
            format!("{panel} row {} column {}", place.row, place.column)
        });
        escaped(&format!("{place}: {health}"))
    });
    format!("{html}<p>Faulty taxels: {}.</p>\n", faulty.collect::<Vec<_>>().join("; "))
}
