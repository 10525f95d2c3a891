//! Events as JSON messages.

use super::stamps::Stamp;
use crate::client::{Client, Event, ImageNews};
use crate::error::Result;
use crate::json;
use serde::Serialize;
use serde_json::{Value, json};

/// Encodes an event as JSON with its times.
pub fn json_message(client: &Client, event: &Event, stamp: Stamp) -> Result<Vec<u8>> {
    let Event::Frame { frame, alone, image, .. } = event else {
        return with_times(json::message(client, event), stamp);
    };
    let decoded = *image == ImageNews::Whole;
    let panels = if decoded { panels(client) } else { Vec::new() };
    Ok(serde_json::to_vec(&FrameMessage {
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
    })?)
}

/// Encodes a message with the host's time.
pub fn with_times(mut message: Value, stamp: Stamp) -> Result<Vec<u8>> {
    message["host_time_us"] = json!(stamp.host_us);
    if let Some(uncertainty) = stamp.uncertainty_us {
        message["host_time_uncertainty_us"] = json!(uncertainty);
    }
    Ok(serde_json::to_vec(&message)?)
}

/// A frame with the pressure of every taxel; contacts and intention have their own topics.
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

/// Pressures of a panel by row.
#[derive(Debug, Serialize)]
struct PanelImage<'a> {
    name: &'a str,
    total: u32,
    rows: Vec<&'a [u16]>,
}

/// Panels of the last image.
fn panels(client: &Client) -> Vec<PanelImage<'_>> {
    let (Some(layout), Some((_, image))) = (client.layout(), client.image()) else { return Vec::new() };
    let each = layout.areas().iter().map(|area| {
        let start = usize::from(area.base);
        let columns = usize::from(area.columns);
        let values = image.get(start..start + usize::from(area.rows) * columns).unwrap_or(&[]);
        let total = values.iter().map(|value| u32::from(*value)).sum();
        // A panel with taxels has columns.
        PanelImage { name: area.name.as_str(), total, rows: values.chunks(columns.max(1)).collect() }
    });
    each.collect()
}
