//! How much more than its panel each taxel drifts.
//!
//! What warms a garment moves all of its taxels, each by a part of its own: the factor, Q7 (128 is 1), learnt while
//! nothing touches. Under a touch the baseline moves by the factor times the drift of the panel.

/// A factor of 1.
pub(super) const ONE: u8 = 128;
const BITS: u32 = 7;
/// Most that one visit teaches, counts.
const LESSON: i32 = 4;
/// A panel that drifts more slowly teaches nothing, Q8 counts per second.
const STEADY: i32 = 16;

/// Drift of a panel from one visit to the next, counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Shift {
    pub from: i32,
    pub to: i32,
}

impl Shift {
    /// None.
    pub const NONE: Shift = Shift { from: 0, to: 0 };

    /// By how many counts it has moved.
    pub const fn counts(self) -> i32 {
        self.to - self.from
    }

    /// What a taxel of that factor moves: over any number of visits within a count of the factor times the drift.
    pub const fn of(self, factor: u8) -> i32 {
        let factor = factor as i32;
        ((factor * self.to) >> BITS) - ((factor * self.from) >> BITS)
    }
}

/// How quickly the taxels of a panel learn: the more drift they have seen, the less the next count says.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Teacher {
    /// Drift that was seen since the garment was put on, counts.
    seen: u8,
    /// The way that the panel moves, times the gain.
    gain: i8,
    /// What all factors move by, lest they all grow or shrink.
    level: i8,
}

impl Teacher {
    /// Nothing was seen, and nothing is to be learnt.
    pub const NONE: Teacher = Teacher { seen: 0, gain: 0, level: 0 };

    /// The same, while nothing drifts.
    pub const fn at_rest(self) -> Teacher {
        Teacher { gain: 0, level: 0, ..self }
    }

    /// A panel drifts at a steady `rate` (Q8 counts per second), and has moved by so many counts; so many of its
    /// witnesses have a factor above 1, below 1, and any.
    ///
    /// A taxel teaches in every turn in which the panel drifts at all, not only where the panel moves by a whole count:
    /// else what a taxel follows before its panel does would not count, and what it takes back afterwards would.
    pub fn renew(&mut self, rate: i32, moved: u32, [above, below, all]: [u8; 3]) {
        let gain = match self.seen {
            ..32 => 4,
            32..160 => 2,
            _ => 1,
        };
        self.gain = if rate.abs() < STEADY { 0 } else { gain * rate.signum() as i8 };
        self.level = 0;
        if moved != 0 {
            // The middle one is 1.
            let (above, below, some) = (u32::from(above), u32::from(below), u32::from(all / 16));
            self.level = i8::from(below > above + some) - i8::from(above > below + some);
        }
        self.seen = self.seen.saturating_add(moved.min(255) as u8);
    }

    /// Whether little drift was seen.
    pub const fn is_fresh(&self) -> bool {
        self.seen < 64
    }

    /// Whether factors change.
    pub const fn is_teaching(&self) -> bool {
        self.gain != 0 || self.levels()
    }

    /// Whether the factors of taxels change that have moved as they say.
    pub const fn levels(&self) -> bool {
        self.level != 0
    }

    /// The factor of a taxel that has moved by so many counts beyond what it says.
    pub fn taught(&self, factor: u8, beyond: i32) -> u8 {
        let lesson = beyond.clamp(-LESSON, LESSON) * i32::from(self.gain) + i32::from(self.level);
        (i32::from(factor) + lesson).clamp(0, 255) as u8
    }

    /// How far a factor may be wrong (three standard deviations), Q8: its steps, and what noise taught.
    pub fn error(&self) -> u32 {
        6 + 1_024u32.checked_div(u32::from(self.seen) + 8).unwrap_or(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shifts_add_up_to_the_factor_times_the_drift() {
        for factor in [0, 1, 64, ONE, 200, 255] {
            let (mut sum, mut at) = (0, 0);
            for step in [1, 1, 3, -2, 40, -60, 7, 700, 1, -690] {
                sum += Shift { from: at, to: at + step }.of(factor);
                at += step;
                let exact = f64::from(factor) / 128.0 * f64::from(at);
                assert!((f64::from(sum) - exact).abs() <= 1.0, "{factor}: {sum}, not {exact}");
            }
        }
    }

    #[test]
    fn a_factor_is_learnt_from_what_the_taxel_follows_itself() {
        for truth in [0.5, 0.8, 1.3, 1.5] {
            let (mut teacher, mut factor) = (Teacher::NONE, ONE);
            let (mut drift, mut rest) = (0, 0.0);
            for visit in 0..150 {
                let shift = Shift { from: drift, to: drift + 1 + visit % 3 };
                drift = shift.to;
                teacher.renew(256, shift.counts() as u32, [0; 3]);
                let beyond = f64::round(truth * f64::from(drift) - rest) as i32 - shift.of(factor);
                rest += f64::from(shift.of(factor) + beyond);
                factor = Teacher { level: 0, ..teacher }.taught(factor, beyond);
            }
            let have = f64::from(factor) / 128.0;
            assert!((have - truth).abs() < 0.05, "{have}, not {truth}");
            assert!(teacher.error() <= 9);
        }
    }
}
