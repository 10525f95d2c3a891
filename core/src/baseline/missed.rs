//! What the witnesses of a panel miss: they are few, and their median drifts by up to a quarter more or less
//! than the panel, which would add up under a contact that is held.

/// What an untouched row showed as its baselines followed.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Followed {
    /// Taxels.
    pub count: u32,
    /// Distances of their codes from their baselines moved in common: sum, counts.
    pub distance: u32,
    /// Steps of their baselines beyond the common one: sum, counts.
    pub beyond: i32,
}

/// Mean drift of all untouched taxels of a panel beyond that of its witnesses.
///
/// If it is more than a fifth of the drift for minutes, many taxels do not drift at all, and the median of the
/// witnesses is right.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Missed {
    /// Steps of untouched taxels in this turn beyond the common ones: their sum, counts, and number.
    beyond: i32,
    count: u32,
    /// Mean of the last turn, whole counts, and what is left of it, Q8.
    pub step: i16,
    left: i16,
    /// Sums over the last turns, each with less weight: of the means in the way of the drift, and of the
    /// witnesses' drift, counts in Q8.
    lost: i32,
    way: i32,
}

/// Shift of the weight that a turn loses with each further one.
const LASTS: u32 = 7;

/// Largest mean of a turn, counts.
const MOST: i32 = 56;

impl Missed {
    pub const NONE: Missed = Missed { beyond: 0, count: 0, step: 0, left: 0, lost: 0, way: 0 };

    pub fn add(&mut self, row: Followed) {
        self.beyond = self.beyond.saturating_add(row.beyond);
        self.count = self.count.saturating_add(row.count);
    }

    /// Ends a turn in which the witnesses drifted by `common`. `direction`: of the drift of late, -1, 0 or 1.
    pub fn turn(&mut self, common: i32, direction: i32) {
        let count = self.count.clamp(1, 0xffff) as i32;
        let most = MOST * count;
        let mean = (self.beyond.min(most).max(-most) << 8).checked_div(count).unwrap_or(0);
        self.lost += mean * direction - (self.lost >> LASTS);
        self.way += (common.abs() << 8) - (self.way >> LASTS);
        let is_trusted = 5 * self.lost.abs() <= self.way;
        let all = i32::from(self.left) + if is_trusted { mean } else { 0 };
        (self.step, self.left) = ((all >> 8) as i16, (all & 0xff) as i16);
        (self.beyond, self.count) = (0, 0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Steps of 1,000 turns in which the witnesses drift by `common` and the rest by so many 256ths beyond.
    fn sum(common: i32, beyond: i32) -> i32 {
        let mut missed = Missed::NONE;
        let steps = (0..1_000).map(|_| {
            missed.add(Followed { count: 256, distance: 0, beyond });
            missed.turn(common, common.signum());
            i32::from(missed.step)
        });
        steps.sum()
    }

    #[test]
    fn parts_of_a_count_add_up() {
        assert_eq!([40, -40, 1].map(|beyond| sum(1, beyond)), [40_000 / 256, -40_000 / 256 - 1, 3]);
        assert_eq!([0, 400].map(|beyond| sum(10, beyond)), [0, 400_000 / 256]);
    }

    #[test]
    fn where_many_do_not_drift_the_witnesses_are_right() {
        // A third of the taxels stands still.
        assert!(sum(3, -256).abs() <= 3);
        assert_eq!(sum(-3, 256), sum(3, -256).abs());
    }

    #[test]
    fn turns_without_an_untouched_taxel_miss_nothing() {
        let mut missed = Missed::NONE;
        missed.turn(14, 1);
        assert_eq!(missed.step, 0);
        missed.add(Followed { count: 0xffff_ffff, distance: 0, beyond: i32::MAX });
        missed.add(Followed { count: 1, distance: 0, beyond: 1 });
        missed.turn(14, 1);
        assert!(i32::from(missed.step) <= MOST);
    }
}
