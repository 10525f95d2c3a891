//! The table of reactions in a scene.

use crate::format::{Invalid, Name};
use crate::garment::Line;
use crate::intent::Leading;
use crate::reflex::{Agree, ROWS};
use serde::{Deserialize, Serialize};

/// Greatest number of reactions of a scene.
pub const REACTIONS: usize = ROWS;

/// Cause of a reaction: the value that is compared with its level. Variants are only appended.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Cause {
    /// Greatest pressure of a taxel, counts.
    Pressure,
    /// Total pressure of the region, counts.
    Force,
    /// Number of contacts.
    Contacts,
    /// 1 while a contact slides.
    Moving,
    /// Activation of a concept of the map, Q15 (32768 is 1.0).
    Concept(Name),
    /// 1 while this intention leads.
    Leading(Leading),
    /// Greatest pressure of a taxel, counts, like `Pressure`; but it begins before the frame is complete, as
    /// soon as enough taxels agree. Needs an interlaced scan.
    Reflex(Agree),
    /// Number of faults of lines and inputs, plus 1 if the last scan failed.
    Fault,
    /// Time since a frame was perceived, ms; 2147483647 before the first one, when a save is about to stop
    /// the scan, and during a tare.
    Blind,
    /// Number of faulty taxels.
    Faulty,
    /// Time since the last message of a host, ms.
    Silent,
    /// No value: its pin toggles every `level` perceived frames, and stands still if there are none.
    Watching,
}

/// One row of the table of reactions.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ReactionConfig {
    /// Name in messages to the host.
    pub name: Name,
    /// Value that is compared with `level`.
    pub cause: Cause,
    /// Region of the body to which it is limited; empty: anywhere. Only pressure, force, contacts, slip,
    /// reflexes and faulty taxels have one.
    #[serde(default)]
    pub region: Name,
    /// Value at which it begins, in the unit of the cause.
    pub level: i32,
    /// Hysteresis: it can end when the value is below `level - hysteresis`.
    #[serde(default)]
    pub hysteresis: i32,
    /// Shortest duration, and time for which the value must stay below before it ends, ms.
    #[serde(default)]
    pub hold_ms: u32,
    /// Pin that is asserted while it lasts. Several rows may assert the same pin.
    #[serde(default)]
    pub output: Option<Line>,
}

/// Longest time in `level` of a blind board or a silent host, ms.
const LONGEST_MS: i32 = 3_600_000;

impl Cause {
    /// True for causes in the board itself, not in what touches it.
    pub fn is_of_board(&self) -> bool {
        matches!(self, Cause::Fault | Cause::Blind | Cause::Faulty | Cause::Silent | Cause::Watching)
    }

    /// True for causes that a board cannot rule out when it has just started.
    pub fn is_open_at_start(&self) -> bool {
        matches!(self, Cause::Fault | Cause::Blind)
    }
}

impl ReactionConfig {
    /// Checks a row with a cause in the board itself.
    pub(super) fn check_of_board(&self) -> Result<(), Invalid> {
        let refuse = |parameter, must| Err(Invalid { parameter, must });
        let (most, must) = match self.cause {
            Cause::Blind | Cause::Silent => (LONGEST_MS, "must be 1 to 3600000 ms"),
            _ => (i32::from(u16::MAX), "must be 1 to 65535"),
        };
        if !(1..=most).contains(&self.level) {
            return refuse("level", must);
        }
        if !self.region.is_empty() && self.cause != Cause::Faulty {
            return refuse("region", "must be empty: this cause has none");
        }
        if self.cause == Cause::Watching && self.output.is_none() {
            return refuse("output", "must be given: nothing else shows that frames are perceived");
        }
        Ok(())
    }
}
