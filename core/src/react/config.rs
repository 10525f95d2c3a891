//! The table of reactions, as a scene has it.

use crate::format::{Invalid, Name};
use crate::garment::Line;
use crate::intent::Leading;
use crate::reflex::{Agree, ROWS};
use serde::{Deserialize, Serialize};

/// Most reactions of a scene.
pub const REACTIONS: usize = ROWS;

/// What a reaction looks at. Variants are only appended.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Cause {
    /// Greatest pressure of a taxel, counts.
    Pressure,
    /// Total pressure of the region, counts.
    Force,
    /// Number of contacts.
    Contacts,
    /// A contact slides: 1.
    Moving,
    /// Activation of a concept of the map, Q15 (32768 is 1.0).
    Concept(Name),
    /// This intention leads: 1.
    Leading(Leading),
    /// Greatest pressure of a taxel, counts, as of `Pressure`; and it begins before the frame is complete, as
    /// soon as so many taxels agree. Needs an interlaced scan.
    Reflex(Agree),
    /// What is wrong with the board: faults of lines and inputs, and 1 where the last scan failed.
    Fault,
    /// Time since a frame was perceived, ms; as long as none was, a save is about to stop the scan or a tare
    /// runs, 2147483647.
    Blind,
    /// Number of ill taxels.
    Ill,
    /// Time since the last message of a host, ms.
    Silent,
    /// Nothing: its pin changes each `level` perceived frames, and stands still where none are.
    Watching,
}

/// One row of the table of reactions.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ReactionConfig {
    /// What the host is told.
    pub name: Name,
    /// What is looked at.
    pub cause: Cause,
    /// Only in this region of the body; empty: anywhere. Only pressure, force, contacts, slip, reflexes and
    /// ill taxels have one.
    #[serde(default)]
    pub region: Name,
    /// It begins when the value reaches this, in the unit of the cause.
    pub level: i32,
    /// It can end when the value is below `level - hysteresis`.
    #[serde(default)]
    pub hysteresis: i32,
    /// Shortest time that it lasts, and time for which the value must stay below before it ends, ms.
    #[serde(default)]
    pub hold_ms: u32,
    /// A pin that is asserted while it lasts. Several rows may assert the same one.
    #[serde(default)]
    pub output: Option<Line>,
}

/// Longest time for which a board may be blind, or a host silent, before a reaction begins, ms.
const LONGEST_MS: i32 = 3_600_000;

impl Cause {
    /// Whether it is how the board itself is, not what touches it.
    pub fn is_of_board(&self) -> bool {
        matches!(self, Cause::Fault | Cause::Blind | Cause::Ill | Cause::Silent | Cause::Watching)
    }

    /// Whether a board that has just started cannot rule it out.
    pub fn is_open_at_start(&self) -> bool {
        matches!(self, Cause::Fault | Cause::Blind)
    }
}

impl ReactionConfig {
    /// Checks a row that looks at the board itself.
    pub(super) fn check_of_board(&self) -> Result<(), Invalid> {
        let refuse = |parameter, must| Err(Invalid { parameter, must });
        let (most, must) = match self.cause {
            Cause::Blind | Cause::Silent => (LONGEST_MS, "must be 1 to 3600000 ms"),
            _ => (i32::from(u16::MAX), "must be 1 to 65535"),
        };
        if !(1..=most).contains(&self.level) {
            return refuse("level", must);
        }
        if !self.region.is_empty() && self.cause != Cause::Ill {
            return refuse("region", "must be empty: this cause has none");
        }
        if self.cause == Cause::Watching && self.output.is_none() {
            return refuse("output", "must be given: nothing else shows that frames are perceived");
        }
        Ok(())
    }
}
