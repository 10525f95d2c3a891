//! The joints' angles that a recording holds.

use crate::error::{LearnError, Result};
use crate::recording::{BoardRecording, Messages};
use serde::Deserialize;
use std::collections::BTreeMap;

/// Topic of the postures that were sent to the board.
const POSTURE: &str = "/taxel/posture";

/// Angles in the order in which the board was told them.
#[derive(Debug, Clone, Default)]
pub struct Angles {
    /// The board's time, us; joint; degrees.
    told: Vec<(u64, String, f32)>,
    /// Names of the joints.
    joints: Vec<String>,
}

#[derive(Deserialize)]
struct ToldAngles {
    time_us: u64,
    joints: Vec<ToldAngle>,
}

#[derive(Deserialize)]
struct ToldAngle {
    joint: String,
    degrees: f32,
}

impl Angles {
    /// Reads those of a recording. Error if it holds none.
    pub fn read(recording: &BoardRecording) -> Result<Angles> {
        let mut angles = Angles::default();
        let mut messages = Messages::of_topic(&recording.path, &recording.topic(POSTURE))?;
        while let Some(message) = messages.next_message()? {
            let told: ToldAngles = serde_json::from_slice(message.data).map_err(|error| {
                error!(LearnError::Data, "{recording}: a message of {POSTURE} is damaged: {error}")
            })?;
            let all = told.joints.into_iter().map(|it| (told.time_us, it.joint, it.degrees));
            angles.told.extend(all);
        }
        require!(
            !angles.told.is_empty(),
            LearnError::Data,
            "{recording}: no angles of joints in it: tell the board its posture while you record"
        );
        angles.told.sort_by_key(|(time, ..)| *time);
        angles.joints = angles.told.iter().map(|(_, joint, _)| joint.clone()).collect();
        angles.joints.sort();
        angles.joints.dedup();
        Ok(angles)
    }

    /// Names of the joints.
    pub fn joints(&self) -> &[String] {
        &self.joints
    }

    /// Angle of each joint as last told by a time of the board, us, and when the last one was told.
    pub fn at(&self, time_us: u64) -> (BTreeMap<String, f32>, Option<u64>) {
        let told = &self.told[..self.told.partition_point(|(at, ..)| *at <= time_us)];
        let mut angles = BTreeMap::new();
        for (_, joint, degrees) in told.iter().rev() {
            if angles.len() == self.joints.len() {
                break;
            }
            angles.entry(joint.clone()).or_insert(*degrees);
        }
        (angles, told.last().map(|(at, ..)| *at))
    }

    /// All angles by the board's time, us: joint, degrees.
    pub fn all(&self) -> impl Iterator<Item = (u64, &str, f32)> {
        self.told.iter().map(|(time, joint, degrees)| (*time, joint.as_str(), *degrees))
    }
}
