//! Onset of slip, from the steps of a contact.

use crate::format::wide;

/// A step along x and y, in 2^-16 taxel.
pub(crate) type Way = [i32; 2];

/// Number of steps that make a slip.
pub(crate) const SLIP_STEPS: usize = 3;

/// The last steps of a contact, in 2^-12 taxel.
#[derive(Debug, Clone)]
pub(crate) struct Slip {
    /// The last two steps, the older first.
    steps: [Way; SLIP_STEPS - 1],
    /// Mean size of the change from one step to the next, in 2^-16 taxel: the noise of the contact, whatever
    /// its speed.
    jitter: i32,
}

/// Initial jitter: 1/8 taxel.
const JITTER: i32 = 1 << 13;
/// Number of frames that the jitter averages over, as a power of two.
const MEMORY: u32 = 4;
/// Bounds: a longer step counts as two taxels, a greater change as half a taxel.
const LONGEST: i32 = 2 << 12;
const GREATEST: i32 = 1 << 11;

impl Slip {
    pub const fn new() -> Self {
        Slip { steps: [[0; 2]; SLIP_STEPS - 1], jitter: JITTER }
    }

    /// Takes the step since the last frame. Returns true if a slip begins: the last three steps together are
    /// at least `limit` (in 2^-12 taxel) and three times the jitter, and each of them advances along their
    /// sum by at least half the mean.
    pub fn begins(&mut self, step: Way, limit: u32) -> bool {
        let step = step.map(|way| (way >> 4).clamp(-LONGEST, LONGEST));
        let [first, second] = self.steps;
        self.steps = [second, step];
        let change = (step[0] - second[0]).abs() + (step[1] - second[1]).abs();
        let clear = ((self.jitter * 3) >> 4).unsigned_abs();
        self.jitter += ((change.min(GREATEST) << 4) - self.jitter) >> MEMORY;
        let way = [first[0] + second[0] + step[0], first[1] + second[1] + step[1]];
        let along = |step: Way| step[0] * way[0] + step[1] * way[1];
        // Fits in 31 bits: three steps of two taxels along both axes.
        let square = along(way);
        let least = limit.max(clear).min(1 << 15);
        // sixth = square / 6, by 2^34 / 6 rounded up, exact for 32 bits: a division takes an M0+ ten times as
        // long.
        let sixth = (wide(square.unsigned_abs(), 0xaaaa_aaab) >> 34) as i32;
        square.unsigned_abs() >= least * least
            && [first, second, step].into_iter().all(|step| along(step) >= sixth)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Number of 100 steps, in 2^-16 taxel, at which a slip would begin.
    fn begins(steps: impl Fn(usize) -> Way) -> usize {
        let mut slip = Slip::new();
        (0..100).filter(|number| slip.begins(steps(*number), 1 << 10)).count()
    }

    #[test]
    fn what_goes_on_slips_and_what_trembles_does_not() {
        // A quarter of a taxel a frame in each direction: the step never changes, so there is no jitter.
        for way in [[1, 0], [0, 1], [-1, 0], [0, -1], [1, 1], [-1, 1]] {
            assert_eq!(begins(|_| way.map(|way| way << 14)), 98, "{way:?}");
            let trembling = |number| way.map(|way| if number % 2 == 0 { way << 14 } else { -(way << 14) });
            assert_eq!(begins(trembling), 0, "{way:?}");
        }
    }

    #[test]
    fn it_is_the_rule_whatever_the_steps() {
        let mut state = 1u32;
        let mut next = |below: u32| {
            state = state.wrapping_mul(1664525).wrapping_add(1013904223);
            (state >> 8) % below
        };
        let (mut begun, mut rounds) = (0, 0);
        for _ in 0..400 {
            let (mut slip, mut plain) = (Slip::new(), WideRule { steps: [[0; 2]; 2], jitter: 8192 });
            // From steps in one direction with noise of any size to noise alone.
            let (size, noise, limit) = (1 << next(19), 1 << next(19), 1 << next(16));
            let way = [0; 2].map(|_| next(2 * size) as i32 - size as i32);
            for _ in 0..60 {
                let step = way.map(|way| way + next(2 * noise) as i32 - noise as i32);
                let expected = plain.begins(step.map(i64::from), limit.into());
                assert_eq!(slip.begins(step, limit), expected, "{way:?} {step:?} {limit}");
                (begun, rounds) = (begun + u32::from(expected), rounds + 1);
            }
        }
        assert!(rounds / 10 < begun && begun < rounds / 2, "{begun} of {rounds}");
    }

    /// The rule in wide integers.
    struct WideRule {
        steps: [[i64; 2]; 2],
        jitter: i64,
    }

    impl WideRule {
        fn begins(&mut self, step: [i64; 2], limit: i64) -> bool {
            let step = step.map(|way| way.div_euclid(16).clamp(-8192, 8192));
            let [first, second] = self.steps;
            self.steps = [second, step];
            let change: i64 = step.iter().zip(second).map(|(now, before)| (now - before).abs()).sum();
            let least = limit.max((3 * self.jitter).div_euclid(16)).min(32768);
            self.jitter += (16 * change.min(2048) - self.jitter).div_euclid(16);
            let sum = [0, 1].map(|axis| first[axis] + second[axis] + step[axis]);
            let along = |step: [i64; 2]| step[0] * sum[0] + step[1] * sum[1];
            let square = along(sum);
            square >= least * least
                && [first, second, step].map(along).iter().all(|along| *along >= square / 6)
        }
    }
}
