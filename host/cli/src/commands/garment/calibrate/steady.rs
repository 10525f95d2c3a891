//! Detects a steady load: the mean over the plate has left the last load, and stands still.

use std::collections::VecDeque;
use taxel::files::calibrate::mean;

/// Frames of a steady load.
const FRAMES: usize = 32;
/// Tolerated difference of the two halves of these frames: standard errors, or share of the load if that is
/// more.
const STILL: (f64, f64) = (3.0, 0.004);
/// Least difference from the load before, standard errors.
const MOVED: f64 = 6.0;

/// A steady load: means by taxel, and noise of one frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Held {
    /// Mean, counts.
    pub counts: Vec<f64>,
    /// Standard deviation, counts.
    pub noise: Vec<f64>,
}

/// Detects a load.
#[derive(Debug)]
pub struct Steady {
    frames: VecDeque<Vec<f64>>,
    /// Last load's mean over the plate, and least difference from it.
    from: f64,
    least: f64,
}

impl Steady {
    /// Detects a load that differs from `from` (mean over the plate, counts) by more than `least` counts, and
    /// by more than noise.
    pub fn away_from(from: f64, least: f64) -> Steady {
        Steady { frames: VecDeque::new(), from, least }
    }

    /// Mean over the plate of the last frame, counts.
    pub fn now(&self) -> f64 {
        self.frames.back().map_or(0.0, |frame| mean(frame.iter().copied()))
    }

    /// Takes a frame of the plate's taxels, counts above rest. Returns the load once it is steady.
    pub fn take(&mut self, counts: Vec<f64>) -> Option<Held> {
        if self.frames.len() == FRAMES {
            self.frames.pop_front();
        }
        self.frames.push_back(counts);
        if self.frames.len() < FRAMES {
            return None;
        }
        let totals: Vec<f64> = self.frames.iter().map(|frame| mean(frame.iter().copied())).collect();
        let (early, late) = totals.split_at(FRAMES / 2);
        let (early, late) = (mean(early.iter().copied()), mean(late.iter().copied()));
        let all = (early + late) / 2.0;
        // From frame to frame, so that a slow change does not count as noise.
        let steps = totals.windows(2).map(|pair| (pair[1] - pair[0]).powi(2) / 2.0);
        let error = (mean(steps) / FRAMES as f64).sqrt();
        let still = (late - early).abs() <= (2.0 * STILL.0 * error).max(STILL.1 * all.abs());
        let moved = (all - self.from).abs() > self.least.max(MOVED * error);
        (still && moved).then(|| self.held())
    }

    fn held(&self) -> Held {
        let taxels = self.frames.front().map_or(0, Vec::len);
        let column = |taxel: usize| self.frames.iter().map(move |frame| frame[taxel]);
        let counts: Vec<f64> = (0..taxels).map(|taxel| mean(column(taxel))).collect();
        let spread = |taxel: usize| mean(column(taxel).map(|count| (count - counts[taxel]).powi(2))).sqrt();
        Held { noise: (0..taxels).map(spread).collect(), counts }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_load_is_taken_when_it_rests_and_is_another() {
        let mut rng = fastrand::Rng::with_seed(1);
        let mut steady = Steady::away_from(0.0, 5.0);
        let mut noisy = |level: f64| vec![level + rng.f64() - 0.5, 2.0 * level + rng.f64() - 0.5];
        for _ in 0..300 {
            assert_eq!(steady.take(noisy(0.0)), None, "nothing was put on");
        }
        for frame in 0..200 {
            assert_eq!(steady.take(noisy(f64::from(frame) * 0.2)), None, "it is still being put on");
        }
        let held = (0..FRAMES + 4).find_map(|_| steady.take(noisy(40.0))).expect("it rests");
        assert!((held.counts[0] - 40.0).abs() < 0.5 && (held.counts[1] - 80.0).abs() < 0.8, "{held:?}");
        assert!(held.noise.iter().all(|noise| (0.1..0.6).contains(noise)), "{held:?}");
    }
}
