//! The current words of a contact, and their hysteresis.

use super::config::SymbolConfig;
use super::words::{Extent, SHARP, Span, Strength, Words};
use crate::body::Placed;
use crate::format::Q15;
use crate::shape::Class;

/// Current words of a contact.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct ReportedWords {
    /// Id of the contact.
    pub contact: u32,
    /// The words reported last.
    pub words: Words,
    /// Evidence for the present class: milliseconds with full confidence.
    evidence: u16,
    /// Time since it last slid, ms; saturates.
    still_ms: u8,
}

/// Initial evidence for the class of an onset, ms; low, because the form of a new touch changes soon.
const FIRST: u16 = 20;

/// Initial evidence for a class that has replaced another, ms.
const CHANGED: u16 = 200;

/// Limit of the evidence, ms, which bounds the time until another class wins.
const MOST: u16 = 400;

/// Time for which a contact counts as moving after it slid, ms.
const STILL: u8 = 250;

impl ReportedWords {
    /// Words of a new contact.
    pub fn new(config: &SymbolConfig, placed: &Placed, area_mm2: u32) -> ReportedWords {
        let mut said = ReportedWords {
            contact: placed.contact.id,
            words: Words::default(),
            evidence: FIRST,
            still_ms: u8::MAX,
        };
        said.words.class = placed.shape.class;
        said.measure(config, placed, area_mm2, None);
        said.slide(placed.contact.slip, 0);
        said
    }

    /// Updates the words after `ms`; true if they have changed.
    pub fn follow(&mut self, config: &SymbolConfig, placed: &Placed, area_mm2: u32, ms: u8) -> bool {
        let before = self.words;
        self.measure(config, placed, area_mm2, Some(before));
        self.slide(placed.contact.slip, ms);
        if placed.contact.total >= placed.contact.peak_total / 2 {
            self.weigh(placed.shape.class, placed.shape.confidence, ms);
        }
        self.words != before
    }

    /// Resets the class, because another base of shapes is in force that does not have its name.
    pub fn forget_class(&mut self) {
        (self.words.class, self.evidence) = (Class::UNKNOWN, 0);
    }

    /// Chooses the words for strength, extent and span.
    fn measure(&mut self, config: &SymbolConfig, placed: &Placed, area_mm2: u32, before: Option<Words>) {
        let contact = &placed.contact;
        let limits = config.extent.map(|cm2| u32::from(cm2) * 100);
        let largest = before.map_or(0, |w| w.extent.size());
        let strength = word(contact.peak_total, &config.strength, before.map(|w| w.strength as usize));
        let extent = word(area_mm2, &limits, before.map(|w| w.extent.size())).max(largest);
        let span = word(contact.duration_ms, &config.span_ms, None);
        self.words.strength = match strength {
            0 => Strength::Faint,
            1 => Strength::Light,
            2 => Strength::Firm,
            _ => Strength::Hard,
        };
        self.words.extent = match extent {
            0 if contact.peak >= SHARP || before.is_some_and(|w| w.extent == Extent::Sharp) => Extent::Sharp,
            0 => Extent::Point,
            1 => Extent::Patch,
            _ => Extent::Wide,
        };
        self.words.span = match span {
            0 => Span::Brief,
            1 => Span::Short,
            _ => Span::Long,
        };
    }

    /// Updates whether it moves; `slides` is true if it slides now.
    fn slide(&mut self, slides: bool, ms: u8) {
        self.still_ms = if slides { 0 } else { self.still_ms.saturating_add(ms) };
        self.words.moving = self.still_ms < STILL;
    }

    /// Updates the class by a class seen for `ms` with this confidence (Q15): a majority vote whose lead is
    /// limited.
    fn weigh(&mut self, class: Class, confidence: Q15, ms: u8) {
        // 16 + 8 bits; rounded up, so that any class wins in the end.
        let weight = (confidence.0.clamp(0, 1 << 15) as u32 * u32::from(ms)).div_ceil(1 << 15) as u16;
        if class == self.words.class {
            self.evidence = self.evidence.saturating_add(weight).min(MOST);
        } else if let Some(left) = self.evidence.checked_sub(weight) {
            self.evidence = left;
        } else {
            (self.words.class, self.evidence) = (class, CHANGED);
        }
    }
}

/// Finds the words of contact `id`. Contacts and words have the same order, so it is mostly at `at`, which
/// then advances.
pub(super) fn said_of<'a>(
    said: &'a mut [ReportedWords],
    at: &mut usize,
    id: u32,
) -> Option<&'a mut ReportedWords> {
    if said.get(*at).is_none_or(|said| said.contact != id) {
        *at = said.iter().position(|said| said.contact == id)?;
    }
    let found = said.get_mut(*at);
    *at += 1;
    found
}

/// Index of the word for `measure` among ascending limits. From `before`, the present word, it changes only
/// if a limit is passed by an eighth (hysteresis).
#[inline]
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

    /// A contact of which only the id is set.
    fn of(contact: u32) -> ReportedWords {
        ReportedWords { contact, words: Words::default(), evidence: FIRST, still_ms: u8::MAX }
    }

    #[test]
    fn what_was_said_is_found_in_any_order() {
        let mut said = [7, 9, 12, 30].map(of);
        for ids in [[7, 9, 12, 30], [30, 12, 9, 7], [9, 8, 30, 7], [1, 2, 3, 12]] {
            let mut at = 0;
            for id in ids {
                let plain = said.iter().find(|said| said.contact == id).cloned();
                assert_eq!(said_of(&mut said, &mut at, id).cloned(), plain, "{ids:?} {id}");
            }
        }
    }

    /// Number of changes of the class, and the last class.
    fn classes(seen: impl Iterator<Item = Class>, ms: u8) -> (usize, Class) {
        let (mut said, mut changes) = (of(1), 0);
        for class in seen {
            let before = said.words.class;
            said.weigh(class, Q15(30_000), ms);
            changes += usize::from(said.words.class != before);
        }
        (changes, said.words.class)
    }

    #[test]
    fn a_class_changes_by_evidence_at_any_rate() {
        let (round, rectangle) = (Class::ROUND, Class::RECTANGLE);
        for ms in [1, 5, 40, 100] {
            let frames = 4000 / usize::from(ms);
            let each = |frame: usize| if frame.is_multiple_of(2) { round } else { rectangle };
            assert!(classes((0..frames).map(each), ms).0 <= 2, "two in turn, {ms} ms");
            // A second of one class, then the other: it wins within half a second.
            let (first, second) = (1000 / usize::from(ms), 500 / usize::from(ms));
            let changed = core::iter::repeat_n(round, first).chain(core::iter::repeat_n(rectangle, second));
            assert_eq!(classes(changed, ms), (2, rectangle), "{ms} ms");
        }
    }

    #[test]
    fn what_slid_is_said_to_move_for_a_while() {
        let mut said = of(1);
        said.slide(true, 5);
        for _ in 0..49 {
            said.slide(false, 5);
            assert!(said.words.moving);
        }
        said.slide(false, 5);
        assert!(!said.words.moving);
    }
}
