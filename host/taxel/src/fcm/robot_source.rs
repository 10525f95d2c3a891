//! Sources of a map of a robot: the robot's boards as a whole, its own motion, and what others know. A board knows
//! none of it.
//!
//! | `robot =` | unit | value |
//! |---|---|---|
//! | `{ intent = "attack" }` | 2^-15 | activation of this intention on a board that announces it, 0 on one that does not: the greatest of all boards |
//! | `{ load = ["chest"] }` | counts | sum of the contacts on this part, of each its greatest force within 1.2 s, also after its end; thousandths of a newton on boards with a calibration in force |
//! | `{ cover = ["chest"] }` | mm2 | area that they cover |
//! | `{ lasts = ["chest"] }` | ms | time since this part is touched without a gap |
//! | `{ apart = [["chest"], ["back"]] }` | ms | time by which the touch of the first part began before that of the second; 0 unless both are touched |
//! | `{ motion = ["arm"] }` | mm/s | speed of the fastest link of this part, by the joints that are sent |
//! | `"own"` | 2^-15 | share of the force that the robot's own motion has caused, on the board that announces something, the least of several; else on all boards |
//! | `{ hardness = ["arm"] }` | counts/mm | force over depth of what this part has moved into |
//! | `{ point = ["arm"] }` | percent | share of its force on a single taxel, at the greatest force |
//! | `{ slide = ["arm"] }` | mm/s | greatest speed of it along the surface |
//! | `{ stir = ["arm"] }` | percent | greatest change of its force while the part was still |
//! | `{ host_input = "voice" }` | 2^-15 | what somebody sent by this name |
//!
//! A part is named by words: a contact lies on it if one of them is a word of its region or of its link. No
//! word stands for the whole robot.

use serde::{Deserialize, Serialize};
use taxel_core::intent::Leading;

/// Words that name a part of the body.
pub type PartWords = Vec<String>;

/// Source of an input of a map of a robot; see the [module](self).
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum RobotSource {
    /// Activation of an intention on the boards that announce it, 2^-15.
    Intent(Leading),
    /// Force on a part, counts.
    Load(PartWords),
    /// Touched area of a part, mm2.
    Cover(PartWords),
    /// Time since a part is touched, ms.
    Lasts(PartWords),
    /// Time from the begin of the first part's touch to that of the second's, ms.
    Apart(PartWords, PartWords),
    /// Speed of the fastest link of a part, mm/s.
    Motion(PartWords),
    /// Share of the force that the robot's own motion has caused, 2^-15.
    Own,
    /// Force over depth of what a part has moved into, counts/mm.
    Hardness(PartWords),
    /// Share of its force on a single taxel, percent.
    Point(PartWords),
    /// Greatest speed of it along the surface, mm/s.
    Slide(PartWords),
    /// Greatest change of its force while the part was still, percent.
    Stir(PartWords),
    /// Value that somebody sent by a name, 2^-15.
    HostInput(String),
}

/// Source of an input of a map of a robot, and what counts instead.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RobotInput {
    /// Name of the concept.
    pub concept: String,
    /// Source of its value.
    pub source: RobotSource,
    /// Age from which a value no longer counts, ms; none: never.
    pub timeout_ms: Option<u32>,
    /// Value that counts then, and while there is none; in the unit of the source.
    pub default: i32,
}
