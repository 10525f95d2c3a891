//! One touch, felt at addresses whose places are unknown.

/// Share of a frame's strongest signal below which an address counts as untouched: crosstalk, or the rim of a
/// finger.
const RIM: f32 = 0.15;
/// Share of the strongest address's sum below which an address is ignored.
const FAINT: f64 = 0.1;

/// One frame of a touch.
#[derive(Debug, Clone, PartialEq)]
pub struct TouchFrame {
    /// Time of the board, s.
    pub time: f64,
    /// Touched addresses and their signals, counts above rest.
    pub felt: Vec<(usize, f32)>,
}

/// A touch from its first frame to its last.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Touch {
    /// The frames in which something was felt.
    pub moments: Vec<TouchFrame>,
}

/// Signal of one address during a touch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Trace {
    /// Address.
    pub address: usize,
    /// Sum of its signal.
    pub sum: f64,
    /// Mean time of its signal, s.
    pub time: f64,
}

impl Touch {
    /// Time from the first to the last frame, s.
    pub fn duration(&self) -> f64 {
        match (self.moments.first(), self.moments.last()) {
            (Some(first), Some(last)) => last.time - first.time,
            _ => 0.0,
        }
    }

    /// Signals by address; faint ones are left out.
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

impl TouchFrame {
    /// Addresses under the finger itself.
    pub fn strong(&self) -> impl Iterator<Item = (usize, f32)> + '_ {
        let most = self.felt.iter().map(|(_, signal)| *signal).fold(0.0, f32::max);
        self.felt.iter().copied().filter(move |(_, signal)| *signal >= RIM * most)
    }
}
