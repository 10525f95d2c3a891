//! How fast the baseline may move, in seconds and counts, whatever the garment and the frame rate.

/// Every row is visited once in this time, us. On the reference garment that is two rows a frame at most.
pub(super) const TURN_US: u32 = 345_000;
/// A longer pause between two visits counts as so long for what a taxel follows by itself, ms.
pub(super) const PAUSE_MS: u32 = 1_000;
/// A longer pause counts as so long for what a panel is expected to have drifted meanwhile, ms.
pub(super) const GAP_MS: u32 = 10_000;

/// Counts per second as Q8.
const fn per_second(counts: u32, hundredths: u32) -> u32 {
    (counts * 100 + hundredths) * 256 / 100
}

/// A taxel follows its own code towards pressure at so many counts per second, unless a touch shows: as much as
/// neighbours differ at 3 counts per second in all.
pub(super) const OWN: u32 = per_second(2, 0);
/// The same in a patch: 5 counts per second, and what noise keeps it from.
pub(super) const PATCH: u32 = per_second(8, 0);
/// The same within a taxel of a contact, where the code shows no pressure; a sixteenth of what its panel drifts, if
/// that is more.
pub(super) const BESIDE: u32 = per_second(0, 30);
/// From this common drift on, taxels may differ by more than [`OWN`] allows: it grows as the drift does.
pub(super) const QUICK: u32 = per_second(4, 0);
/// Common drift beyond this is not followed surely.
pub(super) const BEYOND: u32 = per_second(30, 0);
/// What moves all of a panel faster is no drift: an input that broke, or a hand.
pub(super) const FASTEST: u32 = per_second(40, 0);
/// Drift that may go unseen while a touch hides nearly all of a panel.
pub(super) const HIDDEN: u32 = per_second(0, 12);
/// What a quarter of a panel that is off without a contact adds to the doubt.
pub(super) const CLUTTER: u32 = per_second(16, 0);

/// Turns after which what rises over a width of taxels, and was not felt, is a patch that drifts: 5.9 s.
pub(super) const PATCH_TURNS: u8 = 17;
/// Turns for which it counts as one after it was last seen to rise: 20 s.
pub(super) const PATCH_STAYS: u8 = 58;

/// Where nothing touches the baseline is unsure from so many counts of doubt on; under a touch from half of the touch
/// on, if that is more.
pub(super) const UNSURE: u32 = 64;

/// What a rate (Q8 counts per second, at most 1,024 counts) comes to in some time (at most [`GAP_MS`]), Q8 counts.
pub(super) const fn in_time(rate: u32, ms: u32) -> u32 {
    let rate = if rate > 1 << 18 { 1 << 18 } else { rate };
    let ms = if ms > GAP_MS { GAP_MS } else { ms };
    rate * ms / 1000
}

/// What a rate (Q8 counts per second) comes to in some time, whole counts, rounded towards 0.
pub(super) fn counts(rate: i32, ms: u32) -> i32 {
    (in_time(rate.unsigned_abs(), ms) >> 8) as i32 * rate.signum()
}
