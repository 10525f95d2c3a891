//! Codes of a board from the raw values of a frame.

use super::description::ArrayDescription;
use super::frame::ArrayFrame;

/// Code of a full scale.
const FULL_SCALE: f64 = 4095.0;
/// Frames whose mean is the start of a change.
const BASELINE: usize = 5;

/// Map of raw values to codes: `round(4095 (v - low) / (high - low))`, clipped; 4095 minus that if they fall.
#[derive(Debug, Clone)]
pub struct CodeMap {
    low: f64,
    span: f64,
    falling: bool,
    /// Values of a row, and those whose change is a taxel's value.
    change: Option<(usize, Vec<usize>)>,
    /// Sum of the first frames, and their number.
    baseline: (Vec<f64>, usize),
}

impl CodeMap {
    /// The map of a description; of 0 to 4095 if it has no range.
    pub fn new(description: &ArrayDescription) -> CodeMap {
        let [low, high] = description.range.unwrap_or([0.0, FULL_SCALE]);
        let columns = usize::from(description.columns);
        let of = |columns_of: &[u16]| columns_of.iter().map(|column| usize::from(*column)).collect();
        let change = (!description.change_of.is_empty()).then(|| (columns, of(&description.change_of)));
        CodeMap { low, span: high - low, falling: description.falling, change, baseline: (Vec::new(), 0) }
    }

    /// Writes the codes of a frame; returns false as long as the start of a change is being measured.
    pub fn codes(&mut self, frame: &ArrayFrame, codes: &mut Vec<u16>) -> bool {
        codes.clear();
        let Some((columns, of)) = self.change.clone() else {
            codes.extend(frame.values.iter().map(|value| self.code(*value)));
            return true;
        };
        let (sums, count) = &mut self.baseline;
        if *count < BASELINE {
            sums.resize(frame.values.len(), 0.0);
            sums.iter_mut().zip(&frame.values).for_each(|(sum, value)| *sum += value);
            *count += 1;
            return false;
        }
        let change = |at: usize| frame.values[at] - self.baseline.0[at] / BASELINE as f64;
        for row in 0..frame.values.len() / columns {
            let squares = of.iter().map(|column| change(row * columns + column).powi(2));
            codes.push(self.code(squares.sum::<f64>().sqrt()));
        }
        true
    }

    fn code(&self, value: f64) -> u16 {
        let code = (FULL_SCALE * (value - self.low) / self.span).round().clamp(0.0, FULL_SCALE);
        (if self.falling { FULL_SCALE - code } else { code }) as u16
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn codes(map: &mut CodeMap, values: &[f64]) -> Option<Vec<u16>> {
        let frame = ArrayFrame { values: values.into(), arrival_us: 0, time_us: None, sequence: None };
        let mut codes = Vec::new();
        map.codes(&frame, &mut codes).then_some(codes)
    }

    #[test]
    fn values_are_scaled_clipped_and_turned() {
        let text = "rows = 1\ncolumns = 4\nrange = [-10, 10]\n[frame]\nkind = \"lines\"\n";
        let mut description = ArrayDescription::parse(text, "").unwrap();
        assert_eq!(
            codes(&mut CodeMap::new(&description), &[-20.0, 0.0, 9.9, 10.0]),
            Some(vec![0, 2048, 4075, 4095])
        );
        description.falling = true;
        assert_eq!(
            codes(&mut CodeMap::new(&description), &[-20.0, 0.0, 9.9, 99.0]),
            Some(vec![4095, 2047, 20, 0])
        );
    }

    #[test]
    fn a_change_is_measured_from_the_first_frames() {
        let text =
            "rows = 1\ncolumns = 3\nrange = [0, 4095]\nchange_of = [1, 2]\n[frame]\nkind = \"lines\"\n";
        let mut map = CodeMap::new(&ArrayDescription::parse(text, "").unwrap());
        for _ in 0..BASELINE {
            assert_eq!(codes(&mut map, &[25.0, -100.0, 7.0]), None);
        }
        assert_eq!(codes(&mut map, &[99.0, -103.0, 11.0]), Some(vec![5]));
    }
}
