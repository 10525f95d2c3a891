//! The reflex: a check of raw codes after each sub-field of an interlaced scan, without waiting for the frame.
//!
//! | | |
//! |---|---|
//! | input | the codes of a sub-field in the order of the scan, a limit for each taxel |
//! | output | the codes in their places of a frame; the rows of the scene's reactions that begin |
//! | latency | the rest of the sub-field: 640 us at most on the reference garment |
//! | RAM | [`Reflex`]: 4 bytes a taxel and 700 |
//! | Cortex-M0+ | `docs/reflex.md` |
//!
//! Contacts, shapes and meanings need whole frames. A pin that is to move within a millisecond does not: a
//! reaction whose cause is [`Cause::Reflex`](crate::react::Cause::Reflex) begins when one taxel of its region
//! is beyond the limit, or two that are near each other, as [`Agree`] says. It ends as every other reaction
//! does, by frames.
//!
//! Taxels that are silenced (absent, dead, stuck, noisy) have a limit that no code passes. While a tare runs
//! nothing is watched.

mod agree;
mod check;
mod watched;

pub use agree::Agree;
pub use check::{Early, Reflex};
pub use watched::{ROWS, Reflexes, Row};
