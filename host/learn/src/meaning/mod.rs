//! Scripts of touches by several hands, each with what a person would say of them, and the map judged by them.
//!
//! A folder is an author: scripts of touches (`docs/guides/touches.md`) and `rules.json`, which has a [`Rule`] for each.

mod author;
mod heard;
mod learn;
mod rule;
mod table;
mod varied;

pub use author::{Author, JudgedScript};
pub use heard::{Heard, hear, hear_all};
pub use learn::{PlayedScript, examples, learn};
pub use rule::{Rule, Wrong};
pub use table::{Row, counts, table};
pub use varied::varied;
