//! Values that the host feeds to concepts (what a camera sees, how warm the skin is), each with an age after
//! which it no longer counts.
//!
//! | | |
//! |---|---|
//! | input | [`Feed`]s, by name of the concept |
//! | output | a value for each slot of [`Source::Host`](super::input::Source::Host) |
//! | saturation | none: values outside -1 ..= 1 are refused |
//! | latency | none |
//! | RAM | [`Fed`]: 192 bytes |

use super::map::Map;
use crate::format::{Invalid, Micros, Name, Q15};
use serde::{Deserialize, Serialize};

/// Number of concepts that the host may feed.
pub const SLOTS: usize = 8;

/// A value for a concept, from the host.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Feed {
    /// The concept; its input must be a slot of the host.
    pub concept: Name,
    /// The value, -1 ..= 1.
    pub value: Q15,
    /// Age of the value on arrival, ms.
    pub age_ms: u32,
    /// Age from which the value no longer counts, ms; 0: it holds until the next one.
    pub timeout_ms: u32,
    /// Value that counts from then on, -1 ..= 1.
    pub default: Q15,
}

/// Content of a slot.
#[derive(Debug, Default, Clone, Copy)]
struct Held {
    value: Q15,
    /// Time until which `value` counts; none: until the next value.
    until: Option<Micros>,
    default: Q15,
}

/// Values that the host has fed.
#[derive(Debug, Default, Clone)]
pub struct Fed {
    slots: [Held; SLOTS],
}

impl Fed {
    /// Takes a value that arrived at `now` for a concept of `map`. Error if the host does not feed the
    /// concept or a value is outside -1 ..= 1; then nothing changes.
    pub fn accept<const N: usize, const E: usize>(
        &mut self,
        feed: &Feed,
        map: Option<&Map<N, E>>,
        now: Micros,
    ) -> Result<(), Invalid> {
        let must = "must be a concept of the map that the host feeds";
        let slot = map.and_then(|map| map.slot(&feed.concept));
        let slot = slot.and_then(|slot| self.slots.get_mut(usize::from(slot)));
        let held = slot.ok_or(Invalid { parameter: "feed.concept", must })?;
        let (value, default) = (fraction(feed.value, "feed.value")?, fraction(feed.default, "feed.default")?);
        let left = 1000 * u64::from(feed.timeout_ms.saturating_sub(feed.age_ms));
        let until = (feed.timeout_ms > 0).then_some(Micros(now.0.saturating_add(left)));
        *held = Held { value, until, default };
        Ok(())
    }

    /// Called when no host feeds any more: each slot falls back to its `default`, 0 if none was given.
    pub fn expire(&mut self) {
        self.slots.iter_mut().for_each(|held| *held = Held { value: held.default, until: None, ..*held });
    }

    /// Values that count at `now`, by slot; 0 if nothing was fed.
    pub fn values(&self, now: Micros) -> [Q15; SLOTS] {
        let mut values = [Q15(0); SLOTS];
        for (value, held) in values.iter_mut().zip(&self.slots) {
            *value = match held.until {
                Some(until) if now >= until => held.default,
                _ => held.value,
            };
        }
        values
    }
}

/// Returns the value. Error if it is outside -1 ..= 1.
fn fraction(value: Q15, parameter: &'static str) -> Result<Q15, Invalid> {
    if value < Q15(-Q15::ONE.0) || value > Q15::ONE {
        return Err(Invalid { parameter, must: "must be -1 to 1" });
    }
    Ok(value)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::format::name;
    use crate::intent::{MapConfig, MapInput, Source};

    /// A map whose concept `warmth` is fed by slot 3, `press` by the touch.
    fn map() -> Map {
        let mut config: MapConfig = MapConfig { lambda: 1000, ..MapConfig::default() };
        config.concepts.extend(["press", "warmth"].map(name));
        let input =
            |concept, source| MapInput { concept, source, low: -32768, high: 32768, at_low: -1, at_high: 1 };
        config.inputs.extend([input(0, Source::Press), input(1, Source::Host(3))]);
        Map::build(&config).unwrap()
    }

    fn feed(value: i32, age_ms: u32, timeout_ms: u32) -> Feed {
        Feed { concept: name("warmth"), value: Q15(value), age_ms, timeout_ms, default: Q15(-7) }
    }

    #[test]
    fn a_value_counts_until_it_is_too_old() {
        let (map, mut fed) = (map(), Fed::default());
        let at = |fed: &Fed, ms: u64| fed.values(Micros(1000 * ms))[3].0;
        assert_eq!(at(&fed, 0), 0, "nothing was fed");
        fed.accept(&feed(500, 0, 100), Some(&map), Micros(1_000_000)).unwrap();
        assert_eq!([1000, 1099, 1100, 9999].map(|ms| at(&fed, ms)), [500, 500, -7, -7]);
        // It was 80 ms old when it came.
        fed.accept(&feed(600, 80, 100), Some(&map), Micros(2_000_000)).unwrap();
        assert_eq!([2000, 2019, 2020].map(|ms| at(&fed, ms)), [600, 600, -7]);
        fed.accept(&feed(600, 100, 100), Some(&map), Micros(3_000_000)).unwrap();
        assert_eq!(at(&fed, 3000), -7, "too old on arrival");
        fed.accept(&feed(700, 5, 0), Some(&map), Micros(4_000_000)).unwrap();
        assert_eq!(at(&fed, 999_999), 700, "until the next");
        fed.accept(&feed(1, 0, u32::MAX), Some(&map), Micros(u64::MAX - 5)).unwrap();
        assert_eq!(fed.values(Micros(u64::MAX - 1))[3].0, 1);
        let state = map.encode(None, &fed.values(Micros(u64::MAX - 1)));
        assert_eq!((state[0], state[1]), (0, 1));
    }

    #[test]
    fn what_is_refused_changes_nothing() {
        let (map, mut fed) = (map(), Fed::default());
        let mut refused =
            |feed: Feed, map: Option<&Map>| fed.accept(&feed, map, Micros(0)).unwrap_err().parameter;
        assert_eq!(refused(Feed { concept: name("press"), ..feed(1, 0, 0) }, Some(&map)), "feed.concept");
        assert_eq!(refused(Feed { concept: name("joy"), ..feed(1, 0, 0) }, Some(&map)), "feed.concept");
        assert_eq!(refused(feed(1, 0, 0), None), "feed.concept");
        assert_eq!(refused(feed(32769, 0, 0), Some(&map)), "feed.value");
        assert_eq!(refused(feed(i32::MIN, 0, 0), Some(&map)), "feed.value");
        assert_eq!(refused(Feed { default: Q15(-32769), ..feed(1, 0, 0) }, Some(&map)), "feed.default");
        assert_eq!(fed.values(Micros(0)), [Q15(0); SLOTS]);
    }
}
