//! The moment as a surface, and on the robot: the page's own pictures, with what they would be sent.

use super::script;
use super::seen::Seen;
use crate::on_robot::ShownRobot;
use crate::palette;
use serde_json::{Value, json};

/// Style of the surface.
pub const STYLE: &str = include_str!("../view/page/relief.css");

/// Place at which the script draws the robot.
pub const ROBOT: &str = "<div id=\"robot\"></div>\n<p id=\"pointed-robot\">&nbsp;</p>\n";

/// The surface on a scale that ends at `top` counts.
pub fn draw(seen: &Seen, top: u16) -> String {
    // Nothing in a text can end the element that holds it.
    let data = data(seen, top).to_string().replace('<', "\\u003c");
    format!(
        "<div id=\"surface\" data-top=\"{top}\"></div>\n<p id=\"pointed\">&nbsp;</p>\n\
         <noscript><p>The surface is drawn by a script of this page.</p></noscript>\n\
         <script type=\"application/json\" id=\"data\">{data}</script>\n<script type=\"module\">{}</script>\n",
        script::bundle()
    )
}

/// Returns what `frozen.js` reads: the garment as in the page's `hello`, the image, and the peaks with their values.
fn data(seen: &Seen, top: u16) -> Value {
    let unit = seen.scale();
    let panels = seen.areas().iter().map(|area| {
        json!({
            "name": area.name.as_str(),
            "rows": area.rows,
            "columns": area.columns,
            "pitch_um": area.pitch_um,
        })
    });
    let peaks = seen.top.contacts.iter().filter_map(|placed| {
        let contact = &placed.contact;
        let area = seen.areas().get(usize::from(contact.panel))?;
        let row = usize::from(contact.peak_at.row) * usize::from(area.columns);
        let taxel = usize::from(area.base) + row + usize::from(contact.peak_at.column);
        Some(json!({ "taxel": taxel, "text": unit.text_of(contact.peak) }))
    });
    json!({
        "palette": palette::for_page(),
        "panels": panels.collect::<Vec<_>>(),
        "absent": seen.description.as_ref().map(|description| &description.garment.absent),
        "image": seen.top.image,
        "top": top,
        "peaks": peaks.collect::<Vec<_>>(),
        "unit": unit.unit(),
        "per_count": unit.value(1.0),
        "body": seen.shown_robot.as_ref().and_then(ShownRobot::body),
        "figure": seen.shown_robot.as_ref().and_then(ShownRobot::figure),
        "poses": seen.shown_robot.as_ref().and_then(ShownRobot::poses),
        "pressing": seen.top.pressing,
        "folding": seen.top.folding,
    })
}
