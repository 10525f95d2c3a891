//! Inputs: how a touch, or a value from the host, becomes the activation of a concept.
//!
//! A ramp: `at_low` up to `low`, `at_high` from `high` on, and a straight line between. The result is rounded
//! to the nearest unit of the state, halves upwards, and is exact at both ends. Without a touch every source
//! that describes one gives 0, which is not the ramp's value for a measurement of 0.
//!
//! Some sources have ramps over the logarithm of their value ([`Source::is_logarithmic`]): each doubling counts
//! the same, so that a sum of such inputs is a bound on a product of powers.
//!
//! The inputs of one concept add up. A ramp from 0 to 1 and a later one from 0 to -1 are together a
//! trapezoid, and a triangle if the second begins where the first ends: fuzzy memberships need no other form.

use super::error::MapError;
use crate::format::{Name, log2, wide};
use core::num::NonZeroU32;
use serde::{Deserialize, Serialize};

/// Measures of a touch for the inference.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub struct Touch {
    /// Total pressure in counts: the peak over the touch so far, because a lash is judged by its peak. So it
    /// never falls while the touch lasts.
    pub press: u32,
    /// Equivalent width of the contact across its major axis, in 0.1 mm.
    pub breadth: u32,
    /// Friendliness of the region touched, in percent, -100 ..= 100.
    pub friendliness: i8,
    /// Time since the onset, in ms; it stops at the release.
    pub duration_ms: u32,
    /// Speed of the contact over the surface, in 0.1 mm/s.
    pub speed: u32,
    /// Steepest rise of the force since the onset, in counts/ms. The stage computes this field and those
    /// below, up to `embraced_ms`.
    pub rise: u32,
    /// Steepest recent rise, in counts/ms: a blow is forgotten while the object that hit is still there.
    pub blow: u32,
    /// Greatest recent total pressure of all contacts, in counts.
    pub load: u32,
    /// Largest area that all contacts touched at once, in mm2.
    pub cover_mm2: u32,
    /// Greatest recent pressure of a taxel, in counts.
    pub peak: u32,
    /// Time since the onset, in ms; unlike the duration, it continues after the release.
    pub age_ms: u32,
    /// Number of falls and rises of the force at the tempo of a hand.
    pub beats: u32,
    /// Time since force was last added, in ms.
    pub still_ms: u32,
    /// Greatest recent mean pressure of a contact, counts per cm2.
    pub pressure: u32,
    /// Time in which the force came at its steepest recent rise, us; the largest number if it did not rise.
    pub rising_us: u32,
    /// Number of times the force gave way soon after it came: pats, beats of a handshake, kneading.
    pub gives: u32,
    /// Way that the touch has stroked, 0.1 mm.
    pub stroked: u32,
    /// Time for which it has held from two sides, ms.
    pub embraced_ms: u32,
    /// True if it began while the robot itself moved; the caller sets it.
    pub own: bool,
    /// Displacement since the onset, 0.1 mm.
    pub way: [i32; 2],
    /// Total pressure now, in counts.
    pub force: u32,
    /// Number of taxels touched now.
    pub area: u16,
    /// Area of a taxel, in mm2; may be 0 if no input is [`Source::Hardness`].
    pub cell_mm2: u32,
    /// Apparent hardness of the object, in counts per cm2: see [`hardness`](crate::contact::hardness). The
    /// stage computes it, and only if an input needs it.
    pub hardness: Option<u32>,
}

/// Source of an input concept's value. Variants are only appended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Source {
    /// [`Touch::press`], counts.
    Press,
    /// [`Touch::breadth`], 0.1 mm: the concept *shape*, narrow to broad.
    Breadth,
    /// [`Touch::friendliness`], percent: the concept *location*.
    Friendliness,
    /// [`Touch::duration_ms`], ms: the concept *time*.
    Duration,
    /// [`Touch::speed`], 0.1 mm/s.
    Speed,
    /// A value that the host feeds into this slot, Q15 (1.0 = 32768); 0 until it does.
    Host(u8),
    /// [`Touch::rise`], counts/ms: with the duration the concept *time*, sudden to slow.
    Rise,
    /// [`Touch::hardness`], counts per cm2, soft to hard; gives 0 while it is unknown.
    Hardness,
    /// [`Touch::blow`], counts/ms: a blow that has just happened.
    Blow,
    /// [`Touch::load`], counts: all contacts together.
    Load,
    /// [`Touch::cover_mm2`], mm2: an embrace covers more than a hand.
    Cover,
    /// [`Touch::peak`], counts: a sharp object loads a single taxel.
    Peak,
    /// [`Touch::age_ms`], ms.
    Age,
    /// [`Touch::beats`]: the rhythm of a shaken hand, of pats, of a massage.
    Beats,
    /// [`Touch::still_ms`], ms: an object that lies on the garment.
    Still,
    /// [`Touch::own`]: 1 if it began while the robot itself moved, else 0.
    Own,
    /// [`Touch::load`], counts, by its logarithm.
    Force,
    /// [`Touch::pressure`], counts per cm2, by its logarithm.
    Pressure,
    /// [`Touch::blow`], counts/ms, by its logarithm.
    Loading,
    /// [`Touch::rising_us`], us, by its logarithm.
    Rising,
    /// [`Touch::cover_mm2`], mm2, by its logarithm.
    Extent,
    /// [`Touch::gives`].
    Gives,
    /// [`Touch::stroked`], 0.1 mm.
    Stroked,
    /// [`Touch::embraced_ms`], ms.
    Embraced,
}

impl Source {
    /// True if its ramps are straight lines over the logarithm of its value.
    pub const fn is_logarithmic(self) -> bool {
        use Source::{Extent, Force, Loading, Pressure, Rising};
        matches!(self, Force | Pressure | Loading | Rising | Extent)
    }
}

/// One input of a map. The ramp may fall (`at_high` below `at_low`).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MapInput {
    /// Index of the concept; it must not have an incoming edge.
    pub concept: u8,
    /// Source of the value.
    pub source: Source,
    /// Start of the ramp, in the unit of the source. Ramps over a logarithm keep their ends to 3 in 1,000.
    pub low: i32,
    /// End of the ramp, above `low`.
    pub high: i32,
    /// Activation up to `low`, in decimal steps of the map, -1 ..= 1.
    pub at_low: i16,
    /// Activation from `high` on, in decimal steps of the map, -1 ..= 1.
    pub at_high: i16,
}

/// A [`MapInput`] with its ramp in units of the state.
#[derive(Debug, Clone)]
pub(crate) struct RampEncoder {
    pub concept: u8,
    pub source: Source,
    low: i32,
    high: i32,
    at_low: i32,
    at_high: i32,
}

impl RampEncoder {
    pub(crate) fn build(
        input: &MapInput,
        concept: &Name,
        decimals: u8,
        one: i32,
    ) -> Result<RampEncoder, MapError> {
        if input.low >= input.high {
            let (low, high) = (input.low, input.high);
            return Err(MapError::InputRange { concept: concept.clone(), low, high });
        }
        let step = 10i64.pow(decimals.into());
        let value = |steps: i16| -> Result<i32, MapError> {
            if i64::from(steps).abs() > step {
                return Err(MapError::InputValue { concept: concept.clone(), value: steps, decimals });
            }
            // Half away from zero, so that +-0.3 both become +-9830.
            let twice = 2 * i64::from(steps) * i64::from(one) + i64::from(steps.signum()) * step;
            Ok(twice.checked_div(2 * step).unwrap_or(0) as i32)
        };
        let (at_low, at_high) = (value(input.at_low)?, value(input.at_high)?);
        let scaled = |limit| Self::scaled(input.source, limit);
        Ok(RampEncoder {
            concept: input.concept,
            source: input.source,
            low: scaled(input.low),
            high: scaled(input.high),
            at_low,
            at_high,
        })
    }

    /// A value in the unit in which the ramps of this source are straight.
    fn scaled(source: Source, value: i32) -> i32 {
        if source.is_logarithmic() { log2(value.max(0).unsigned_abs().into()).into() } else { value }
    }

    /// Value of the ramp at `value`. Never panics.
    pub(super) fn ramp(&self, value: i32) -> i32 {
        let value = Self::scaled(self.source, value);
        // Most values are at an end of their ramp and need no division.
        if value <= self.low {
            return self.at_low;
        }
        if value >= self.high {
            return self.at_high;
        }
        // Always from the smaller end upwards, in unsigned numbers: halves round upwards on both slopes.
        let (base, run) = if self.at_high >= self.at_low {
            (self.at_low, value.abs_diff(self.low))
        } else {
            (self.at_high, self.high.abs_diff(value))
        };
        // `build` has checked that the span is not 0.
        let span = NonZeroU32::new(self.high.abs_diff(self.low)).unwrap_or(NonZeroU32::MIN);
        // run <= span < 2^32 and rise <= 2^16: the product fits in 49 bits.
        let product = wide(run, self.at_high.abs_diff(self.at_low)) + u64::from(span.get() / 2);
        let rise = match u32::try_from(product) {
            Ok(product) => product / span, // the usual case, and four times cheaper on a Cortex-M0+
            Err(_) => (product / core::num::NonZeroU64::from(span)) as u32,
        };
        base.saturating_add_unsigned(rise)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::format::name;

    fn encoder(low: i32, high: i32, at_low: i16, at_high: i16, one: i32) -> RampEncoder {
        let input = MapInput { concept: 0, source: Source::Press, low, high, at_low, at_high };
        RampEncoder::build(&input, &name("press"), 1, one).unwrap()
    }

    #[test]
    fn ramps_are_exact_at_their_ends_and_rounded_to_nearest_between() {
        for (low, high, a, b) in
            [(0, 12_000, 0, 10), (200, 600, -10, 10), (-100, 100, 10, -10), (i32::MIN, i32::MAX, -10, 10)]
        {
            let e = encoder(low, high, a, b, 32768);
            let exact = |v: i32| {
                let at = (f64::from(v) - f64::from(low)) / (f64::from(high) - f64::from(low));
                32768.0 * (f64::from(a) + at * f64::from(b - a)) / 10.0
            };
            assert_eq!((e.ramp(low), e.ramp(high)), (i32::from(a) * 32768 / 10, i32::from(b) * 32768 / 10));
            assert_eq!((e.ramp(i32::MIN), e.ramp(i32::MAX)), (e.ramp(low), e.ramp(high)));
            let span = high.abs_diff(low);
            for k in 0..1000u32 {
                let v = low.wrapping_add_unsigned((u64::from(span) * u64::from(k) / 1000) as u32);
                assert!((f64::from(e.ramp(v)) - exact(v)).abs() <= 0.5001, "{low} {high} at {v}");
            }
        }
    }

    #[test]
    fn halves_round_upwards_on_both_slopes() {
        let (rising, falling) = (encoder(0, 2, 0, 1, 10), encoder(0, 2, 1, 0, 10));
        assert_eq!((rising.ramp(1), falling.ramp(1)), (1, 1));
        assert_eq!(encoder(0, 2, -1, 0, 10).ramp(1), 0);
    }

    #[test]
    fn decimal_ends_round_alike_on_both_sides_of_zero() {
        let e = encoder(0, 1, -3, 3, 32768);
        assert_eq!((e.ramp(0), e.ramp(1)), (-9830, 9830));
    }
}
