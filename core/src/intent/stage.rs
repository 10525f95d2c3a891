//! The stage: selects the touch that counts, decides when to infer, and announces an intention once it has
//! led for long enough.
//!
//! | | |
//! |---|---|
//! | input | [`Touch`]es of this frame, values of the host, time |
//! | output | [`Meaning`], if there is a new one |
//! | saturation | that of [`Map::encode`] and [`Map::infer`] |
//! | latency | `onset_ms` from the first inference in favour of an intention |
//! | RAM | [`IntentState`] of 64 concepts: 1,400 bytes |
//! | M0+ cycles | about 300 without a change of inputs; else one inference |

use super::config::{CONCEPTS, IntentConfig};
use super::error::MapError;
use super::evidence::Evidence;
use super::felt::Felt;
use super::infer::{Inference, Outcome};
use super::input::{Source, Touch};
use super::leading::Leading;
use super::map::Map;
use super::why::Why;
use crate::contact::HardnessCue;
use crate::format::{Micros, Q15};
use heapless::Vec;

/// A result: new after every inference, and when the announced intention changes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Meaning<const N: usize = CONCEPTS> {
    /// The announced intention.
    pub leading: Leading,
    /// True if `leading` is new with this result.
    pub changed: bool,
    /// Activation of every concept of the map, in its order.
    pub activations: Vec<Q15, N>,
    /// Steps of the inference.
    pub steps: u16,
    /// End of the inference.
    pub outcome: Outcome,
}

impl<const N: usize> Meaning<N> {
    /// No intention, before the first inference.
    pub const NONE: Self = Meaning {
        leading: Leading::None,
        changed: false,
        activations: Vec::new(),
        steps: 0,
        outcome: Outcome::Fixed,
    };
}

/// State of the stage between frames.
#[derive(Debug, Clone)]
pub struct IntentState<const N: usize = CONCEPTS> {
    touch: Option<Touch>,
    /// Growth of the touch, from which its hardness follows.
    cue: HardnessCue,
    evidence: Evidence,
    released: Option<Micros>,
    inputs: [i32; N],
    inference: Inference<N>,
    inferred: Option<Micros>,
    candidate: Leading,
    since: Micros,
    leading: Leading,
    /// The last result.
    meaning: Meaning<N>,
}

impl<const N: usize> Default for IntentState<N> {
    fn default() -> Self {
        IntentState {
            touch: None,
            cue: HardnessCue::default(),
            evidence: Evidence::default(),
            released: None,
            inputs: [0; N],
            inference: Inference { state: [0; N], steps: 0, outcome: Outcome::Fixed },
            inferred: None,
            candidate: Leading::None,
            since: Micros(0),
            leading: Leading::None,
            meaning: Meaning::NONE,
        }
    }
}

impl<const N: usize> IntentState<N> {
    /// The announced intention.
    pub fn leading(&self) -> Leading {
        self.leading
    }

    /// The last result.
    pub(crate) fn meaning(&self) -> &Meaning<N> {
        &self.meaning
    }
}

/// The checked stage.
#[derive(Debug, Clone)]
pub struct Intent<const N: usize = CONCEPTS> {
    map: Map<N>,
    /// Indices of kindness, threat and attack.
    intentions: [Option<usize>; 3],
    /// Level and margin in units of the state.
    level: i32,
    margin: i32,
    onset_us: u64,
    hold_us: u64,
    period_us: u64,
    steps: u16,
    /// True if an input is [`Source::Hardness`], and if one is [`Source::Embraced`].
    feels: bool,
    embraces: bool,
}

impl<const N: usize> Intent<N> {
    /// A stage without a map, to be filled.
    pub const fn new() -> Self {
        Intent {
            map: Map::new(),
            intentions: [None; 3],
            level: 0,
            margin: 0,
            onset_us: 0,
            hold_us: 0,
            period_us: 0,
            steps: 0,
            feels: false,
            embraces: false,
        }
    }

    /// Checks `config` and builds its stage. Error if the map or a setting is invalid.
    pub fn build<const C: usize, const E: usize>(config: &IntentConfig<C, E>) -> Result<Self, MapError> {
        let mut stage = Intent::new();
        stage.fill(config)?;
        Ok(stage)
    }

    /// Replaces this stage by that of `config`, like [`Intent::build`]; after an error it must not be used.
    pub fn fill<const C: usize, const E: usize>(
        &mut self,
        config: &IntentConfig<C, E>,
    ) -> Result<(), MapError> {
        self.map.fill(&config.map)?;
        self.intentions = Leading::INTENTIONS.map(|leading| self.map.find(leading.as_str()));
        if self.intentions.iter().all(Option::is_none) {
            return Err(MapError::NoIntention);
        }
        if config.steps == 0 {
            return Err(MapError::NoSteps);
        }
        let fraction = |parameter, thousandths: u16| match thousandths {
            0..=1000 => Ok((i32::from(thousandths) * self.map.one() + 500) / 1000),
            _ => Err(MapError::Fraction { parameter, thousandths }),
        };
        (self.level, self.margin) = (fraction("level", config.level)?, fraction("margin", config.margin)?);
        self.onset_us = 1000 * u64::from(config.onset_ms);
        self.hold_us = 1000 * u64::from(config.hold_ms);
        self.period_us = 1000 * u64::from(config.period_ms);
        self.steps = config.steps;
        let takes = |source| config.map.inputs.iter().any(|input| input.source == source);
        (self.feels, self.embraces) = (takes(Source::Hardness), takes(Source::Embraced));
        Ok(())
    }

    /// True if an input is [`Source::Hardness`]; otherwise [`Touch::cell_mm2`] is not read.
    pub const fn feels(&self) -> bool {
        self.feels
    }

    /// True if an input is [`Source::Embraced`]; otherwise [`Felt::parts`] is not read.
    pub const fn embraces(&self) -> bool {
        self.embraces
    }

    /// The map.
    pub fn map(&self) -> &Map<N> {
        &self.map
    }

    /// Takes the touches of one frame. The one with the greatest press counts; a released one counts on for
    /// `hold_ms`, even beside weaker ones that still last. `felt` sums up all contacts of the frame; `host`
    /// holds the values that the host feeds, by slot.
    ///
    /// The inference starts from the inputs alone, not from its last result: a touch has one meaning,
    /// whatever was before. It runs only when the inputs have changed. Never panics.
    pub fn process<'s>(
        &self,
        state: &'s mut IntentState<N>,
        touches: &[Touch],
        felt: &Felt,
        host: &[Q15],
        now: Micros,
    ) -> Option<&'s Meaning<N>> {
        let counts = state.touch.is_some() || !touches.is_empty();
        state.evidence.take(felt, counts, now, self.hold_us);
        let edge = self.select(state, touches, now);
        if state.touch.is_some() {
            let strongest = touches.iter().reduce(|best, t| if t.press > best.press { t } else { best });
            state.evidence.warmth.take(strongest, felt, now);
            if matches!(state.leading, Leading::Threat | Leading::Attack) {
                state.evidence.warmth.forget();
            }
        }
        self.weigh(state, now);
        let inferred = self.refresh(state, host, edge, now);
        let changed = self.debounce(state, now);
        if !inferred && !changed {
            return None;
        }
        let meaning = &mut state.meaning;
        (meaning.leading, meaning.changed) = (state.leading, changed);
        meaning.activations.clear();
        for value in state.inference.state.iter().take(self.map.len()) {
            // Always room: both have N places. (`collect` would check that with a panic.)
            let _ = meaning.activations.push(self.map.q15(*value));
        }
        (meaning.steps, meaning.outcome) = (state.inference.steps, state.inference.outcome);
        Some(meaning)
    }

    /// Contribution of each cause to the announced intention; none if there is none.
    pub fn why(&self, state: &IntentState<N>) -> Option<Why<N>> {
        let at = Leading::INTENTIONS.iter().position(|leading| *leading == state.leading)?;
        self.map.why(&state.inference.state, (*self.intentions.get(at)?)?)
    }

    /// Selects the touch that counts; true if a touch begins or ceases to count.
    ///
    /// Touches have no id here. The press of a touch is a peak and never falls, so the touch that counted has
    /// been released exactly when all present ones are weaker.
    fn select(&self, state: &mut IntentState<N>, touches: &[Touch], now: Micros) -> bool {
        let before = state.touch.is_some();
        let strongest = touches.iter().reduce(|best, t| if t.press > best.press { t } else { best }).copied();
        match (state.touch, strongest) {
            (held, Some(present)) if held.is_none_or(|held| present.press >= held.press) => {
                let same = |held: &Touch| state.released.is_none() && held.duration_ms <= present.duration_ms;
                let before = held.filter(same);
                // A new touch takes the recent rise as its own; later it takes the rises of its own frames.
                let rise = before.map_or(state.evidence.blow(), |held| held.rise.max(state.evidence.rise));
                let own = before.map_or(present.own, |held| held.own);
                let hardness = self.feel(&mut state.cue, before.is_some(), &present);
                (state.touch, state.released) = (Some(Touch { rise, own, hardness, ..present }), None);
            }
            (Some(_), present) => {
                let released = *state.released.get_or_insert(now);
                if now.since(released) >= self.hold_us {
                    (state.touch, state.released) = (present, None);
                }
            }
            (None, _) => {}
        }
        state.touch.is_some() != before
    }

    /// Fills in the measures of the frames for the touch that counts.
    fn weigh(&self, state: &mut IntentState<N>, now: Micros) {
        let evidence = &state.evidence;
        if let Some(touch) = &mut state.touch {
            let since = state.released.map_or(0, |released| now.millis_since(released));
            touch.age_ms = touch.duration_ms.saturating_add(since);
            (touch.blow, touch.load, touch.peak) = (evidence.blow(), evidence.load(), evidence.peak());
            touch.cover_mm2 = evidence.cover_mm2();
            (touch.beats, touch.still_ms) = (evidence.beats(), evidence.still_ms());
            (touch.pressure, touch.rising_us) = (evidence.pressure(), evidence.rising_us());
            let warmth = &evidence.warmth;
            (touch.gives, touch.stroked, touch.embraced_ms) =
                (warmth.gives, warmth.stroked, warmth.embraced_ms());
        }
    }

    /// Returns the hardness of the touch so far; `known` is false in its first frame.
    fn feel(&self, cue: &mut HardnessCue, known: bool, touch: &Touch) -> Option<u32> {
        if !self.feels {
            return None;
        }
        if !known {
            *cue = HardnessCue::default();
        }
        cue.feel(touch.force, touch.area);
        cue.hardness(touch.cell_mm2)
    }

    /// Infers if the inputs have changed and the period is over; true if it did.
    fn refresh(&self, state: &mut IntentState<N>, host: &[Q15], edge: bool, now: Micros) -> bool {
        let mut inputs: Vec<i32, N> = Vec::new();
        let _ = inputs.resize(self.map.len(), 0);
        self.map.encode_into(state.touch.as_ref(), host, &mut inputs);
        let due = state.inferred.is_none_or(|last| edge || now.since(last) >= self.period_us);
        if !due || (state.inferred.is_some() && inputs.iter().eq(state.inputs.iter().take(inputs.len()))) {
            return false;
        }
        self.map.infer_into(&inputs, self.steps, &mut state.inference);
        state.inputs.iter_mut().zip(&inputs).for_each(|(to, from)| *to = *from);
        state.inferred = Some(now);
        true
    }

    /// Announces the intention that has led for `onset_ms`; true if it is new. Kindness waits until the touch
    /// has settled: a push and a poke begin as lightly as a hand that is laid on. An attack waits while the
    /// touch still comes: what presses heavily begins as steeply as a blow, and rises for longer.
    fn debounce(&self, state: &mut IntentState<N>, now: Micros) -> bool {
        let candidate = self.candidate(state);
        let evidence = &state.evidence;
        let unsettled = evidence.comes || !evidence.has_settled(now);
        let early = candidate == Leading::Kindness && state.leading != candidate && unsettled;
        if candidate != state.candidate || early {
            (state.candidate, state.since) = (candidate, now);
        }
        // What has hit and is still there hit, and does not threaten only because the blow is over.
        let after_blow = state.leading == Leading::Attack && candidate == Leading::Threat;
        let onset_us = if after_blow { self.hold_us } else { self.onset_us };
        let lasted = now.since(state.since) >= onset_us;
        let comes = candidate == Leading::Attack && evidence.comes;
        let changed = lasted && !comes && candidate != state.leading;
        if changed {
            state.leading = candidate;
        }
        changed
    }

    /// Returns the intention that reaches the level and leads by the margin. An attack need not lead a threat,
    /// which it also is, and a threat leads where no attack does. For the announced one, level and margin are
    /// lower by one margin (hysteresis), so that a value at the limit does not flicker.
    fn candidate(&self, state: &IntentState<N>) -> Leading {
        let value = |at: &Option<usize>| at.and_then(|at| state.inference.state.get(at).copied());
        // The gravest first.
        for (at, leading) in self.intentions.iter().rev().zip(Leading::INTENTIONS.into_iter().rev()) {
            let Some(own) = value(at) else { continue };
            let others = self
                .intentions
                .iter()
                .zip(Leading::INTENTIONS)
                .filter(|(_, other)| (*other == Leading::Kindness) != (leading == Leading::Kindness))
                .map(|(other, _)| other)
                .filter_map(value)
                .max()
                .unwrap_or(i32::MIN);
            let bonus = if leading == state.leading { self.margin } else { 0 };
            if own + bonus >= self.level
                && i64::from(own) - i64::from(others) >= i64::from(self.margin - bonus)
            {
                return leading;
            }
        }
        Leading::None
    }
}

impl<const N: usize> Default for Intent<N> {
    fn default() -> Self {
        Intent::new()
    }
}
