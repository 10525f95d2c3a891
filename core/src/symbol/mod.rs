//! Symbols: words for each contact (how hard, how large, how long, moving or still), and the state of each
//! region.
//!
//! | | |
//! |---|---|
//! | input | placed contacts of a frame, present and released |
//! | output | an event for each onset, change of a word, and release; a state per region |
//! | latency | none |
//! | RAM | [`SymbolState`] of 32 contacts: 760 bytes |
//!
//! Words do not flicker. A measure must pass its limit by an eighth; another shape must outweigh the evidence
//! for the present one; and the word for moving holds for a while after a slide.

mod config;
mod said;
mod stage;
mod words;

pub use config::SymbolConfig;
pub use stage::{RegionState, Symbol, SymbolState, Symbols};
pub use words::{Extent, SHARP, Span, Strength, Words};
