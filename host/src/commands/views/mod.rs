//! Commands that show a stream.

pub mod live;
