//! The reflex: a check of raw codes after each sub-field of an interlaced scan, without waiting for the
//! frame.
//!
//! | | |
//! |---|---|
//! | input | codes of a sub-field in the order of the scan, a limit for each taxel |
//! | output | codes by taxel number; rows of the scene's reactions that begin |
//! | latency | the rest of the sub-field: 640 us at most on the reference garment |
//! | RAM | [`Reflex`](crate::acquire::Reflex) of 2,048 taxels: 8,968 bytes |
//! | Cortex-M0+ | `docs/concepts/reflex.md` |
//!
//! Contacts, shapes and meanings need whole frames. A pin that has to move within a millisecond cannot wait
//! for one: a reaction whose cause is [`Cause::Reflex`](crate::react::Cause::Reflex) begins when one taxel of
//! its region is beyond the limit, or two that are near each other, see [`Agree`]. It ends by frames, like
//! every other reaction.
//!
//! Silenced taxels (absent, dead, stuck, noisy) have a limit that no code exceeds. During a tare nothing is
//! watched.

mod agree;
mod early;
mod spot;
mod watched;

pub use agree::Agree;
pub(crate) use agree::Recent;
pub use early::Early;
pub use watched::{ROWS, ReflexRow, Reflexes};
