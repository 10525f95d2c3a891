//! One touch, as it was felt at addresses whose places are not known.

/// Part of a frame's strongest signal below which an address counts as not touched: crosstalk, the rim of a
/// finger.
const RIM: f32 = 0.15;
/// Part of the strongest address's sum below which an address tells nothing of a stroke.
const FAINT: f64 = 0.1;

/// One frame of a touch.
#[derive(Debug, Clone, PartialEq)]
pub struct Moment {
    /// Time of the board, s.
    pub time: f64,
    /// Addresses that were touched, and how hard, counts above rest.
    pub felt: Vec<(usize, f32)>,
}

/// A touch from its first frame to its last.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Touch {
    /// The frames in which something was felt.
    pub moments: Vec<Moment>,
}

/// What an address has felt of a touch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Trace {
    /// Number of the address.
    pub address: usize,
    /// Sum of its signal.
    pub sum: f64,
    /// Mean time of its signal, s.
    pub time: f64,
}

impl Touch {
    /// From the first to the last frame, s.
    pub fn duration(&self) -> f64 {
        match (self.moments.first(), self.moments.last()) {
            (Some(first), Some(last)) => last.time - first.time,
            _ => 0.0,
        }
    }

    /// What each address has felt, by address; those that felt next to nothing are left out.
    pub fn traces(&self) -> Vec<Trace> {
        let mut sums = std::collections::BTreeMap::<usize, (f64, f64)>::new();
        for moment in &self.moments {
            for (address, signal) in moment.strong() {
                let (sum, time) = sums.entry(address).or_default();
                *sum += f64::from(signal);
                *time += f64::from(signal) * moment.time;
            }
        }
        let most = sums.values().map(|(sum, _)| *sum).fold(0.0, f64::max);
        let strong = sums.into_iter().filter(|(_, (sum, _))| *sum >= FAINT * most);
        strong.map(|(address, (sum, time))| Trace { address, sum, time: time / sum }).collect()
    }
}

impl Moment {
    /// Addresses under the finger itself.
    pub fn strong(&self) -> impl Iterator<Item = (usize, f32)> + '_ {
        let most = self.felt.iter().map(|(_, signal)| *signal).fold(0.0, f32::max);
        self.felt.iter().copied().filter(move |(_, signal)| *signal >= RIM * most)
    }
}
