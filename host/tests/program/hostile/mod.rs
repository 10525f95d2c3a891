//! Files and clients that nobody means well: they end in a sentence, within a bounded memory, and shut nobody
//! out.

#[cfg(target_os = "linux")]
mod bombs;
mod names;
mod page;
