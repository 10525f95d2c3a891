//! Texts that a user reads: errors in plain words, progress.

pub mod date;
pub mod progress;
pub mod starts;
pub mod toml_key;
pub mod words;
