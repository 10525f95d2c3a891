//! Initial state of an inference: measures encoded as activations of the input concepts.

use super::input::{Source, Touch};
use super::map::Map;
use crate::format::Q15;

impl<const N: usize, const E: usize> Map<N, E> {
    /// Returns the initial state of an inference: each input concept encoded, every other concept 0. Inputs
    /// of one concept add up, and the sum is clamped to -1 ..= 1 after each of them. `host` holds the values
    /// that the host feeds, by slot. Does not panic: every measure is clamped to its ramp, and a missing slot
    /// reads 0.
    pub fn encode(&self, touch: Option<&Touch>, host: &[Q15]) -> [i32; N] {
        let mut state = [0; N];
        self.encode_into(touch, host, &mut state);
        state
    }

    /// Encodes like [`Map::encode`], into a state whose concepts are 0.
    pub(super) fn encode_into(&self, touch: Option<&Touch>, host: &[Q15], state: &mut [i32]) {
        for input in &self.inputs {
            let measured =
                |pick: fn(&Touch) -> u32| touch.map(|t| i32::try_from(pick(t)).unwrap_or(i32::MAX));
            let value = match input.source {
                Source::Press => measured(|t| t.press),
                Source::Breadth => measured(|t| t.breadth),
                Source::Friendliness => touch.map(|t| t.friendliness.into()),
                Source::Duration => measured(|t| t.duration_ms),
                Source::Speed => measured(|t| t.speed),
                Source::Rise => measured(|t| t.rise),
                Source::Hardness => {
                    touch.and_then(|t| t.hardness).map(|it| i32::try_from(it).unwrap_or(i32::MAX))
                }
                Source::Blow => measured(|t| t.blow),
                Source::Load => measured(|t| t.load),
                Source::Cover => measured(|t| t.cover_mm2),
                Source::Peak => measured(|t| t.peak),
                Source::Age => measured(|t| t.age_ms),
                Source::Beats => measured(|t| t.beats),
                Source::Still => measured(|t| t.still_ms),
                Source::Own => measured(|t| t.own.into()),
                Source::Force => measured(|t| t.load),
                Source::Pressure => measured(|t| t.pressure),
                Source::Loading => measured(|t| t.blow),
                Source::Rising => measured(|t| t.rising_us),
                Source::Extent => measured(|t| t.cover_mm2),
                Source::Gives => measured(|t| t.gives),
                Source::Stroked => measured(|t| t.stroked),
                Source::Embraced => measured(|t| t.embraced_ms),
                Source::Host(slot) => Some(host.get(usize::from(slot)).map_or(0, |v| v.0)),
            };
            if let (Some(out), Some(value)) = (state.get_mut(usize::from(input.concept)), value) {
                *out = (*out + input.ramp(value)).max(-self.one).min(self.one);
            }
        }
    }
}
