//! A small random generator, the same on every machine: the worst cases in docs/evidence/bounds.md are of its
//! numbers.
#![allow(dead_code)] // each test that uses this takes a part of it

pub struct Noise(pub u64);

impl Noise {
    fn step(&mut self) -> u64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        self.0
    }

    /// A whole number in `0 .. limit`.
    pub fn below(&mut self, limit: u64) -> u64 {
        let state = self.step();
        let mixed = (state ^ (state >> 33)).wrapping_mul(0xff51_afd7_ed55_8ccd) >> 16;
        mixed % limit
    }

    /// Uniform in `low .. high`.
    pub fn range(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.step() >> 33) as f64 / f64::from(1u32 << 31)
    }

    /// Uniform in 0 .. 1.
    pub fn unit(&mut self) -> f64 {
        (self.step() >> 40) as f64 / f64::from(1 << 24)
    }

    /// Normal with mean 0 and variance 1 (the polar method).
    pub fn normal(&mut self) -> f64 {
        loop {
            let (u, v) = (2.0 * self.unit() - 1.0, 2.0 * self.unit() - 1.0);
            let r = u * u + v * v;
            if r > 0.0 && r < 1.0 {
                return u * (-2.0 * r.ln() / r).sqrt();
            }
        }
    }
}
