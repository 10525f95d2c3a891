//! What a board said and what holds until it says otherwise: who starts in the middle of a recording is told
//! this first.

use crate::client::{Worn, leads};
use std::collections::BTreeMap;
use std::sync::Arc;
use taxel_core::format::Name;
use taxel_core::wire::Report;

/// A frame of the wire, and its place among those that hold.
type Part = (u64, Arc<[u8]>);

/// The frames of the wire that hold, their 0x00 included.
#[derive(Debug, Default, Clone)]
pub struct Standing {
    /// By the report's number and, of a map of health, its first taxel, of an intention, whether it led.
    parts: BTreeMap<(u32, u16), Part>,
    taken: u64,
    /// Number of the next message; none before the first.
    next: Option<u32>,
    /// Concepts of the board's map.
    concepts: Vec<Name>,
}

impl Standing {
    /// Takes a message with its number; how many before it are missing.
    pub fn take(&mut self, seq: u32, report: &Report<'_>, frame: &[u8]) -> u64 {
        let gap = self.next.map_or(0, |next| seq.wrapping_sub(next));
        self.next = Some(seq.wrapping_add(1));
        let restarted = gap > u32::MAX / 2;
        if restarted {
            // The board has started anew: what it said before holds no more.
            self.parts.retain(|(number, _), _| *number == Report::HELLO);
        }
        if let Some(key) = self.key(report) {
            self.taken += 1;
            self.parts.insert(key, (self.taken, frame.into()));
        }
        if restarted { 0 } else { u64::from(gap) }
    }

    /// Where a message is kept; none: it says nothing that lasts.
    fn key(&mut self, report: &Report<'_>) -> Option<(u32, u16)> {
        let number = match report {
            Report::Hello(hello) => {
                self.concepts = Worn::read(hello).map_or(Vec::new(), |worn| worn.concepts().to_vec());
                Report::HELLO
            }
            Report::Contacts(_) => Report::CONTACTS,
            Report::Symbols(_) => Report::SYMBOLS,
            Report::Intent(report) => {
                // The last moment at which the announced intention led is told with it, unless they are one.
                let leads = leads(&self.concepts, report);
                if leads {
                    self.parts.remove(&(Report::INTENT, 0));
                }
                return Some((Report::INTENT, u16::from(leads)));
            }
            Report::Health(_) => Report::HEALTH,
            Report::Budget(_) => Report::BUDGET,
            Report::HealthMap(map) => {
                let told = map.first..map.end;
                self.parts
                    .retain(|(number, first), _| *number != Report::HEALTH_MAP || !told.contains(first));
                return Some((Report::HEALTH_MAP, map.first));
            }
            Report::Temperature(_) => Report::TEMPERATURE,
            Report::SelfTest(_) => Report::SELF_TEST,
            Report::Shapes(_) => Report::SHAPES,
            _ => return None,
        };
        Some((number, 0))
    }

    /// Nothing has been said that lasts.
    pub fn is_empty(&self) -> bool {
        self.parts.is_empty()
    }

    /// The frames, in the order in which they came.
    pub fn frames(&self) -> Vec<Arc<[u8]>> {
        let mut parts: Vec<_> = self.parts.values().collect();
        parts.sort_by_key(|(order, _)| *order);
        parts.into_iter().map(|(_, frame)| frame.clone()).collect()
    }
}
