//! How fast the baseline may move, in counts and seconds, whatever the garment and the frame rate.

/// Every row is visited once in this time, us, and once in half of it while a panel drifts fast: on the
/// reference garment one row a frame, or two.
pub(super) const TURN_US: u32 = 700_000;

/// Most that a panel follows in a turn, counts: 40 counts per second, 80 while it drifts fast.
pub(super) const COMMON: i32 = 28;

/// Most that a taxel follows by itself in a turn while it shows no pressure, counts: 1.4 counts per second.
pub(super) const OWN: i32 = 1;

/// Most that an untouched taxel follows beside its panel, which drifts so much in a turn: taxels drift at 0.5
/// to 1.5 times the rate of their garment, and the witnesses of a panel at 0.75 of it, by bad luck.
pub(super) const fn beside(common: i32) -> i32 {
    common.abs() + common.abs() / 4
}
