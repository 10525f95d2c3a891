//! Shared by the drawings.

use crate::palette::{self, hex};
use taxel_core::intent::Leading;

/// Colour of a pressure.
pub fn colour(value: f64, top: u16) -> String {
    hex(palette::pressure(value.round().clamp(0.0, 65535.0) as u16, top))
}

/// Line colours that colour-blind readers can distinguish: those of Okabe and Ito that no intention has.
const LINES: [&str; 5] = ["#0072b2", "#cc79a7", "#56b4e9", "#999999", "#8c8c00"];

/// Colour of a line, and its dashes: an intention has its own everywhere, the other colours repeat, dashed.
pub fn line(name: &str, index: usize) -> (String, &'static str) {
    let known = Leading::INTENTIONS.into_iter().find(|leading| leading.as_str() == name);
    let ink =
        known.map_or_else(|| LINES[index % LINES.len()].into(), |leading| hex(palette::intention(leading)));
    let is_solid = known.is_some() || index < LINES.len();
    (ink, if is_solid { "" } else { " stroke-dasharray=\"5 3\"" })
}

/// Escapes text for HTML and SVG.
pub fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// End of a scale for `greatest`: a round number not far above it.
pub fn nice_top(greatest: f64) -> f64 {
    if greatest.is_nan() || greatest <= 0.0 {
        return 1.0;
    }
    let power = 10f64.powf(greatest.log10().floor());
    let steps = [1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0].map(|step| step * power);
    steps.into_iter().find(|top| *top >= greatest).unwrap_or(10.0 * power)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scales_end_at_round_numbers() {
        let tops = [0.0, 0.7, 1.0, 1.1, 230.0, 4095.0].map(nice_top);
        assert!(
            tops.iter()
                .zip([1.0, 0.8, 1.0, 1.5, 300.0, 5000.0])
                .all(|(a, b): (&f64, f64)| (a - b).abs() < 1e-9)
        );
        assert_eq!(escaped("a<\"b\"&"), "a&lt;&quot;b&quot;&amp;");
    }
}
