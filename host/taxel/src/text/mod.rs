//! Texts that a user reads: errors in plain words, steps of the program, progress.

pub mod date;
pub mod progress;
pub mod starts;
pub mod toml_key;
pub mod verbose;
pub mod words;
