//! Commands that show a stream.

#[cfg(feature = "foxglove")]
pub mod foxglove;
pub mod live;
#[cfg(not(all(feature = "foxglove", feature = "ros2", feature = "zenoh")))]
mod not_built;
#[cfg(feature = "ros2")]
pub mod ros2;
#[cfg(feature = "zenoh")]
pub mod serve;
pub mod view;

#[cfg(not(feature = "foxglove"))]
pub use not_built::foxglove;
#[cfg(not(feature = "ros2"))]
pub use not_built::ros2;
#[cfg(not(feature = "zenoh"))]
pub use not_built::serve;
