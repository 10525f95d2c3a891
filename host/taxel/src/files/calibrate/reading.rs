//! Readings of taxels at rest and under a known force.

/// The garment at rest.
#[derive(Debug, Default, Clone, PartialEq)]
pub struct Rest {
    /// Mean code by taxel.
    pub codes: Vec<f64>,
    /// Noise of one taxel in one frame, rms over all, counts.
    pub noise: f64,
}

impl Rest {
    /// Rest from the codes of some frames.
    pub fn of(frames: &[Vec<u16>]) -> Rest {
        let taxels = frames.iter().map(Vec::len).min().unwrap_or(0);
        let column = |taxel: usize| frames.iter().map(move |codes| f64::from(codes[taxel]));
        let codes: Vec<f64> = (0..taxels).map(|taxel| mean(column(taxel))).collect();
        let variance = |taxel: usize| mean(column(taxel).map(|code| (code - codes[taxel]).powi(2)));
        Rest { noise: mean((0..taxels).map(variance)).sqrt(), codes }
    }
}

/// Means over the frames of a steady load.
#[derive(Debug, Clone, PartialEq)]
pub struct Reading {
    /// Index of the plate.
    pub plate: usize,
    /// Weight on it, N.
    pub newtons: f64,
    /// True if the weight before was heavier (unloading).
    pub going: bool,
    /// Counts above rest by taxel of the plate.
    pub counts: Vec<f64>,
    /// Standard deviation in one frame, by taxel of the plate, counts.
    pub noise: Vec<f64>,
}

impl Reading {
    /// Force on each taxel, N.
    pub fn each(&self) -> f64 {
        self.newtons / self.counts.len() as f64
    }
}

/// Mean; 0 for no values.
pub fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0.0), |(sum, count), value| (sum + value, count + 1.0));
    if count > 0.0 { sum / count } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rest_is_the_mean_and_what_strays_from_it() {
        let rest = Rest::of(&[vec![10, 100], vec![14, 100]]);
        assert_eq!(rest.codes, [12.0, 100.0]);
        // Variances of 4 and 0.
        assert!((rest.noise - 2f64.sqrt()).abs() < 1e-12);
        assert_eq!(Rest::of(&[]), Rest::default());
    }
}
