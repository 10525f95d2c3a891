//! Commands about recordings.

pub mod export;
#[cfg(feature = "index")]
pub mod index;
pub mod info;
pub mod record;
pub mod repair;
pub mod report;
