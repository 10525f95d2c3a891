//! Settings of a board in NOR flash, the same code under a real flash and under a simulated one whose power
//! is cut.
//!
//! | file | what |
//! |---|---|
//! | `store.rs` | saving and loading |
//! | `index.rs` | which parts are in force, and how they are known to be whole |
//! | `levels.rs` | where the outputs stand when a board starts |
//! | `waitless.rs` | a flash that blocks, where one that waits is asked for |
//!
//! The parts of the settings lie as items of at most [`CHUNK`] bytes in a map of sequential-storage. Each
//! part has two places: a save writes the parts that have changed to the place that is not in force, and then
//! one item, the index, which puts them in force together. Until that item is whole, the old index and all
//! that it names are untouched.
#![no_std]
#![forbid(unsafe_code)]
#![deny(missing_docs)]

mod index;
mod levels;
mod store;
mod waitless;

pub use levels::{Record, in_force, keep_levels};
pub use store::{CHUNK, Found, Store, StoreError};
