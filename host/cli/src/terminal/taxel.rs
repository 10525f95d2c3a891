//! Prints one taxel over time, to bring up a block, a multiplexer or a line.

use crate::fault::own;
use crate::watch::TaxelPlace;
use serde_json::json;
use std::io::Write;
use taxel::client::{Client, Event, Stamp};
use taxel::session::Observer;
use taxel_core::format::Micros;

/// Prints a taxel: time, raw code if the board sends it, pressure.
pub struct TaxelLines<W> {
    place: TaxelPlace,
    json: bool,
    out: W,
    taxel: usize,
    /// Raw codes have been requested.
    asked: bool,
    /// Raw codes are being received.
    raw: bool,
    /// Frame, time and value of an image whose raw codes are still to come.
    value: Option<(u32, Micros, u16)>,
}

impl<W: Write> TaxelLines<W> {
    /// Output for the taxel at this place.
    pub fn new(place: TaxelPlace, json: bool, out: W) -> TaxelLines<W> {
        TaxelLines { place, json, out, taxel: 0, asked: false, raw: false, value: None }
    }

    fn line(&mut self, frame: u32, time: Micros, code: Option<u16>, value: Option<u16>) -> taxel::Result<()> {
        if self.json {
            let TaxelPlace { panel, row, column } = &self.place;
            let line = json!({
                "type": "taxel", "panel": panel, "row": row, "column": column, "frame": frame, "time_us": time.0,
                "code": code, "value": value,
            });
            return Ok(writeln!(self.out, "{line}")?);
        }
        let word = |number: Option<u16>| number.map_or("-".into(), |n: u16| n.to_string());
        let seconds = time.0 as f64 / 1e6;
        Ok(writeln!(self.out, "{seconds:.6} s  code {}  pressure {}", word(code), word(value))?)
    }

    /// Prints an image whose raw codes did not come in time.
    fn late(&mut self) -> taxel::Result<()> {
        match self.value.take() {
            Some((frame, time, value)) => self.line(frame, time, None, Some(value)),
            None => Ok(()),
        }
    }
}

impl<W: Write> Observer for TaxelLines<W> {
    fn event(&mut self, client: &Client, event: &Event, _: Stamp) -> taxel::Result<()> {
        match event {
            Event::Hello => {
                self.taxel = self.place.taxel(client).map_err(own)?;
                self.raw = client.raw_hz() > 0;
            }
            Event::Frame { frame, time, .. } => {
                self.late()?;
                let Some(value) = client.image().and_then(|(_, image)| image.get(self.taxel)) else {
                    return Ok(());
                };
                self.value = Some((*frame, *time, *value));
                if !self.raw {
                    self.late()?;
                }
            }
            Event::Raw { frame, time, whole: true } => {
                self.raw = true;
                let value = self.value.take_if(|(of, ..)| of == frame).map(|(.., value)| value);
                self.late()?;
                self.line(*frame, *time, client.raw().get(self.taxel).copied(), value)?;
            }
            _ => {}
        }
        Ok(())
    }

    fn idle(&mut self, client: &mut Client) -> taxel::Result<()> {
        self.out.flush()?;
        if client.description().is_some() && !std::mem::replace(&mut self.asked, true) {
            client.request_codes()?;
        }
        Ok(())
    }

    fn ended(&mut self, _: &Client, _: Stamp) -> taxel::Result<()> {
        self.late()?;
        Ok(self.out.flush()?)
    }
}
