//! Draws the graph of a map as SVG. Width is strength; blue solid edges increase, vermilion
//! dashed ones decrease, so that either colour or dash suffices; the fill of a concept is its activation,
//! which is also written.

use super::layers;
use super::map::{EdgeFile, MapFile};
use std::fmt::Write as _;

/// Distance between layers and between concepts of a layer, and size of a concept, pixels.
const LAYER: f64 = 190.0;
const PLACE: f64 = 74.0;
const WIDTH: f64 = 122.0;
const HEIGHT: f64 = 38.0;
const MARGIN: f64 = 30.0;
/// Colours of Okabe and Ito, distinguishable with any colour vision.
const MORE: &str = "#0072b2";
const LESS: &str = "#d55e00";

/// Draws the graph; `activations` are by concept number.
pub fn svg(map: &MapFile, activations: Option<&[f64]>) -> String {
    let layers = layers::of_map(map);
    let last = layers.iter().max().copied().unwrap_or(0);
    let count = |layer: usize| layers.iter().filter(|l| **l == layer).count();
    let tallest = (0..=last).map(count).max().unwrap_or(1);
    let place = |at: usize| {
        let above = layers[..at].iter().filter(|layer| **layer == layers[at]).count();
        let top = (tallest - count(layers[at])) as f64 / 2.0;
        // Layers are slightly skewed, so that an edge does not cross the concepts between its ends.
        let askew = if layers[at].is_multiple_of(2) { 0.0 } else { PLACE * 0.37 };
        (MARGIN + layers[at] as f64 * LAYER, MARGIN + (above as f64 + top) * PLACE + askew)
    };
    let (width, height) =
        (2.0 * MARGIN + last as f64 * LAYER + WIDTH, 2.0 * MARGIN + (tallest as f64 + 0.6) * PLACE);
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width:.0} {height:.0}\" font-family=\"sans-serif\" font-size=\"13\">\n\
         <title>{}</title>\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
        escaped(&map.name)
    );
    for edge in map.edge.iter().filter(|edge| edge.weight.value() != 0.0) {
        if let (Some(from), Some(to)) = (map.find(&edge.from), map.find(&edge.to)) {
            text += &arrow(edge, place(from), place(to), layers[from] < layers[to]);
        }
    }
    for (at, concept) in map.concept.iter().enumerate() {
        text += &node(&concept.name, &concept.note, activations.map(|all| all[at]), place(at));
    }
    let _ = writeln!(
        text,
        "<text x=\"{MARGIN}\" y=\"{:.0}\" font-size=\"11\"><tspan fill=\"{MORE}\">solid: increases</tspan> \
         <tspan fill=\"{LESS}\" dx=\"12\">dashed: decreases</tspan></text>\n</svg>",
        height - 10.0
    );
    text
}

/// From the right side of the cause to the left side of the effect; backward edges run around below.
fn arrow(edge: &EdgeFile, from: (f64, f64), to: (f64, f64), onwards: bool) -> String {
    let weight = edge.weight.value();
    let (x0, y0) = (from.0 + WIDTH, from.1 + HEIGHT / 2.0);
    let (x1, y1) = (to.0 - 7.0, to.1 + HEIGHT / 2.0);
    let reach = if onwards { (x1 - x0) / 2.0 } else { LAYER * 0.4 };
    let sag = if onwards { 0.0 } else { PLACE };
    let (colour, dash) = if weight > 0.0 { (MORE, "") } else { (LESS, " stroke-dasharray=\"7 4\"") };
    let mut title = format!("{} to {}: {}", edge.from, edge.to, edge.weight);
    if !edge.note.is_empty() {
        title += &format!(" ({})", edge.note);
    }
    // A quarter along the curve.
    let label = |a: f64, b: f64, c: f64, d: f64| (27.0 * a + 27.0 * b + 9.0 * c + d) / 64.0;
    let (lx, ly) = (label(x0, x0 + reach, x1 - reach, x1), label(y0, y0 + sag, y1 + sag, y1));
    format!(
        "<g stroke=\"{colour}\" fill=\"none\" opacity=\"0.8\"><title>{}</title><path d=\"M{x0:.1} {y0:.1}C{:.1} {:.1} {:.1} {:.1} {x1:.1} {y1:.1}\" \
         stroke-width=\"{:.1}\"{dash}/><path d=\"M{:.1} {:.1}L{:.1} {y1:.1}L{:.1} {:.1}Z\" fill=\"{colour}\" stroke=\"none\"/>\
         <text x=\"{lx:.1}\" y=\"{:.1}\" font-size=\"9\" fill=\"{colour}\" stroke=\"none\">{weight}</text></g>\n",
        escaped(&title),
        x0 + reach,
        y0 + sag,
        x1 - reach,
        y1 + sag,
        0.6 + 4.4 * weight.abs(),
        x1 - 2.0,
        y1 - 5.0,
        x1 + 7.0,
        x1 - 2.0,
        y1 + 5.0,
        ly - 3.0,
    )
}

fn node(name: &str, note: &str, activation: Option<f64>, (x, y): (f64, f64)) -> String {
    let value = activation.map_or(String::new(), |value| format!(" {value:+.2}"));
    format!(
        "<g><title>{}</title><rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{WIDTH}\" height=\"{HEIGHT}\" rx=\"8\" fill=\"{}\" stroke=\"#333\"/>\
         <text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}{value}</text></g>\n",
        escaped(if note.is_empty() { name } else { note }),
        fill(activation.unwrap_or(0.0)),
        x + WIDTH / 2.0,
        y + HEIGHT / 2.0 + 4.5,
        escaped(name),
    )
}

/// White at 0, sky blue at 1, orange at -1.
fn fill(activation: f64) -> String {
    let end = if activation < 0.0 { [230.0, 159.0, 0.0] } else { [86.0, 180.0, 233.0] };
    let [r, g, b] = end.map(|c: f64| (255.0 + (c - 255.0) * activation.abs().min(1.0)).round() as u8);
    format!("#{r:02x}{g:02x}{b:02x}")
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
