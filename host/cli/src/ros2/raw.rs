//! Messages as they go over the wire.

use ros2_client::Message;
use serde::ser::SerializeTuple;
use serde::{Deserialize, Serialize, Serializer};

/// Bytes of CDR before the message, which the middleware writes itself.
const HEAD: usize = 4;

/// An encoded message.
#[derive(Debug, Clone)]
pub struct Encoded(Vec<u8>);

impl Encoded {
    /// A message of [`Cdr`](taxel::ros2::Cdr), with its header.
    pub fn new(cdr: Vec<u8>) -> Encoded {
        Encoded(cdr)
    }
}

impl Serialize for Encoded {
    /// The bytes one by one: a tuple of bytes is written without a length and without gaps. Their number is a
    /// multiple of four: of a large message the middleware writes a wrong length otherwise.
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let bytes = self.0.get(HEAD..).unwrap_or_default();
        let length = bytes.len().next_multiple_of(4);
        let mut tuple = serializer.serialize_tuple(length)?;
        for byte in bytes.iter().chain(&[0; 3]).take(length) {
            tuple.serialize_element(byte)?;
        }
        tuple.end()
    }
}

/// `std_msgs/Header`
#[derive(Debug, Clone, Default, PartialEq, Deserialize)]
pub struct RosHeader {
    /// Seconds and nanoseconds.
    pub stamp: (i32, u32),
    /// Frame.
    pub frame_id: String,
}

/// `sensor_msgs/JointState`
#[derive(Debug, Clone, Default, PartialEq, Deserialize)]
pub struct JointState {
    /// Time of the measurement.
    pub header: RosHeader,
    /// Names of the joints.
    pub name: Vec<String>,
    /// Their positions, rad or m.
    pub position: Vec<f64>,
    /// Their velocities.
    pub velocity: Vec<f64>,
    /// Their forces or torques.
    pub effort: Vec<f64>,
}

/// Request of `std_srvs/Trigger`: ROS fills an empty structure with a byte.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub struct Triggered {
    /// Always 0.
    pub filler: u8,
}

/// Request of `taxel_msgs/SetScene`.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub struct SceneAsked {
    /// Path or text.
    pub scene: String,
}

/// Response of `std_srvs/Trigger` and `taxel_msgs/SetScene`.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub struct Done {
    /// True if it was done.
    pub success: bool,
    /// Words on why not, or on what was done.
    pub message: String,
}

impl Message for Triggered {}
impl Message for SceneAsked {}
impl Message for Done {}
