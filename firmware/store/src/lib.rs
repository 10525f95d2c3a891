//! Settings of a board in NOR flash. One code for a real flash and for a simulated one with power cuts.
//!
//! | file | what |
//! |---|---|
//! | `store.rs` | saving and loading |
//! | `index.rs` | the parts in force, with their checksums |
//! | `levels.rs` | levels of the outputs at start-up |
//! | `tables.rs` | the table of the garment's surface |
//! | `waitless.rs` | adapter from a blocking flash to the asynchronous traits |
//!
//! The parts of the settings are stored as items of at most [`CHUNK`] bytes in a map of sequential-storage.
//! Each part has two places. A save writes the parts that have changed to the place that is not in force, and
//! then one item, the index, which puts them in force together. Until that item is complete, the old index
//! and everything it refers to are untouched.
#![no_std]
#![forbid(unsafe_code)]
#![deny(missing_docs)]

mod index;
mod levels;
mod store;
mod tables;
mod waitless;

pub use levels::{Record, in_force, keep_levels};
pub use store::{CHUNK, Found, Store, StoreError};
pub use tables::{Tables, tables_bytes};
