//! Values over time in bounded memory, at the resolution of a drawing, whatever their duration.

/// Most points kept; the drawing shows half as many.
const MOST: usize = 1160;

/// Times, us, and values; each point is the maximum of a period, at its first time.
#[derive(Debug, Clone, Default)]
pub struct Series {
    points: Vec<(u64, Vec<f64>)>,
    /// Values per point.
    stride: usize,
    /// Values in the last point.
    filled: usize,
    span: Option<[u64; 2]>,
}

impl Series {
    /// Adds values at a time.
    pub fn push(&mut self, time: u64, values: Vec<f64>) {
        self.span = Some([self.span.map_or(time, |[first, _]| first), time]);
        self.stride = self.stride.max(1);
        if self.filled == self.stride || self.points.is_empty() {
            if self.points.len() == MOST {
                self.halve();
            }
            self.points.push((time, values));
            self.filled = 1;
        } else if let Some(last) = self.points.last_mut() {
            greatest(&mut last.1, &values);
            self.filled += 1;
        }
    }

    /// Merges pairs of points.
    fn halve(&mut self) {
        let pairs = self.points.chunks_mut(2).map(|pair| {
            let (first, rest) = pair.split_at_mut(1);
            let (time, mut values) = std::mem::take(&mut first[0]);
            rest.iter().for_each(|(_, more)| greatest(&mut values, more));
            (time, values)
        });
        self.points = pairs.collect();
        self.stride *= 2;
    }

    /// The points.
    pub fn points(&self) -> &[(u64, Vec<f64>)] {
        &self.points
    }

    /// First and last time.
    pub fn span(&self) -> [u64; 2] {
        self.span.unwrap_or_default()
    }
}

fn greatest(kept: &mut [f64], more: &[f64]) {
    kept.iter_mut().zip(more).for_each(|(kept, value)| *kept = kept.max(*value));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn peaks_stay_and_memory_does_not_grow() {
        let mut series = Series::default();
        for time in 0..100_000u64 {
            series.push(time, vec![if time == 77_777 { 9.0 } else { 1.0 }, time as f64]);
        }
        let points = series.points();
        assert!((MOST / 2..=MOST).contains(&points.len()), "{}", points.len());
        assert_eq!((series.span(), points[0].0), ([0, 99_999], 0));
        let peaks: Vec<_> = points.iter().filter(|(_, values)| values[0] == 9.0).collect();
        assert_eq!(peaks.len(), 1);
        assert!(peaks[0].0 <= 77_777 && peaks[0].0 + 256 > 77_777);
        assert_eq!(points.last().unwrap().1[1], 99_999.0);
        assert!(points.is_sorted_by(|a, b| a.0 < b.0));
    }
}
