//! JSON output: one message per line, each with its `type`.
//!
//! For a real-time board (serial port, TCP) a line also has `host_time_us`, the host's time of the message in
//! microseconds since 1970, and `host_time_uncertainty_us`, the bound of its error, once the board has
//! answered a `Sync`. Nothing else in a line depends on the host's time.

use super::lines::{FrameLine, JsonLine, PanelPixels};
use super::messages::line;
use crate::client::{Client, Event, ImageNews, Stamp};
use crate::error::Result;
use crate::files::calibrate::{Calibration, Forces};
use crate::session::Observer;
use serde_json::{Value, json};
use std::io::Write;
use taxel_core::body::Placed;
use taxel_core::format::Micros;

/// Prints messages as JSON.
pub struct MessagePrinter<W> {
    pixels: bool,
    calibration: Option<Calibration>,
    out: W,
}

impl<W: Write> MessagePrinter<W> {
    /// Output with or without the pressure of every taxel.
    pub fn new(pixels: bool, out: W) -> MessagePrinter<W> {
        MessagePrinter { pixels, calibration: None, out }
    }

    /// Adds the force on each panel (`force_n`, in the order of `panels`) and of each contact while the board
    /// uses this calibration.
    pub fn calibrated(self, calibration: Option<Calibration>) -> MessagePrinter<W> {
        MessagePrinter { calibration, ..self }
    }

    /// The message of an event, with the host's time if it is known.
    pub fn message(&self, client: &Client, event: &Event) -> Result<Value> {
        let mut line = line(client, event);
        if let (Some(JsonLine::Frame(frame)), Event::Frame { image: ImageNews::Whole, .. }) =
            (&mut line, event)
        {
            self.complete(client, frame);
        }
        let mut line = serde_json::to_value(line)?;
        let board = line.get("time_us").and_then(Value::as_u64);
        if let Some(time) = board.and_then(|board| client.host_time(Micros(board))) {
            line["host_time_us"] = json!(time.us);
            line["host_time_uncertainty_us"] = json!(time.uncertainty_us);
        }
        Ok(line)
    }

    /// Adds what was requested to a frame with an image.
    fn complete<'a>(&self, client: &'a Client, frame: &mut FrameLine<'a>) {
        frame.panels = self.pixels.then(|| pixels(client));
        let forces = self.calibration.as_ref().and_then(|calibration| forces(client, calibration));
        if let Some([panels, contacts]) = forces {
            frame.force_n = Some(panels);
            for (contact, force) in frame.contacts.iter_mut().zip(contacts) {
                contact.force_n = Some(force);
            }
        }
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

/// Forces on each panel and of each contact, N; none if the board uses another calibration.
fn forces(client: &Client, calibration: &Calibration) -> Option<[Vec<Option<f64>>; 2]> {
    let (description, (_, image)) = (client.description()?, client.image()?);
    let meter = Forces::new(calibration, &description.layout)
        .ok()
        .filter(|_| calibration.is_in_force(&description.calibration))?;
    let contact = |placed: &Placed| meter.contact(&description.layout, image, &placed.contact.bounds);
    Some([meter.panels(&description.layout, image), client.contacts().iter().map(contact).collect()])
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
