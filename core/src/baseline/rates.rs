//! Rates at which the baseline may move, in counts and seconds, for any garment and frame rate.

/// Time in which every row is visited once, us; half of it while a panel drifts fast. On the reference
/// garment one row per frame, or two.
pub(crate) const TURN_US: u32 = 700_000;

/// Largest step of a panel in a turn, counts: 40 counts per second, 80 while it drifts fast.
pub(crate) const COMMON: i32 = 28;

/// Largest own step of a taxel in a turn while it shows no pressure and its panel does not drift, counts: 1.4
/// counts per second.
pub(crate) const OWN: i32 = 1;

/// Largest step of an untouched taxel in addition to its panel's step in a turn, `common`. Taxels drift at
/// 0.5 to 1.5 times the rate of their garment, and a panel's witnesses, by bad luck, at 0.75 of it.
pub(crate) const fn beside(common: i32) -> i32 {
    common.abs() + common.abs() / 4
}

/// Largest step of a taxel beside a contact in addition to its panel's step in a turn, `common`, while it shows
/// no pressure: what a taxel drifts more or less than its garment.
pub(crate) const fn under(common: i32) -> i32 {
    let half = (common.abs() + 1) / 2;
    if half > OWN { half } else { OWN }
}
