//! Messages of a recording, encoded before it is known in which file, and for which board, they are written.

use super::message::{self, JointLine, JointsLine, LinkPoseLine, PosesLine, PostureLine};
use super::stamps::Stamp;
use super::topics::{self, RecordTopic};
use crate::client::{Client, Event};
use crate::error::Result;
use crate::session::JointPositions;
use taxel_core::fold::{JointAngle, Posture};
use taxel_core::format::{Micros, Name};
use taxel_core::surface::{LINKS, LinkName, MovingPose, Pose};
use taxel_core::wire::{self, Request};

/// What `SetPoses` holds.
type SentPoses = heapless::Vec<(LinkName, Pose), LINKS>;
/// What `MovePoses` holds beside the time.
type MovingPoses = heapless::Vec<MovingPose, LINKS>;

/// A message.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Encoded {
    /// Where it goes.
    pub topic: RecordTopic,
    /// Its times.
    pub stamp: Stamp,
    /// What it holds.
    pub bytes: Vec<u8>,
}

impl Encoded {
    /// The frames of the wire of the client's last event.
    pub fn frames(client: &Client, stamp: Stamp) -> impl Iterator<Item = Encoded> {
        client.lines().map(move |line| Encoded { topic: RecordTopic::Wire, stamp, bytes: line.to_vec() })
    }

    /// An event as JSON; none if it is only on the wire.
    pub fn event(client: &Client, event: &Event, stamp: Stamp) -> Result<Option<Encoded>> {
        let Some(topic) = topics::of(event) else { return Ok(None) };
        let bytes = message::json_message(client, event, stamp)?;
        Ok(Some(Encoded { topic: RecordTopic::Json(topic), stamp, bytes }))
    }

    /// Frames of the wire to the board, and as JSON what they tell it of the robot's posture.
    pub fn requests(client: &Client, bytes: &[u8], stamp: Stamp) -> Result<Vec<Encoded>> {
        let mut all = vec![Encoded { topic: RecordTopic::Requests, stamp, bytes: bytes.to_vec() }];
        for frame in bytes.split(|byte| *byte == 0) {
            let mut frame = frame.to_vec();
            match wire::open(&mut frame).and_then(wire::decode::<Request<'_>>) {
                Ok(Request::Posture(posture)) => {
                    // Before the board has told its scene, nobody knows which joints these are.
                    let worn = client.worn();
                    all.extend(
                        worn.map(|worn| Encoded::posture(&posture, &worn.scene.joints, stamp)).transpose()?,
                    );
                }
                // What cannot be decoded are a program's own bytes, which the board refuses.
                Ok(Request::SetPoses(poses)) => {
                    let told = wire::decode::<SentPoses>(poses).ok();
                    all.extend(told.map(|poses| Encoded::poses(&poses, stamp)).transpose()?);
                }
                Ok(Request::MovePoses(poses)) => {
                    let told = wire::decode::<(Micros, MovingPoses)>(poses).ok();
                    let poses = told.map(|(_, poses)| poses.into_iter().map(|(link, pose, _)| (link, pose)));
                    let poses = poses.map(Iterator::collect::<Vec<_>>);
                    all.extend(poses.map(|poses| Encoded::poses(&poses, stamp)).transpose()?);
                }
                _ => {}
            }
        }
        Ok(all)
    }

    /// Positions of joints; the stamp is that of their reading.
    pub fn joints(joints: &JointPositions, stamp: Stamp) -> Result<Encoded> {
        let positions = joints.positions.iter().map(|(name, at)| (name.as_str(), *at)).collect();
        let line = JointsLine { time_us: joints.time.0, positions };
        Ok(Encoded { topic: RecordTopic::Json("joints"), stamp, bytes: message::with_times(line, stamp)? })
    }

    /// Poses sent to the board.
    fn poses(poses: &[(LinkName, Pose)], stamp: Stamp) -> Result<Encoded> {
        let links = poses.iter().map(|(name, pose)| LinkPoseLine {
            link: name.as_str(),
            at_m: pose.at.map(|um| f64::from(um) * 1e-6),
            turn: pose.turn.map(|part| f64::from(part) / f64::from(1 << 30)),
        });
        let line = PosesLine { time_us: stamp.board_us, links: links.collect() };
        Ok(Encoded { topic: RecordTopic::Json("poses"), stamp, bytes: message::with_times(line, stamp)? })
    }

    /// A posture sent to the board; `names` are the scene's joints.
    fn posture(posture: &Posture, names: &[Name], stamp: Stamp) -> Result<Encoded> {
        let joint = |told: &JointAngle| {
            let name = names.get(usize::from(told.joint)).map_or("", |name| name.as_str());
            JointLine { joint: name, degrees: f64::from(told.centidegrees) / 100.0 }
        };
        let joints = posture.joints.iter().map(joint).collect();
        let line = PostureLine { time_us: stamp.board_us, joints };
        Ok(Encoded { topic: RecordTopic::Json("posture"), stamp, bytes: message::with_times(line, stamp)? })
    }
}
