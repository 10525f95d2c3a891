//! Malicious files and clients: they end in a sentence, within bounded memory, and shut nobody out.

#[cfg(target_os = "linux")]
mod bombs;
mod names;
mod page;
