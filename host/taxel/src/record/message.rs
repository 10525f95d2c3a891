//! Events as JSON messages.

use super::contacts_message::ContactsMessage;
use crate::client::{Client, Event, ImageNews, Stamp};
use crate::error::Result;
use crate::json::lines::JsonLine;
#[cfg(feature = "schema")]
use crate::json::schema::TypeIs;
use crate::json::{self, HostTimed, HostTimes};
use serde::Serialize;
use std::collections::BTreeMap;

/// Encodes an event as JSON with its times.
pub fn json_message(client: &Client, event: &Event, stamp: Stamp) -> Result<Vec<u8>> {
    let mut message = Vec::new();
    append(client, event, stamp, &mut message)?;
    Ok(message)
}

/// Appends an event as JSON with its times.
pub fn append(client: &Client, event: &Event, stamp: Stamp, out: &mut Vec<u8>) -> Result<()> {
    if let Event::Frame { frame, alone, image, .. } = event {
        let image = client.image().filter(|_| *image == ImageNews::Whole);
        let frame = FrameMessage {
            frame: *frame,
            time_us: stamp.board_us,
            key: *alone,
            lost: client.counts().lost,
            thinned: client.counts().thinned,
            total: image.map(|(_, values)| values.iter().map(|value| u32::from(*value)).sum()),
        };
        return append_line(frame, stamp, out);
    }
    match json::line(client, event) {
        Some(JsonLine::Contacts(line)) => append_line(ContactsMessage::of(line), stamp, out),
        line => append_line(line, stamp, out),
    }
}

/// Appends a message with the host's time.
pub(crate) fn append_line(line: impl Serialize, stamp: Stamp, out: &mut Vec<u8>) -> Result<()> {
    Ok(serde_json::to_writer(out, &HostTimed { line, times: times(stamp) })?)
}

fn times(stamp: Stamp) -> HostTimes {
    HostTimes { host_time_us: stamp.host_us, host_time_uncertainty_us: stamp.uncertainty_us }
}

/// A frame; its image, its contacts and the intention have their own topics.
#[derive(Debug, Clone, Copy, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = TypeIs("frame")))]
#[serde(tag = "type", rename = "frame")]
pub struct FrameMessage {
    /// Number of the scan.
    frame: u32,
    /// Start of the scan, us of the board.
    time_us: u64,
    /// True for a key frame, which is decoded without the frames before it.
    key: bool,
    /// Messages lost so far.
    lost: u64,
    /// Images left out so far, because the link had no room.
    thinned: u64,
    /// Sum over the garment, counts; absent if the image could not be decoded.
    #[serde(skip_serializing_if = "Option::is_none")]
    total: Option<u32>,
}

/// A posture sent to the board.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = TypeIs("posture")))]
#[serde(tag = "type", rename = "posture")]
pub struct PostureLine<'a> {
    /// The board's time, us.
    pub time_us: u64,
    /// The joints.
    pub joints: Vec<JointLine<'a>>,
}

/// Angle of a joint.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct JointLine<'a> {
    /// Name of the joint in the scene.
    pub joint: &'a str,
    /// Angle, degrees.
    pub degrees: f64,
}

/// Positions of a robot's joints, as they came to the host.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = TypeIs("joints")))]
#[serde(tag = "type", rename = "joints")]
pub struct JointsLine<'a> {
    /// Time at which they were read, us of the board.
    pub time_us: u64,
    /// Position by joint, rad or m.
    pub positions: BTreeMap<&'a str, f64>,
}

/// Poses of the robot's links, sent to the board.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = TypeIs("poses")))]
#[serde(tag = "type", rename = "poses")]
pub struct PosesLine<'a> {
    /// The board's time, us.
    pub time_us: u64,
    /// The links.
    pub links: Vec<LinkPoseLine<'a>>,
}

/// Pose of a link in the base.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct LinkPoseLine<'a> {
    /// Name of the link.
    pub link: &'a str,
    /// Origin of the link, m.
    pub at_m: [f64; 3],
    /// Rotation of the link, a quaternion x, y, z, w.
    pub turn: [f64; 4],
}
