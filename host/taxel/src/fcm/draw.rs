//! The graph of a map in DOT, the language of Graphviz. Width is strength; blue solid edges increase, vermilion
//! dashed ones decrease, so that either colour or dash suffices; the fill of a concept is its activation,
//! which is also written.

use super::map::MapFile;
use std::fmt::Write as _;

/// Colours of Okabe and Ito, distinguishable with any colour vision.
const MORE: &str = "#0072b2";
const LESS: &str = "#d55e00";

/// Describes the graph; `activations` are by concept number.
pub fn dot(map: &MapFile, activations: Option<&[f64]>) -> String {
    let begin = "rankdir=LR\nnode [shape=box, style=\"rounded,filled\"]\n";
    let mut text = format!("digraph {} {{\n{begin}", quoted(&map.name));
    // Writing to a string cannot fail.
    for (at, concept) in map.concept.iter().enumerate() {
        let value = activations.map(|all| all[at]);
        let label = concept.name.clone() + &value.map_or(String::new(), |value| format!(" {value:+.2}"));
        let _ = writeln!(
            text,
            "{} [label={}, tooltip={}, fillcolor=\"{}\"]",
            quoted(&concept.name),
            quoted(&label),
            quoted(if concept.note.is_empty() { &concept.name } else { &concept.note }),
            fill(value.unwrap_or(0.0))
        );
    }
    for edge in map.edge.iter().filter(|edge| edge.weight.value() != 0.0) {
        let weight = edge.weight.value();
        let (colour, style) = if weight > 0.0 { (MORE, "solid") } else { (LESS, "dashed") };
        let _ = writeln!(
            text,
            "{} -> {} [label=\"{weight}\", tooltip={}, color=\"{colour}\", style={style}, penwidth={:.1}]",
            quoted(&edge.from),
            quoted(&edge.to),
            quoted(format!("{} {}", edge.weight, edge.note).trim_end()),
            0.6 + 4.4 * weight.abs()
        );
    }
    text + "}\n"
}

/// White at 0, sky blue at 1, orange at -1.
fn fill(activation: f64) -> String {
    let end = if activation < 0.0 { [230.0, 159.0, 0.0] } else { [86.0, 180.0, 233.0] };
    let [r, g, b] = end.map(|c: f64| (255.0 + (c - 255.0) * activation.abs().min(1.0)).round() as u8);
    format!("#{r:02x}{g:02x}{b:02x}")
}

fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('\\', "\\\\").replace('"', "\\\""))
}
