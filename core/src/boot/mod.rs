//! Start of a board: cause of the reset, number of resets in a row, and whether the stored settings are used.
//!
//! A board that resets by itself [`RESETS`] times without a minute between starts with the shipped settings,
//! so that a host can reach it: the stored settings may be the cause. They are not erased.
//!
//! | file | content |
//! |---|---|
//! | `boots.rs` | state kept from start to start |
//! | `kept.rs` | the word in which it survives a reset |

mod boots;
mod kept;

pub use boots::{Boots, LIFE_US, RESETS};
pub use kept::panicked;

use serde::{Deserialize, Serialize};

/// Cause of a reset, as the hardware reports it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reset {
    /// Power-up.
    Power,
    /// The reset pin.
    Pin,
    /// The watchdog was not fed.
    Watchdog,
    /// The program used the watchdog to restart.
    Program,
    /// Another cause, such as a debugger.
    Other,
}

/// Remains of a run after a reset: a word, which is lost with the power, and the cause of the reset.
pub trait Remains {
    /// Cause of the reset.
    fn reset(&self) -> Reset;
    /// The word that was kept; arbitrary after power-up.
    fn word(&self) -> u32;
    /// Stores a word.
    fn keep(&mut self, word: u32);
}

/// Cause of the board's start. Variants are only appended.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum BootCause {
    /// Power-up.
    #[default]
    Power,
    /// The reset pin.
    Pin,
    /// The watchdog was not fed: the loop did not come round in time.
    Watchdog,
    /// The program panicked.
    Panic,
    /// A host requested it.
    Request,
    /// Another cause, such as a debugger, or the boot loader after flashing.
    Other,
}

/// Reason why the stored settings are not in use. Variants are only appended.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Aside {
    /// They are in use, if there are any.
    #[default]
    No,
    /// The board has reset itself too often.
    Resets,
    /// A pin was grounded at the start.
    Pin,
    /// A host requested it.
    Request,
}

/// Start of the board.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Boot {
    /// Cause of the start.
    pub cause: BootCause,
    /// Resets by watchdog or panic up to this one, each less than a minute after the one before.
    pub resets: u8,
    /// Reason why the stored settings are not in use.
    pub aside: Aside,
}
