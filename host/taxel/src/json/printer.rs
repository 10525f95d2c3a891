//! JSON output: one message per line, each with its `type`.
//!
//! For a real-time board (serial port, TCP) a line also has `host_time_us`, the host's time of the message in
//! microseconds since 1970, and `host_time_uncertainty_us`, the bound of its error, once the board has
//! answered a `Sync`. Nothing else in a line depends on the host's time.

use super::lines::{JsonLine, PanelPixels};
use super::messages::line;
use crate::client::{Client, Event, ImageNews, Stamp};
use crate::error::Result;
use crate::session::Observer;
use serde_json::{Value, json};
use std::io::Write;
use taxel_core::format::Micros;

/// Prints messages as JSON.
pub struct MessagePrinter<W> {
    pixels: bool,
    out: W,
}

impl<W: Write> MessagePrinter<W> {
    /// Output with or without the pressure of every taxel.
    pub fn new(pixels: bool, out: W) -> MessagePrinter<W> {
        MessagePrinter { pixels, out }
    }

    /// The message of an event, with the host's time if it is known.
    pub fn message(&self, client: &Client, event: &Event) -> Result<Value> {
        let mut line = line(client, event);
        if let (Some(JsonLine::Frame(frame)), Event::Frame { image: ImageNews::Whole, .. }) =
            (&mut line, event)
        {
            frame.panels = self.pixels.then(|| pixels(client));
        }
        let mut line = serde_json::to_value(line)?;
        let board = line.get("time_us").and_then(Value::as_u64);
        if let Some(time) = board.and_then(|board| client.host_time(Micros(board))) {
            line["host_time_us"] = json!(time.us);
            line["host_time_uncertainty_us"] = json!(time.uncertainty_us);
        }
        Ok(line)
    }
}

impl<W: Write> Observer for MessagePrinter<W> {
    fn event(&mut self, client: &Client, event: &Event, _: Stamp) -> Result<()> {
        let line = self.message(client, event)?;
        Ok(writeln!(self.out, "{line}")?)
    }

    fn follows_another(&self) -> bool {
        true
    }

    fn idle(&mut self, _: &mut Client) -> Result<()> {
        Ok(self.out.flush()?)
    }

    fn ended(&mut self, _: &Client, _: Stamp) -> Result<()> {
        Ok(self.out.flush()?)
    }
}

/// Pressures of the image by panel and row.
fn pixels(client: &Client) -> Vec<PanelPixels<'_>> {
    let (Some(layout), Some((_, image))) = (client.layout(), client.image()) else { return Vec::new() };
    let panels = layout.areas().iter().map(|area| {
        let start = usize::from(area.base);
        let columns = usize::from(area.columns);
        let values = image.get(start..start + usize::from(area.rows) * columns).unwrap_or(&[]);
        // A panel with taxels has columns.
        PanelPixels { name: area.name.as_str(), rows: values.chunks(columns.max(1)).collect() }
    });
    panels.collect()
}
