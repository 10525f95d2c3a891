//! Messages of a board that are still valid, as frames of the wire: a file that continues another begins with them,
//! and a client that starts in the middle of a recording gets them first.

use super::{BoardDescription, leads};
use std::collections::BTreeMap;
use std::sync::Arc;
use taxel_core::format::Name;
use taxel_core::wire::{self, Report};

/// Reports that stay valid beyond a moment: settings, names, faults, reactions that are active.
const LASTING: [u32; 8] = [
    Report::HELLO,
    Report::SELF_TEST,
    Report::REACTION,
    Report::SHAPES,
    Report::HEALTH_MAP,
    Report::HEALTH,
    Report::TEMPERATURE,
    Report::REGION_NAMES,
];

/// A frame of the wire, and its position in the order.
type WireFrame = (u64, Arc<[u8]>);

/// Frames of the wire that are still valid, including their 0x00.
#[derive(Debug, Default, Clone)]
pub struct RetainedState {
    /// Frames by the report's number and, for a map of health, its first taxel; for an intention, whether it led; for
    /// a reaction, its index.
    parts: BTreeMap<(u32, u16), WireFrame>,
    taken: u64,
    /// Number of the next message; none before the first.
    next: Option<u32>,
    /// Concepts of the board's map.
    concepts: Vec<Name>,
}

impl RetainedState {
    /// Handles a frame of the wire; what is no message changes nothing.
    pub(crate) fn take_frame(&mut self, frame: &[u8]) {
        let mut bytes = frame.strip_suffix(&[0]).unwrap_or(frame).to_vec();
        let read = wire::open(&mut bytes).and_then(wire::decode::<(u32, Report<'_>)>);
        if let Ok((seq, report)) = read {
            self.take(seq, &report, frame);
        }
    }

    /// Handles a message, and its frame. Returns the number of messages missing before it.
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

    /// Key of a message; none if it does not stay valid.
    fn key(&mut self, report: &Report<'_>) -> Option<(u32, u16)> {
        let number = match report {
            Report::Hello(hello) => {
                self.concepts = BoardDescription::read(hello)
                    .map_or(Vec::new(), |description| description.concepts().to_vec());
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
                let reported = map.first..map.end;
                self.parts
                    .retain(|(number, first), _| *number != Report::HEALTH_MAP || !reported.contains(first));
                return Some((Report::HEALTH_MAP, map.first));
            }
            Report::Temperature(_) => Report::TEMPERATURE,
            Report::SelfTest(_) => Report::SELF_TEST,
            Report::Shapes(_) => Report::SHAPES,
            Report::RegionNames(_) => Report::REGION_NAMES,
            Report::Regions(_) => Report::REGIONS,
            Report::Reaction(report) => {
                let key = (Report::REACTION, u16::from(report.reaction.index));
                if !report.reaction.active {
                    self.parts.remove(&key);
                }
                return report.reaction.active.then_some(key);
            }
            _ => return None,
        };
        Some((number, 0))
    }

    /// True if nothing is known.
    pub fn is_empty(&self) -> bool {
        self.parts.is_empty()
    }

    /// The frame of the last `Hello`; none before the first.
    pub fn hello(&self) -> Option<Arc<[u8]>> {
        self.parts.get(&(Report::HELLO, 0)).map(|(_, frame)| frame.clone())
    }

    /// The frames in order: the state at this moment.
    pub fn frames(&self) -> Vec<Arc<[u8]>> {
        self.ordered(|_| true)
    }

    /// Returns in order the frames that stay valid beyond the moment: without contacts, and what they mean.
    pub fn lasting(&self) -> Vec<Arc<[u8]>> {
        self.ordered(|number| LASTING.contains(&number))
    }

    fn ordered(&self, is_one: impl Fn(u32) -> bool) -> Vec<Arc<[u8]>> {
        let mut parts: Vec<_> = self.parts.iter().filter(|((number, _), _)| is_one(*number)).collect();
        parts.sort_by_key(|(_, (order, _))| *order);
        parts.into_iter().map(|(_, (_, frame))| frame.clone()).collect()
    }
}
