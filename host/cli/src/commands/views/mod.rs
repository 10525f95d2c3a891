//! Commands that show a stream.

#[cfg(feature = "foxglove")]
pub mod foxglove;
pub mod live;
pub mod view;
