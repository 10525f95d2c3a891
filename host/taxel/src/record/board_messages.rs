//! The messages of a board, encoded where the chunks of a recording are filled.

use super::message::{self, JointLine, JointsLine, LinkPoseLine, PosesLine, PostureLine};
use super::raw_image;
use super::topics::{self, RecordTopic, Topics};
use crate::client::{Client, Event, ImageNews, Stamp};
use crate::error::Result;
use crate::recording::{Filler, FullChunk};
use crate::session::JointPositions;
use crate::source::array::OriginalBytes;
use serde::Serialize;
use taxel_core::fold::{JointAngle, Posture};
use taxel_core::format::Name;
use taxel_core::surface::LinkPose;
use taxel_core::wire::{self, Poses, Request};

/// The messages of a board in a recording: its topics, and the chunks that they fill.
#[derive(Debug)]
pub struct BoardMessages {
    topics: Topics,
    /// The wire, JSON and images, each in chunks of its own: whoever reads one passes over the others, and like packs
    /// best with like.
    fillers: [Filler; 3],
}

impl BoardMessages {
    /// None yet, for these topics.
    pub fn new(topics: Topics) -> BoardMessages {
        BoardMessages { topics, fillers: Default::default() }
    }

    /// Ends the chunk: readers can seek to the next one.
    pub fn close(&mut self) {
        self.fillers.iter_mut().for_each(Filler::close);
    }

    /// True if a chunk is filled.
    pub fn is_ready(&self) -> bool {
        self.fillers.iter().any(Filler::is_ready)
    }

    /// Takes the chunks that are filled, those of the wire first, to be [written](crate::recording::Writer::write).
    pub fn take(&mut self) -> Vec<FullChunk> {
        self.fillers.iter_mut().flat_map(Filler::take).collect()
    }

    /// Adds the frames of the wire of the client's last event.
    pub fn frames(&mut self, client: &Client, stamp: Stamp) -> Result<()> {
        client.lines().try_for_each(|line| self.wire(stamp, line))
    }

    /// Adds a frame of the wire from the board.
    pub fn wire(&mut self, stamp: Stamp, frame: &[u8]) -> Result<()> {
        self.add_bytes(RecordTopic::Wire, stamp, frame)
    }

    /// Adds an event as JSON, unless it is only on the wire, and its image.
    pub fn event(&mut self, client: &Client, event: &Event, stamp: Stamp) -> Result<()> {
        let Some(topic) = topics::of(event) else { return Ok(()) };
        self.add(RecordTopic::Json(topic), stamp, |out| message::append(client, event, stamp, out))?;
        if !matches!(event, Event::Frame { image: ImageNews::Whole, .. }) {
            return Ok(());
        }
        self.add(RecordTopic::Image, stamp, |out| {
            raw_image::append(client, stamp, out);
            Ok(())
        })
    }

    /// Adds frames of the wire to the board, and as JSON what they say of the robot's posture.
    pub fn requests(&mut self, client: &Client, bytes: &[u8], stamp: Stamp) -> Result<()> {
        self.add_bytes(RecordTopic::Requests, stamp, bytes)?;
        for frame in bytes.split(|byte| *byte == 0) {
            let mut frame = frame.to_vec();
            match wire::open(&mut frame).and_then(wire::decode::<Request<'_>>) {
                Ok(Request::Posture(posture)) => {
                    // Before the board has sent its scene, nobody knows which joints these are.
                    let description = client.description();
                    description.map_or(Ok(()), |description| {
                        self.posture(&posture, &description.scene.joints, stamp)
                    })?;
                }
                // What cannot be decoded are a program's own bytes, which the board refuses.
                Ok(Request::SetPoses(poses)) => {
                    let reported = wire::decode::<Poses>(poses).ok();
                    reported.map_or(Ok(()), |poses| self.poses(&poses.links, stamp))?;
                }
                _ => {}
            }
        }
        Ok(())
    }

    /// Adds the bytes of an array.
    pub fn original(&mut self, original: &OriginalBytes, stamp: Stamp) -> Result<()> {
        self.add_bytes(RecordTopic::Original, stamp, &original.message())
    }

    /// Adds positions of joints; the stamp is that of their reading.
    pub fn joints(&mut self, joints: &JointPositions, stamp: Stamp) -> Result<()> {
        let positions = joints.positions.iter().map(|(name, at)| (name.as_str(), *at)).collect();
        self.add_line("joints", stamp, JointsLine { time_us: joints.time.0, positions })
    }

    /// Adds poses sent to the board.
    fn poses(&mut self, poses: &[LinkPose], stamp: Stamp) -> Result<()> {
        let links = poses.iter().map(|(name, pose, _)| LinkPoseLine {
            link: name.as_str(),
            at_m: pose.at.map(|um| f64::from(um) * 1e-6),
            turn: pose.turn.map(|part| f64::from(part) / f64::from(1 << 30)),
        });
        self.add_line("poses", stamp, PosesLine { time_us: stamp.board_us, links: links.collect() })
    }

    /// Adds a posture sent to the board; `names` are the scene's joints.
    fn posture(&mut self, posture: &Posture, names: &[Name], stamp: Stamp) -> Result<()> {
        let joint = |reported: &JointAngle| {
            let name = names.get(usize::from(reported.joint)).map_or("", |name| name.as_str());
            JointLine { joint: name, degrees: f64::from(reported.centidegrees) / 100.0 }
        };
        let joints = posture.joints.iter().map(joint).collect();
        self.add_line("posture", stamp, PostureLine { time_us: stamp.board_us, joints })
    }

    fn add_line(&mut self, topic: &'static str, stamp: Stamp, line: impl Serialize) -> Result<()> {
        self.add(RecordTopic::Json(topic), stamp, |out| message::append_line(line, stamp, out))
    }

    fn add_bytes(&mut self, topic: RecordTopic, stamp: Stamp, bytes: &[u8]) -> Result<()> {
        self.add(topic, stamp, |out| {
            out.extend_from_slice(bytes);
            Ok(())
        })
    }

    fn add(
        &mut self,
        topic: RecordTopic,
        stamp: Stamp,
        data: impl FnOnce(&mut Vec<u8>) -> Result<()>,
    ) -> Result<()> {
        let Some(channel) = self.topics.channel(topic) else { return Ok(()) };
        let [wire, json, images] = &mut self.fillers;
        let filler = match topic {
            RecordTopic::Image | RecordTopic::Original => images,
            // Gaps are between frames of the wire.
            RecordTopic::Wire | RecordTopic::Requests | RecordTopic::Json("lost" | "back") => wire,
            RecordTopic::Json(_) => json,
        };
        filler.message(channel, stamp.host_ns(), stamp.board_ns(), data)
    }
}
