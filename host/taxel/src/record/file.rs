//! One file of a recording: its channels, and the messages written to them.

use super::bag::Ros2;
use super::message::{self, JointLine, JointsLine, LinkPoseLine, PosesLine, PostureLine};
use super::provenance::{self, Origin};
use super::stamps::Stamp;
use super::topics::{self, Topics};
use crate::client::{Client, Event, Worn};
use crate::error::Result;
use crate::recording::{HELLO, Store, Writer};
use crate::session::JointPositions;
use taxel_core::fold::Posture;
use taxel_core::format::Name;
use taxel_core::surface::{LinkName, Pose};

/// A file of a recording.
#[derive(Debug)]
pub struct RecordingFile<S: Store> {
    /// Writer of the file.
    pub writer: Writer<S>,
    topics: Topics,
    ros2: Option<Ros2<S>>,
    /// The board's description is attached.
    says_what: bool,
}

impl<S: Store> RecordingFile<S> {
    /// Creates a file, beside another one of ROS 2 messages.
    pub fn create(store: S, ros2: Option<Ros2<S>>) -> Result<RecordingFile<S>> {
        let mut writer = Writer::create(store, "")?;
        Ok(RecordingFile { topics: Topics::open(&mut writer)?, writer, ros2, says_what: false })
    }

    /// Attaches the board's `Hello`, its frame of the wire, and the origin of the stream.
    pub fn attach(&mut self, worn: &Worn, hello: &[u8], origin: &Origin, stamp: Stamp) -> Result<()> {
        let ns = stamp.host_ns();
        if !std::mem::replace(&mut self.says_what, true) {
            self.writer.attach(HELLO, "application/octet-stream", hello, ns)?;
        }
        provenance::attach(&mut self.writer, worn, origin, ns)
    }

    /// Writes a frame of the wire from the board.
    pub fn wire(&mut self, stamp: Stamp, bytes: &[u8]) -> Result<()> {
        self.writer.message(self.topics.wire, stamp.host_ns(), stamp.board_ns(), bytes)
    }

    /// Writes frames of the wire to the board.
    pub fn requests(&mut self, stamp: Stamp, bytes: &[u8]) -> Result<()> {
        self.writer.message(self.topics.requests, stamp.host_ns(), stamp.board_ns(), bytes)
    }

    /// Writes a posture sent to the board; `names` are the scene's joints.
    pub fn posture(&mut self, stamp: Stamp, posture: &Posture, names: &[Name]) -> Result<()> {
        let joint = |told: &taxel_core::fold::JointAngle| {
            let name = names.get(usize::from(told.joint)).map_or("", |name| name.as_str());
            JointLine { joint: name, degrees: f64::from(told.centidegrees) / 100.0 }
        };
        let joints = posture.joints.iter().map(joint).collect();
        let line = PostureLine { time_us: stamp.board_us, joints };
        self.json("posture", stamp, &message::with_times(line, stamp)?)
    }

    /// Writes positions of joints; the stamp is that of their reading.
    pub fn joints(&mut self, stamp: Stamp, joints: &JointPositions) -> Result<()> {
        let positions = joints.positions.iter().map(|(name, at)| (name.as_str(), *at)).collect();
        let line = JointsLine { time_us: joints.time.0, positions };
        self.json("joints", stamp, &message::with_times(line, stamp)?)
    }

    /// Writes poses sent to the board.
    pub fn poses(&mut self, stamp: Stamp, poses: &[(LinkName, Pose)]) -> Result<()> {
        let links = poses.iter().map(|(name, pose)| LinkPoseLine {
            link: name.as_str(),
            at_m: pose.at.map(|um| f64::from(um) * 1e-6),
            turn: pose.turn.map(|part| f64::from(part) / f64::from(1 << 30)),
        });
        let line = PosesLine { time_us: stamp.board_us, links: links.collect() };
        self.json("poses", stamp, &message::with_times(line, stamp)?)
    }

    /// Writes an event as JSON and, if requested, as ROS 2 messages.
    pub fn event(&mut self, client: &Client, event: &Event, stamp: Stamp, scale: Option<f32>) -> Result<()> {
        if let Some(ros2) = &mut self.ros2 {
            ros2.event(client, event, stamp, scale)?;
        }
        let Some(topic) = topics::of(event) else { return Ok(()) };
        self.json(topic, stamp, &message::json_message(client, event, stamp)?)
    }

    fn json(&mut self, topic: &str, stamp: Stamp, bytes: &[u8]) -> Result<()> {
        let Some(channel) = self.topics.json(topic) else { return Ok(()) };
        self.writer.message(channel, stamp.host_ns(), stamp.board_ns(), bytes)
    }

    /// Ends the chunk.
    pub fn close(&mut self) -> Result<()> {
        self.writer.close()?;
        self.ros2.as_mut().map_or(Ok(()), |ros2| ros2.writer.close())
    }

    /// Flushes everything written so far to the disk.
    pub fn flush(&mut self) -> Result<()> {
        self.writer.flush()?;
        self.ros2.as_mut().map_or(Ok(()), |ros2| ros2.writer.flush())
    }

    /// Bytes written so far.
    pub fn bytes(&self) -> u64 {
        self.writer.bytes() + self.ros2.as_ref().map_or(0, |ros2| ros2.writer.bytes())
    }

    /// Writes the end of both files, even if one fails. Returns their bytes.
    pub fn finish(self) -> Result<u64> {
        let beside = self.ros2.map_or(Ok(0), |ros2| ros2.writer.finish());
        Ok(self.writer.finish()? + beside?)
    }
}
