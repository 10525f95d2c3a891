//! Commands about recordings.

pub mod export;
pub mod info;
pub mod record;
pub mod repair;
pub mod report;
