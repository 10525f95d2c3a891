//! The joints' angles that a recording holds.

use crate::error::{LearnError, Result};
use crate::recording::{BoardRecording, Messages};
use serde::Deserialize;
use std::collections::BTreeMap;

/// Topic of the postures that were sent to the board.
const POSTURE: &str = "/taxel/posture";

/// Angles in the order in which the board was sent them.
#[derive(Debug, Clone, Default)]
pub struct Angles {
    /// The board's time, us; joint; degrees.
    sent: Vec<(u64, String, f32)>,
    /// Names of the joints.
    joints: Vec<String>,
}

#[derive(Deserialize)]
struct RecordedAngles {
    time_us: u64,
    joints: Vec<RecordedAngle>,
}

#[derive(Deserialize)]
struct RecordedAngle {
    joint: String,
    degrees: f32,
}

impl Angles {
    /// Reads those of a recording. Error if it holds none.
    pub fn read(recording: &BoardRecording) -> Result<Angles> {
        let mut angles = Angles::default();
        let mut messages = Messages::of_topic(&recording.path, &recording.topic(POSTURE))?;
        while let Some(message) = messages.next_message()? {
            let sent: RecordedAngles = serde_json::from_slice(message.data).map_err(|error| {
                error!(LearnError::Data, "{recording}: a message of {POSTURE} is damaged: {error}")
            })?;
            let all = sent.joints.into_iter().map(|it| (sent.time_us, it.joint, it.degrees));
            angles.sent.extend(all);
        }
        require!(
            !angles.sent.is_empty(),
            LearnError::Data,
            "{recording}: no angles of joints in it: send the board its posture while you record"
        );
        angles.sent.sort_by_key(|(time, ..)| *time);
        angles.joints = angles.sent.iter().map(|(_, joint, _)| joint.clone()).collect();
        angles.joints.sort();
        angles.joints.dedup();
        Ok(angles)
    }

    /// Names of the joints.
    pub fn joints(&self) -> &[String] {
        &self.joints
    }

    /// Angle of each joint as last sent by a time of the board, us, and when the last one was sent.
    pub fn at(&self, time_us: u64) -> (BTreeMap<String, f32>, Option<u64>) {
        let sent = &self.sent[..self.sent.partition_point(|(at, ..)| *at <= time_us)];
        let mut angles = BTreeMap::new();
        for (_, joint, degrees) in sent.iter().rev() {
            if angles.len() == self.joints.len() {
                break;
            }
            angles.entry(joint.clone()).or_insert(*degrees);
        }
        (angles, sent.last().map(|(at, ..)| *at))
    }

    /// All angles by the board's time, us: joint, degrees.
    pub fn all(&self) -> impl Iterator<Item = (u64, &str, f32)> {
        self.sent.iter().map(|(time, joint, degrees)| (*time, joint.as_str(), *degrees))
    }
}
