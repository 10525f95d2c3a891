//! Records a board's stream to a file for Foxglove, Rerun, Python and ROS 2.
//!
//! Log time is the host's time of a message's subject, publish time the board's; JSON messages hold both
//! (`host_time_us`, `time_us`).
//!
//! | topic | encoding | what |
//! |---|---|---|
//! | `/taxel/wire` | `taxel-wire` | each frame of the wire as it came: COBS of postcard and CRC-32, then 0x00 |
//! | `/taxel/requests` | `taxel-wire` | what the host asked, the same way |
//! | `/taxel/original` | `taxel-original` | the bytes of an array of others, as they came |
//! | `/taxel/image` | `protobuf` | foxglove.RawImage, mono16: the pressure of every taxel, counts; the panels side by side |
//! | `/taxel/hello`, `frames`, `contacts`, `symbols`, `intent`, `reactions`, `health`, `health_map`, `budget`, `temperature`, `gestures`, `self_test`, `posture`, `log`, `pressing`, `joints`, `poses` | `json` | the lines of `taxel live --json`, with a schema; contacts without what follows from other keys, frames without what other topics hold |
//! | in `NAME.ros2.mcap`, with `--ros2`: `/tactile/PANEL/image`, `points`, `wrench`, `/tactile/links/LINK/wrench`, `/tf_static`, `/diagnostics` | `cdr` | sensor_msgs Image and PointCloud2, geometry_msgs WrenchStamped, diagnostic_msgs DiagnosticArray |
//!
//! Attachments: `hello.taxel-wire` (the frame of the board's `Hello`), `garment.toml`, `scene.json`,
//! `geometry.json` and, if given to the recorder and in use by the board, `calibration.toml`. Metadata
//! `taxel` names versions, host, board and source, and who calibrated when, how and how well.

mod angles;
mod board_messages;
mod board_recorder;
mod contacts_message;
mod counters;
mod file;
mod limit;
mod message;
mod names;
mod plan;
mod play;
mod protobuf;
mod provenance;
mod raw_image;
mod recorded_board;
mod recorded_contact;
mod recorder;
mod recording;
mod recording_files;
mod robot_topic;
mod ros2_messages;
mod schemas;
mod tally;
mod topics;

pub use angles::Angles;
pub use board_messages::BoardMessages;
pub use board_recorder::BoardRecorder;
pub use file::{BoardPart, RecordingFile};
pub use limit::Rotate;
pub use message::json_message;
pub use plan::{Plan, PlannedBoard, PlannedRobot};
pub use play::Play;
pub use provenance::{Origin, attach};
pub use raw_image::{PROTOBUF, RAW_IMAGE, append as append_image, schema as image_schema};
pub use recorder::Recorder;
pub use robot_topic::RobotTopic;
#[cfg(feature = "schema")]
pub use schemas::derived;
pub use schemas::{JSON as TOPICS, JsonTopic};
pub use tally::{COUNTS, Tally};
pub use topics::{IMAGE, REQUESTS, RecordTopic, Topics, of as topic};
