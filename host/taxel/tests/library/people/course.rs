//! Time courses of force: pulses of impact, minimum jerk, tremor. None is a half-cosine.

use fastrand::Rng;

/// Force over time, with a peak of about 1 per pulse.
#[derive(Debug, Clone)]
pub enum Course {
    /// The flesh gives and springs back: `(t / p)^n exp(n (1 - t / p))`, again and again.
    Pulses {
        /// Time to the peak, s.
        peak_s: f64,
        /// Steepness.
        n: f64,
        /// Begins and sizes of the pulses, s.
        each: Vec<(f64, f64)>,
    },
    /// A limb moves with minimum jerk, may press too far at first, trembles, and lets go.
    Grip {
        /// Time to full force, s.
        rise_s: f64,
        /// Overshoot at first.
        over: f64,
        /// Share of the force and frequency (Hz) of the tremor.
        tremor: (f64, f64),
        /// Time and duration of the release, s.
        release_s: (f64, f64),
    },
    /// Varying friction under a moving hand.
    Glide {
        /// Length, s.
        length_s: f64,
        /// Time constant of onset and release, s.
        edge_s: f64,
        /// Share of the force and frequency (Hz) of the variation.
        wave: (f64, f64),
    },
    /// A blow followed by weight: a sharp pulse, and a broader one on top.
    Blow {
        /// Time to the peak of the sharp one, s.
        sharp_s: f64,
        /// Time to the peak of the broad one, s.
        broad_s: f64,
        /// Share of the broad one.
        part: f64,
    },
}

fn pulse(t: f64, peak_s: f64, n: f64) -> f64 {
    if t <= 0.0 {
        return 0.0;
    }
    let x = t / peak_s;
    (n * (x.ln() + 1.0 - x)).exp()
}

fn jerk_free(x: f64) -> f64 {
    let x = x.clamp(0.0, 1.0);
    x * x * x * (10.0 - 15.0 * x + 6.0 * x * x)
}

impl Course {
    /// Pulses in an uneven rhythm.
    pub fn rhythm(count: u32, peak_s: f64, n: f64, gap_s: [f64; 2], rng: &mut Rng) -> Course {
        let mut begin = 0.0;
        let mut next = |rng: &mut Rng| {
            let now = begin;
            begin += Course::lasts(peak_s, n) + gap_s[0] + rng.f64() * (gap_s[1] - gap_s[0]);
            (now, 0.75 + 0.25 * rng.f64())
        };
        Course::Pulses { peak_s, n, each: (0..count).map(|_| next(rng)).collect() }
    }

    /// Time until a pulse has fallen to a hundredth, s.
    fn lasts(peak_s: f64, n: f64) -> f64 {
        (1..)
            .map(|tenth| peak_s * f64::from(tenth) / 10.0)
            .find(|t| *t > peak_s && pulse(*t, peak_s, n) < 0.01)
            .unwrap_or(1.0)
    }

    /// Its length, s.
    pub fn length_s(&self) -> f64 {
        match self {
            Course::Pulses { peak_s, n, each } => {
                each.last().map_or(0.0, |last| last.0) + Course::lasts(*peak_s, *n)
            }
            Course::Grip { release_s: (begin, lasts), .. } => begin + lasts,
            Course::Glide { length_s, .. } => *length_s,
            Course::Blow { sharp_s, broad_s, .. } => {
                Course::lasts(*sharp_s, 3.0).max(Course::lasts(*broad_s, 3.0))
            }
        }
    }

    /// Force `t` seconds after its begin.
    pub fn at(&self, t: f64) -> f64 {
        if !(0.0..=self.length_s()).contains(&t) {
            return 0.0;
        }
        let wave = |(part, hz): (f64, f64)| 1.0 + part * (std::f64::consts::TAU * hz * t).sin();
        match self {
            Course::Pulses { peak_s, n, each } => {
                each.iter().map(|(begin, size)| size * pulse(t - begin, *peak_s, *n)).fold(0.0, f64::max)
            }
            Course::Grip { rise_s, over, tremor, release_s: (begin, lasts) } => {
                let first = 1.0 + over * (-(t - rise_s).max(0.0) / 0.15).exp();
                jerk_free(t / rise_s) * first * wave(*tremor) * (1.0 - jerk_free((t - begin) / lasts))
            }
            Course::Glide { length_s, edge_s, wave: w } => {
                let edge = |since: f64| 1.0 - (-since / edge_s).exp();
                edge(t) * edge(length_s - t) * wave(*w)
            }
            Course::Blow { sharp_s, broad_s, part } => {
                (pulse(t, *sharp_s, 3.0) + part * pulse(t, *broad_s, 3.0)) / (1.0 + part)
            }
        }
    }
}
