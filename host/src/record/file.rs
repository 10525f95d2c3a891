//! One file of a recording: its channels, and messages as they go into them.

use super::ros2::Ros2;
use super::stamps::Stamp;
use super::topics::{self, Topics};
use crate::client::{Client, Event, ImageNews};
use crate::live;
use crate::recording::{Store, Writer};
use anyhow::Result;
use serde::Serialize;
use serde_json::{Value, json};
use taxel_core::fold::Posture;

/// Nanoseconds of a microsecond.
pub const NS: u64 = 1000;

/// One file.
#[derive(Debug)]
pub struct RecordingFile<S: Store> {
    /// What is written to.
    pub writer: Writer<S>,
    topics: Topics,
    ros2: Option<Ros2<S>>,
}

impl<S: Store> RecordingFile<S> {
    /// Begins a file, and another one beside it for ROS 2's messages.
    pub fn create(store: S, ros2: Option<S>) -> Result<RecordingFile<S>> {
        let mut writer = Writer::create(store, "")?;
        Ok(RecordingFile {
            topics: Topics::open(&mut writer)?,
            writer,
            ros2: ros2.map(Ros2::create).transpose()?,
        })
    }

    /// A frame of the wire from the board.
    pub fn wire(&mut self, stamp: Stamp, bytes: &[u8]) -> Result<()> {
        self.writer.message(self.topics.wire, stamp.host_us * NS, stamp.board_us * NS, bytes)
    }

    /// Frames of the wire to the board.
    pub fn requests(&mut self, stamp: Stamp, bytes: &[u8]) -> Result<()> {
        self.writer.message(self.topics.requests, stamp.host_us * NS, stamp.board_us * NS, bytes)
    }

    /// A posture that was told the board; `names` are the scene's joints.
    pub fn posture(
        &mut self,
        stamp: Stamp,
        posture: &Posture,
        names: &[taxel_core::format::Name],
    ) -> Result<()> {
        let joint = |told: &taxel_core::fold::JointAngle| {
            let name = names.get(usize::from(told.joint)).map_or("", |name| name.as_str());
            json!({ "joint": name, "degrees": f64::from(told.centidegrees) / 100.0 })
        };
        let joints: Vec<_> = posture.joints.iter().map(joint).collect();
        self.json("posture", stamp, json!({ "type": "posture", "time_us": stamp.board_us, "joints": joints }))
    }

    /// What an event says, as JSON and, where asked for, as ROS 2's messages.
    pub fn event(&mut self, client: &Client, event: &Event, stamp: Stamp, scale: Option<f32>) -> Result<()> {
        if let Some(ros2) = &mut self.ros2 {
            ros2.event(client, event, stamp, scale)?;
        }
        let Some(topic) = topics::of(event) else { return Ok(()) };
        if let Event::Frame { frame, alone, image, .. } = event {
            let decoded = *image == ImageNews::Whole;
            let panels = if decoded { panels(client) } else { Vec::new() };
            return self.serialized(
                topic,
                stamp,
                &FrameMessage {
                    kind: "frame",
                    frame: *frame,
                    time_us: stamp.board_us,
                    host_time_us: stamp.host_us,
                    host_time_uncertainty_us: stamp.uncertainty_us,
                    key: *alone,
                    decoded,
                    lost: client.counts().lost,
                    thinned: client.counts().thinned,
                    total: panels.iter().map(|panel| panel.total).sum(),
                    panels,
                },
            );
        }
        self.json(topic, stamp, live::message(client, event))
    }

    fn json(&mut self, topic: &str, stamp: Stamp, mut message: Value) -> Result<()> {
        message["host_time_us"] = json!(stamp.host_us);
        if let Some(uncertainty) = stamp.uncertainty_us {
            message["host_time_uncertainty_us"] = json!(uncertainty);
        }
        self.serialized(topic, stamp, &message)
    }

    fn serialized(&mut self, topic: &str, stamp: Stamp, message: &impl Serialize) -> Result<()> {
        let Some(channel) = self.topics.json(topic) else { return Ok(()) };
        let bytes = serde_json::to_vec(message)?;
        self.writer.message(channel, stamp.host_us * NS, stamp.board_us * NS, &bytes)
    }

    /// Ends the chunk.
    pub fn close(&mut self) -> Result<()> {
        self.writer.close()?;
        self.ros2.as_mut().map_or(Ok(()), |ros2| ros2.writer.close())
    }

    /// Writes what came so far through to the disk.
    pub fn flush(&mut self) -> Result<()> {
        self.writer.flush()?;
        self.ros2.as_mut().map_or(Ok(()), |ros2| ros2.writer.flush())
    }

    /// Bytes so far.
    pub fn bytes(&self) -> u64 {
        self.writer.bytes() + self.ros2.as_ref().map_or(0, |ros2| ros2.writer.bytes())
    }

    /// Writes the end; of both files, even where the one fails. Their bytes.
    pub fn finish(self) -> Result<u64> {
        let beside = self.ros2.map_or(Ok(0), |ros2| ros2.writer.finish());
        Ok(self.writer.finish()? + beside?)
    }
}

/// A frame with the pressure of every taxel; contacts and intention have topics of their own.
#[derive(Debug, Serialize)]
struct FrameMessage<'a> {
    #[serde(rename = "type")]
    kind: &'static str,
    frame: u32,
    time_us: u64,
    host_time_us: u64,
    #[serde(skip_serializing_if = "Option::is_none")]
    host_time_uncertainty_us: Option<u64>,
    key: bool,
    decoded: bool,
    lost: u64,
    thinned: u64,
    /// Sum over the garment, counts.
    total: u32,
    panels: Vec<PanelImage<'a>>,
}

/// The pressure on a panel, row by row.
#[derive(Debug, Serialize)]
struct PanelImage<'a> {
    name: &'a str,
    total: u32,
    rows: Vec<&'a [u16]>,
}

/// The panels of the last image.
fn panels(client: &Client) -> Vec<PanelImage<'_>> {
    let (Some(layout), Some((_, image))) = (client.layout(), client.image()) else { return Vec::new() };
    let each = layout.areas().iter().map(|area| {
        let start = usize::from(area.base);
        let columns = usize::from(area.columns);
        let values = image.get(start..start + usize::from(area.rows) * columns).unwrap_or(&[]);
        let total = values.iter().map(|value| u32::from(*value)).sum();
        // A panel that has taxels has columns.
        PanelImage { name: area.name.as_str(), total, rows: values.chunks(columns.max(1)).collect() }
    });
    each.collect()
}
