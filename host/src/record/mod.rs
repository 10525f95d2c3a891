//! `taxel record`: what a board tells, kept in a file that Foxglove, Rerun, Python and ROS 2 read.
//!
//! Log time is the host's time of what a message tells of, publish time the board's; both are in the JSON
//! messages, too (`host_time_us`, `time_us`).
//!
//! | topic | encoding | what |
//! |---|---|---|
//! | `/taxel/wire` | `taxel-wire` | each frame of the wire as it came: COBS of postcard and CRC-32, then 0x00 |
//! | `/taxel/requests` | `taxel-wire` | what the host asked, the same way |
//! | `/taxel/hello`, `frames`, `contacts`, `symbols`, `intent`, `reactions`, `health`, `health_map`, `budget`, `temperature`, `gestures`, `self_test`, `posture`, `log` | `json` | the lines of `taxel live --json`, with a schema |
//! | in `NAME.ros2.mcap`, with `--ros2`: `/tactile/PANEL/image`, `points`, `wrench`, `/tf_static`, `/diagnostics` | `cdr` | sensor_msgs Image and PointCloud2, geometry_msgs WrenchStamped, diagnostic_msgs DiagnosticArray |
//!
//! Attached are `hello.taxel-wire` (the frame with which the board said what it is), `garment.toml`,
//! `scene.json`, `geometry.json` and, where the recorder was given it and the board says that it is in force,
//! `calibration.toml`; metadata `taxel` names versions, host, board, source and who calibrated when, how and
//! how well.

mod command;
mod file;
mod limit;
mod message;
mod names;
mod play;
mod progress;
mod provenance;
mod recorder;
mod ros2;
mod schemas;
mod stamps;
mod standing;
mod tally;
mod topics;
mod wire_reader;

pub use command::{RecordArgs, run};
pub use file::RecordingFile;
pub use limit::Rotate;
pub use message::json_message;
pub use play::Play;
pub use provenance::{CALIBRATION, HELLO, Origin};
pub use recorder::{Plan, Recorder};
pub use stamps::{NS, Stamp, Stamps, time_of};
pub use standing::{lost, renumbered, sequence};
pub use tally::{COUNTS, Tally};
pub use topics::{JSON as TOPICS, JsonTopic, REQUESTS, WIRE, of as topic};
pub use wire_reader::WireReader;
