//! Symbols: what touched where, how hard, how large, how long, moving or still.
//!
//! | | |
//! |---|---|
//! | input | the placed contacts of a frame, present and released |
//! | output | an event for each onset, change of a word, and release; a state per region |
//! | latency | none |
//! | RAM | [`SymbolState`]: about 24 bytes a contact, 20 a region |
//!
//! A word changes only when its measure has passed the limit by an eighth, so that a value on the edge does not flicker.

use crate::body::Placed;
use crate::contact::Phase;
use crate::format::{Invalid, Micros};
use crate::garment::PANELS;
use crate::shape::Class;
use heapless::Vec;
use serde::{Deserialize, Serialize};

/// Limits between the words; each row rises.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct SymbolConfig {
    /// Total pressure in counts from which a touch is light, firm, hard; below it is faint.
    pub strength: [u32; 3],
    /// Area in taxels from which a touch is a patch, a wide one; below it is a point.
    pub extent: [u16; 2],
    /// Duration in ms from which a touch is short, long; below it is brief.
    pub span_ms: [u32; 2],
}

impl Default for SymbolConfig {
    /// At 1000 counts per newton: light from 1 N, firm from 5 N, hard from 20 N.
    fn default() -> Self {
        SymbolConfig { strength: [1_000, 5_000, 20_000], extent: [9, 40], span_ms: [150, 800] }
    }
}

impl SymbolConfig {
    /// Checks the limits.
    pub fn build(&self) -> Result<Symbols, Invalid> {
        let must = "must rise";
        if !self.strength.is_sorted_by(|a, b| a < b) {
            return Err(Invalid { parameter: "symbol.strength", must });
        }
        if !self.extent.is_sorted_by(|a, b| a < b) {
            return Err(Invalid { parameter: "symbol.extent", must });
        }
        if !self.span_ms.is_sorted_by(|a, b| a < b) {
            return Err(Invalid { parameter: "symbol.span_ms", must });
        }
        Ok(Symbols { config: *self })
    }
}

/// How hard.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Strength {
    /// below the first limit
    #[default]
    Faint,
    /// from the first limit
    Light,
    /// from the second
    Firm,
    /// from the third
    Hard,
}

/// How large.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Extent {
    /// below the first limit
    #[default]
    Point,
    /// from the first limit
    Patch,
    /// from the second
    Wide,
}

/// How long.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Span {
    /// below the first limit
    #[default]
    Brief,
    /// from the first limit
    Short,
    /// from the second
    Long,
}

/// The words for one contact.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Words {
    /// How hard, at its hardest so far.
    pub strength: Strength,
    /// How large, at its largest so far.
    pub extent: Extent,
    /// How long so far.
    pub span: Span,
    /// It slides over the surface.
    pub moving: bool,
    /// What shape, while it presses with at least half of its greatest total: what is left of it later has another.
    pub class: Class,
}

/// Something that was said of a contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Symbol {
    /// Id of the contact.
    pub contact: u32,
    /// Held stands for a change of words.
    pub phase: Phase,
    /// Index into the layout's regions.
    pub region: u8,
    /// The words.
    pub words: Words,
    /// Greatest total so far, counts.
    pub peak_total: u32,
    /// Time since onset, ms.
    pub duration_ms: u32,
}

/// What happens in one region of the body.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct RegionState {
    /// Index into the layout's regions.
    pub region: u8,
    /// Number of contacts.
    pub contacts: u8,
    /// Sum of their totals, counts.
    pub total: u32,
    /// Greatest pressure of a taxel, counts.
    pub peak: u16,
    /// A contact slides.
    pub moving: bool,
    /// Since when the region has been touched, or left alone.
    pub since: Micros,
}

/// What the stage remembers.
#[derive(Debug, Clone)]
pub struct SymbolState<const CONTACTS: usize> {
    said: Vec<(u32, Words), CONTACTS>,
    events: Vec<Symbol, EVENTS>,
    regions: [RegionState; PANELS],
}

/// Most events of one frame, and of one message; those beyond are not said.
pub const EVENTS: usize = 32;

impl<const CONTACTS: usize> Default for SymbolState<CONTACTS> {
    fn default() -> Self {
        SymbolState { said: Vec::new(), events: Vec::new(), regions: [RegionState::default(); PANELS] }
    }
}

impl<const CONTACTS: usize> SymbolState<CONTACTS> {
    /// Events of the last frame.
    pub fn events(&self) -> &[Symbol] {
        &self.events
    }

    /// State of the first `count` regions.
    pub fn regions(&self, count: usize) -> &[RegionState] {
        self.regions.get(..count).unwrap_or(&self.regions)
    }
}

/// The checked stage.
#[derive(Debug, Default, Clone, PartialEq, Eq)]
pub struct Symbols {
    config: SymbolConfig,
}

/// Index of the word for `measure` among rising `limits`; from the word said before it moves only when a limit is passed
/// by an eighth.
fn word(measure: u32, limits: &[u32], before: Option<usize>) -> usize {
    let plain = limits.iter().take_while(|limit| measure >= **limit).count();
    match before {
        Some(before) if plain > before => {
            limits.iter().take_while(|limit| measure >= limit.saturating_add(**limit / 8)).count().max(before)
        }
        Some(before) if plain < before => {
            limits.iter().take_while(|limit| measure >= **limit - **limit / 8).count().min(before)
        }
        _ => plain,
    }
}

impl Symbols {
    /// Takes the contacts of the frame of time `now`: those `present`, then those `released`.
    pub fn process<const CONTACTS: usize>(
        &self,
        state: &mut SymbolState<CONTACTS>,
        present: &[Placed],
        released: &[Placed],
        now: Micros,
    ) {
        state.events.clear();
        let mut at = 0;
        for placed in present {
            let id = placed.contact.id;
            let before = said_of(&mut state.said, &mut at, id);
            let words = self.words(placed, before.as_ref().map(|(_, words)| *words));
            match before {
                Some((_, said)) if *said == words => continue,
                Some((_, said)) => {
                    *said = words;
                    let _ = state.events.push(symbol(placed, Phase::Held, words));
                }
                None => {
                    let _ = state.said.push((id, words));
                    let _ = state.events.push(symbol(placed, Phase::Onset, words));
                }
            }
        }
        for placed in released {
            let last = state.said.iter().find(|(said, _)| *said == placed.contact.id);
            let words = last.map_or_else(|| self.words(placed, None), |(_, words)| *words);
            let _ = state.events.push(symbol(placed, Phase::Released, words));
        }
        // Each contact is released before it is gone.
        if !released.is_empty() {
            state.said.retain(|(id, _)| released.iter().all(|gone| gone.contact.id != *id));
        }
        regions(&mut state.regions, present, now);
    }

    fn words(&self, placed: &Placed, before: Option<Words>) -> Words {
        let contact = &placed.contact;
        let strength = word(contact.peak_total, &self.config.strength, before.map(|w| w.strength as usize));
        let limits = self.config.extent.map(u32::from);
        let largest = before.map_or(0, |w| w.extent as usize);
        let extent = word(contact.area.into(), &limits, before.map(|w| w.extent as usize)).max(largest);
        let span = word(contact.duration_ms, &self.config.span_ms, None);
        Words {
            strength: match strength {
                0 => Strength::Faint,
                1 => Strength::Light,
                2 => Strength::Firm,
                _ => Strength::Hard,
            },
            extent: match extent {
                0 => Extent::Point,
                1 => Extent::Patch,
                _ => Extent::Wide,
            },
            span: match span {
                0 => Span::Brief,
                1 => Span::Short,
                _ => Span::Long,
            },
            moving: contact.slip,
            class: match before {
                Some(before) if contact.total < contact.peak_total / 2 => before.class,
                _ => placed.shape.class,
            },
        }
    }
}

/// What was said of a contact. Those present are in the order in which they came, as what was said of them: it is mostly
/// at `at`, after what was said of the one before.
fn said_of<'a>(said: &'a mut [(u32, Words)], at: &mut usize, id: u32) -> Option<&'a mut (u32, Words)> {
    if said.get(*at).is_none_or(|(other, _)| *other != id) {
        *at = said.iter().position(|(other, _)| *other == id)?;
    }
    let found = said.get_mut(*at);
    *at += 1;
    found
}

fn symbol(placed: &Placed, phase: Phase, words: Words) -> Symbol {
    Symbol {
        contact: placed.contact.id,
        phase,
        region: placed.region,
        words,
        peak_total: placed.contact.peak_total,
        duration_ms: placed.contact.duration_ms,
    }
}

fn regions(states: &mut [RegionState; PANELS], present: &[Placed], now: Micros) {
    const { assert!(PANELS <= 32) };
    // A bit for each region that was touched.
    let mut touched = 0u32;
    for (region, state) in (0u8..).zip(&mut *states) {
        touched |= u32::from(state.contacts > 0) << region;
        *state = RegionState { region, since: state.since, ..RegionState::default() };
    }
    // One by one: a loop over two at a time would divide.
    let mut left = present;
    while let [placed, rest @ ..] = left {
        left = rest;
        let Some(state) = states.get_mut(usize::from(placed.region)) else { continue };
        state.contacts = state.contacts.saturating_add(1);
        state.total = state.total.saturating_add(placed.contact.total);
        state.peak = state.peak.max(placed.contact.peak);
        state.moving |= placed.contact.slip;
    }
    for state in states {
        if (touched & 1 == 1) != (state.contacts > 0) {
            state.since = now;
        }
        touched >>= 1;
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;

    #[test]
    fn a_word_moves_only_past_an_eighth_of_its_limit() {
        let limits = [80, 800];
        let course = |measures: &[u32]| {
            let mut said = None;
            let mut words = std::vec::Vec::new();
            for measure in measures {
                said = Some(word(*measure, &limits, said));
                words.extend(said);
            }
            words
        };
        assert_eq!(course(&[79, 80, 89, 90, 80, 71, 70, 69]), [0, 0, 0, 1, 1, 1, 1, 0]);
        assert_eq!(course(&[80, 899, 900, 700, 699, 0]), [1, 1, 2, 2, 1, 0]);
        assert_eq!(course(&[5000, 75, 0]), [2, 1, 0]);
    }

    #[test]
    fn what_was_said_is_found_in_any_order() {
        let mut said = [7, 9, 12, 30].map(|id| (id, Words::default()));
        for ids in [[7, 9, 12, 30], [30, 12, 9, 7], [9, 8, 30, 7], [1, 2, 3, 12]] {
            let mut at = 0;
            for id in ids {
                let plain = said.iter().copied().find(|(other, _)| *other == id);
                assert_eq!(said_of(&mut said, &mut at, id).copied(), plain, "{ids:?} {id}");
            }
        }
    }

    #[test]
    fn limits_that_do_not_rise_are_refused_by_name() {
        let refused = |edit: fn(&mut SymbolConfig)| {
            let mut config = SymbolConfig::default();
            edit(&mut config);
            config.build().unwrap_err().parameter
        };
        assert_eq!(refused(|c| c.strength[1] = c.strength[0]), "symbol.strength");
        assert_eq!(refused(|c| c.extent = [9, 8]), "symbol.extent");
        assert_eq!(refused(|c| c.span_ms = [800, 150]), "symbol.span_ms");
    }
}
