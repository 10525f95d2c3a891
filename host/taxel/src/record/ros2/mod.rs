//! ROS 2 messages of a board's stream, in a file beside the recording (`NAME.ros2.mcap`), so that `ros2 bag
//! play` and RViz read them without a node of ours.
//!
//! | topic | message | what |
//! |---|---|---|
//! | `/tactile/PANEL/image` | sensor_msgs/Image, mono16 | pressure, counts |
//! | `/tactile/PANEL/points` | sensor_msgs/PointCloud2 | x, y, z in m on the panel, pressure in counts; if the pitch is known |
//! | `/tactile/PANEL/wrench` | geometry_msgs/WrenchStamped | sum of the normal forces, N; if counts per newton are known |
//! | `/tf_static` | tf2_msgs/TFMessage | the frame of each panel on its link; panels of one link side by side |
//! | `/diagnostics` | diagnostic_msgs/DiagnosticArray | the board's counters, each second |
//!
//! The frame of a panel's messages is `tactile/PANEL`, whose parent is its link. Stamps are the host's time.

mod cdr;
mod channels;
mod messages;
mod schemas;

pub use channels::Ros2;
