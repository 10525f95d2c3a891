//! Commands that show a stream.

#[cfg(feature = "foxglove")]
pub mod foxglove;
pub mod live;
#[cfg(feature = "ros2")]
pub mod ros2;
#[cfg(feature = "zenoh")]
pub mod serve;
pub mod view;
