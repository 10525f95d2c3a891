//! Finds touches in raw frames: learns the rest codes first; each departure from them is one touch.

use super::touch::{Touch, TouchFrame};

/// Frames from which the rest codes are learnt.
const REST: u32 = 16;
/// Signal of a touch, counts above rest and the noise limit.
const SIGNAL: f32 = 40.0;
/// Noise limit of an address, standard deviations.
const SIGMAS: f32 = 8.0;
/// Rate at which the rest codes follow each quiet frame.
const FOLLOW: f32 = 0.05;
/// Time without a touch that ends it, s.
const QUIET: f64 = 0.4;
/// Least number of frames of a touch; anything shorter is a spark.
const FRAMES: usize = 3;

/// Detects touches in frames.
#[derive(Debug, Clone, Default)]
pub struct Feeler {
    /// Pressure lowers the codes.
    falling: bool,
    frames: u32,
    rest: Vec<f32>,
    /// Sums of squares at first, then the limits.
    limit: Vec<f32>,
    touch: Touch,
}

impl Feeler {
    /// A detector for codes that fall or rise with pressure.
    pub fn new(falling: bool) -> Feeler {
        Feeler { falling, ..Feeler::default() }
    }

    /// True once the rest codes are known.
    pub fn is_ready(&self) -> bool {
        self.frames >= REST
    }

    /// True while something is touched.
    pub fn is_touched(&self) -> bool {
        !self.touch.moments.is_empty()
    }

    /// Takes the codes of a frame and its time (s). Returns a touch that has just ended.
    pub fn take(&mut self, time: f64, codes: &[u16]) -> Option<Touch> {
        if !self.is_ready() || codes.len() != self.rest.len() {
            self.learn(codes);
            return None;
        }
        let sign = if self.falling { -1.0 } else { 1.0 };
        let signal = |code: &u16, rest: &f32| sign * (f32::from(*code) - rest);
        let all = codes.iter().zip(&self.rest).zip(&self.limit).enumerate();
        let felt: Vec<_> = all
            .map(|(address, ((code, rest), limit))| (address, signal(code, rest), *limit))
            .filter(|(_, signal, limit)| signal > limit)
            .map(|(address, signal, _)| (address, signal))
            .collect();
        if !felt.is_empty() {
            self.touch.moments.push(TouchFrame { time, felt });
            return None;
        }
        for (rest, code) in self.rest.iter_mut().zip(codes) {
            *rest += FOLLOW * (f32::from(*code) - *rest);
        }
        let last = self.touch.moments.last()?.time;
        if time - last < QUIET {
            return None;
        }
        let touch = std::mem::take(&mut self.touch);
        (touch.moments.len() >= FRAMES).then_some(touch)
    }

    /// Mean and noise of an address, by Welford's recurrence.
    fn learn(&mut self, codes: &[u16]) {
        if codes.len() != self.rest.len() {
            *self = Feeler {
                rest: vec![0.0; codes.len()],
                limit: vec![0.0; codes.len()],
                ..Feeler::new(self.falling)
            };
        }
        self.frames += 1;
        for ((code, rest), squares) in codes.iter().zip(&mut self.rest).zip(&mut self.limit) {
            let off = f32::from(*code) - *rest;
            *rest += off / self.frames as f32;
            *squares += off * (f32::from(*code) - *rest);
        }
        if self.is_ready() {
            for squares in &mut self.limit {
                *squares = SIGNAL + SIGMAS * (*squares / (REST - 1) as f32).sqrt();
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_touch_begins_and_ends_and_a_spark_is_none() {
        let mut feeler = Feeler::new(true);
        let mut time = 0.0;
        let mut step = |feeler: &mut Feeler, codes: &[u16]| {
            time += 0.05;
            feeler.take(time, codes)
        };
        for k in 0..16u16 {
            assert_eq!(step(&mut feeler, &[3000 + k % 2, 3900, 3000 + 40 * (k % 2)]), None);
        }
        assert!(feeler.is_ready());
        // The noisy address is ignored; one frame is no touch.
        for pressed in [1, 6] {
            for _ in 0..pressed {
                assert_eq!(step(&mut feeler, &[3000, 3800, 2900]), None);
            }
            let ended: Vec<_> = (0..12).filter_map(|_| step(&mut feeler, &[3000, 3900, 3020])).collect();
            assert_eq!(ended.len(), usize::from(pressed > 1));
            for touch in ended {
                assert_eq!(touch.moments.len(), 6);
                assert!(touch.moments.iter().all(|m| m.felt.len() == 1 && m.felt[0].0 == 1));
                assert!((touch.duration() - 0.25).abs() < 1e-9 && touch.traces().len() == 1);
            }
        }
    }
}
