//! Lasting state of a board as frames of the wire: a client that starts in the middle of a recording gets
//! them first.

use std::collections::BTreeMap;
use std::sync::Arc;
use taxel::client::{Worn, leads};
use taxel_core::format::Name;
use taxel_core::wire::Report;

/// A frame of the wire, and its position in the order.
type WireFrame = (u64, Arc<[u8]>);

/// Frames of the wire with lasting state, including their 0x00.
#[derive(Debug, Default, Clone)]
pub struct Standing {
    /// Frames by the report's number and, for a map of health, its first taxel; for an intention, whether it
    /// led.
    parts: BTreeMap<(u32, u16), WireFrame>,
    taken: u64,
    /// Number of the next message; none before the first.
    next: Option<u32>,
    /// Concepts of the board's map.
    concepts: Vec<Name>,
}

impl Standing {
    /// Handles a message. Returns the number of messages missing before it.
    pub fn take(&mut self, seq: u32, report: &Report<'_>, frame: &[u8]) -> u64 {
        let gap = self.next.map_or(0, |next| seq.wrapping_sub(next));
        self.next = Some(seq.wrapping_add(1));
        let restarted = gap > u32::MAX / 2;
        if restarted {
            // The board has restarted: discard its earlier state.
            self.parts.retain(|(number, _), _| *number == Report::HELLO);
        }
        if let Some(key) = self.key(report) {
            self.taken += 1;
            self.parts.insert(key, (self.taken, frame.into()));
        }
        if restarted { 0 } else { u64::from(gap) }
    }

    /// Key of a message; none if it has no lasting state.
    fn key(&mut self, report: &Report<'_>) -> Option<(u32, u16)> {
        let number = match report {
            Report::Hello(hello) => {
                self.concepts = Worn::read(hello).map_or(Vec::new(), |worn| worn.concepts().to_vec());
                Report::HELLO
            }
            Report::Contacts(_) => Report::CONTACTS,
            Report::Symbols(_) => Report::SYMBOLS,
            Report::Intent(report) => {
                // The last moment at which the announced intention led is kept as well, unless it is this
                // one.
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

    /// True if there is no lasting state.
    pub fn is_empty(&self) -> bool {
        self.parts.is_empty()
    }

    /// The frames in order.
    pub fn frames(&self) -> Vec<Arc<[u8]>> {
        let mut parts: Vec<_> = self.parts.values().collect();
        parts.sort_by_key(|(order, _)| *order);
        parts.into_iter().map(|(_, frame)| frame.clone()).collect()
    }
}
