//! Symbols: what touched where, how hard, how large, how long, moving or still.
//!
//! | | |
//! |---|---|
//! | input | the placed contacts of a frame, present and released |
//! | output | an event for each onset, change of a word, and release; a state per region |
//! | latency | none |
//! | RAM | [`SymbolState`]: about 24 bytes a contact, 20 a region |
//!
//! Words do not flicker. A measure has to pass its limit by an eighth; a shape has to outweigh what spoke for
//! the one that was said; and what slid is said to move for a while longer.

mod config;
mod said;
mod stage;
mod words;

pub use config::SymbolConfig;
pub use stage::{EVENTS, RegionState, Symbol, SymbolState, Symbols};
pub use words::{Extent, SHARP, Span, Strength, Words};
