//! What taxels showed under a known force.

/// Means over the frames of a steady load.
#[derive(Debug, Clone, PartialEq)]
pub struct Reading {
    /// Index of the plate.
    pub plate: usize,
    /// Weight on it, N.
    pub newtons: f64,
    /// The weight before was heavier.
    pub going: bool,
    /// Counts above rest by taxel of the plate.
    pub counts: Vec<f64>,
    /// Standard deviation of one frame's by taxel of the plate, counts.
    pub noise: Vec<f64>,
}

impl Reading {
    /// Force on each taxel, N.
    pub fn each(&self) -> f64 {
        self.newtons / self.counts.len() as f64
    }
}
