//! How a board comes to start: what reset it, how often in a row, and whether it may use the settings that are
//! stored.
//!
//! A board that resets by itself [`RESETS`] times without a minute of life between begins with what ships, so
//! that a host reaches it: what it was told to keep may be the reason. The stored settings stay where they are.
//!
//! | file | what |
//! |---|---|
//! | `boots.rs` | what is counted from start to start |
//! | `kept.rs` | the word in which it survives a reset |

mod boots;
mod kept;

pub use boots::{Boots, LIFE_US, RESETS};
pub use kept::panicked;

use serde::{Deserialize, Serialize};

/// What reset the board, as its hardware tells.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reset {
    /// The power came, or came back.
    Power,
    /// The reset pin.
    Pin,
    /// The watchdog was not fed.
    Watchdog,
    /// The program asked the watchdog for it.
    Program,
    /// Something else: a debugger, say.
    Other,
}

/// What a reset leaves as it is: a word, which is lost with the power, and the cause.
pub trait Remains {
    /// What reset the board.
    fn reset(&self) -> Reset;
    /// The word that was kept; anything after a power-up.
    fn word(&self) -> u32;
    /// Keeps a word.
    fn keep(&mut self, word: u32);
}

/// Why the board started. Variants are only appended.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum BootCause {
    /// The power came, or came back.
    #[default]
    Power,
    /// The reset pin.
    Pin,
    /// The watchdog was not fed: the loop did not come round in time.
    Watchdog,
    /// The program panicked.
    Panic,
    /// A host asked for it.
    Request,
    /// Something else: a debugger, or the boot loader after flashing.
    Other,
}

/// Why the settings that are stored are not in force. Variants are only appended.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Aside {
    /// They are, if there are any.
    #[default]
    No,
    /// The board has reset itself too often.
    Resets,
    /// A pin was grounded at the start.
    Pin,
    /// A host asked for it.
    Request,
}

/// How the board came to start.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Boot {
    /// Why.
    pub cause: BootCause,
    /// Resets by watchdog or panic up to this one, none of them a minute after the one before.
    pub resets: u8,
    /// Why the stored settings are not in force.
    pub aside: Aside,
}
