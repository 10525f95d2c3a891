//! Curves over time.

use super::svg::{escaped, line, nice_top};
use std::fmt::{Result, Write};

/// Size of the drawing, SVG units, and the area inside the axes: left, top, right, bottom.
const SIZE: [f64; 2] = [780.0, 220.0];
const FRAME: [f64; 4] = [56.0, 12.0, 640.0, 190.0];
/// Most marks of the time axis.
const MARKS: f64 = 10.0;

/// Curves over time: their names, and the values of all at each time (us).
pub struct Strip<'a> {
    /// Names of the curves.
    pub names: Vec<&'a str>,
    /// Times, us, and values.
    pub points: Vec<(u64, Vec<f64>)>,
    /// Quantity and unit.
    pub label: &'a str,
    /// True if a value holds until the next; else lines connect them.
    pub steps: bool,
    /// First and last time, us.
    pub span: [u64; 2],
}

impl Strip<'_> {
    /// Draws the curves.
    pub fn draw(&self) -> String {
        let mut svg = String::new();
        // Writing to a string cannot fail.
        let _ = self.write(&mut svg);
        svg
    }

    fn x(&self, time: u64) -> f64 {
        let [first, last] = self.span;
        let part = time.saturating_sub(first) as f64 / last.saturating_sub(first).max(1) as f64;
        FRAME[0] + part.min(1.0) * (FRAME[2] - FRAME[0])
    }

    fn write(&self, svg: &mut String) -> Result {
        let values = || self.points.iter().flat_map(|(_, values)| values);
        let top = nice_top(values().copied().fold(0.0, f64::max));
        let low = if values().any(|value| *value < 0.0) { -top } else { 0.0 };
        let y = |value: f64| FRAME[3] - (value - low) / (top - low) * (FRAME[3] - FRAME[1]);
        let [width, height] = SIZE;
        let about = escaped(self.label);
        writeln!(
            svg,
            "<svg viewBox=\"0 0 {width} {height}\" width=\"{width}\" role=\"img\" aria-label=\"{about} over time\">"
        )?;
        self.axes(svg, low, top, &y)?;
        let kept = &self.points;
        for (index, name) in self.names.iter().enumerate() {
            let (ink, dash) = line(name, index);
            write!(svg, "<path class=\"line\" stroke=\"{ink}\"{dash} d=\"")?;
            for (count, (time, values)) in kept.iter().enumerate() {
                let (x, y) = (self.x(*time), y(values.get(index).copied().unwrap_or(0.0)));
                match (count, self.steps) {
                    (0, _) => write!(svg, "M{x:.1} {y:.1}")?,
                    (_, true) => write!(svg, "H{x:.1}V{y:.1}")?,
                    (_, false) => write!(svg, "L{x:.1} {y:.1}")?,
                }
            }
            if self.steps && !kept.is_empty() {
                write!(svg, "H{}", FRAME[2])?;
            }
            let at = FRAME[1] + 12.0 + 17.0 * index as f64;
            writeln!(
                svg,
                "\"/><path class=\"line\" stroke=\"{ink}\"{dash} d=\"M{:.0} {:.0}h16\"/><text x=\"{:.0}\" y=\"{at:.0}\">{}</text>",
                FRAME[2] + 12.0,
                at - 4.0,
                FRAME[2] + 34.0,
                escaped(name)
            )?;
        }
        writeln!(svg, "</svg>")
    }

    fn axes(&self, svg: &mut String, low: f64, top: f64, y: &dyn Fn(f64) -> f64) -> Result {
        let [left, _, right, bottom] = FRAME;
        let values: Vec<f64> = (0..=4).map(|part| low + (top - low) * f64::from(part) / 4.0).collect();
        let digits = decimals(&values);
        for value in values {
            let at = y(value);
            writeln!(
                svg,
                "<path class=\"grid\" d=\"M{left} {at:.1}H{right}\"/><text class=\"mark\" x=\"{:.0}\" y=\"{:.1}\" text-anchor=\"end\">{value:.digits$}</text>",
                left - 6.0,
                at + 3.5
            )?;
        }
        let [first, last] = self.span.map(|us| us as f64 / 1e6);
        let step = nice_top((last - first) / MARKS);
        // An integer count, because adding a step to a time of days or of garbage may not change it.
        let begin = (first / step).ceil();
        let marks = (0..=MARKS as u32 + 1).map(|mark| (begin + f64::from(mark)) * step);
        for time in marks.take_while(|time| *time <= last) {
            let x = self.x((time * 1e6) as u64);
            writeln!(
                svg,
                "<text class=\"mark\" x=\"{x:.1}\" y=\"{:.0}\" text-anchor=\"middle\">{}</text>",
                bottom + 15.0,
                (time * 1000.0).round() / 1000.0
            )?;
        }
        writeln!(
            svg,
            "<text class=\"mark\" x=\"{right}\" y=\"{:.0}\" text-anchor=\"end\">s</text>",
            bottom + 28.0
        )?;
        writeln!(
            svg,
            "<text class=\"mark\" transform=\"translate(11 {:.0}) rotate(-90)\" text-anchor=\"middle\">{}</text>",
            f64::midpoint(FRAME[1], bottom),
            escaped(self.label)
        )
    }
}

/// Least number of decimals, at most 6, that write all values exactly.
fn decimals(values: &[f64]) -> usize {
    let is_exact = |digits: &usize| {
        let mut scaled = values.iter().map(|value| value * 10f64.powi(*digits as i32));
        scaled.all(|value| (value - value.round()).abs() < 1e-6)
    };
    (0..6).find(is_exact).unwrap_or(6)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_of_an_axis_are_short_and_differ() {
        for (greatest, wanted) in [
            (0.28, ["0.000", "0.075", "0.150", "0.225", "0.300"]),
            (0.19, ["0.00", "0.05", "0.10", "0.15", "0.20"]),
            (7.7, ["0", "2", "4", "6", "8"]),
            (4095.0, ["0", "1250", "2500", "3750", "5000"]),
        ] {
            let (names, points) = (vec!["chest"], vec![(0, vec![0.0]), (1_000_000, vec![greatest])]);
            let strip = Strip { names, points, label: "N", steps: false, span: [0, 1_000_000] };
            let drawn = strip.draw();
            let marks: Vec<_> = drawn.split("text-anchor=\"end\">").skip(1).take(5).collect();
            let marks: Vec<_> = marks.iter().filter_map(|text| text.split('<').next()).collect();
            assert_eq!(marks, wanted);
        }
    }

    #[test]
    fn a_strip_of_any_times_has_an_end() {
        let last = u64::MAX;
        for span in [[0, 0], [0, last], [last, last], [last - 1000, last], [last, 0], [1, 60_000_000]] {
            let points = vec![(span[0], vec![1.0]), (span[1], vec![2.0])];
            let strip = Strip { names: vec!["a"], points, label: "N", steps: true, span };
            let drawn = strip.draw();
            assert!(drawn.ends_with("</svg>\n") && drawn.len() < 10_000, "{span:?}: {} bytes", drawn.len());
        }
    }
}
