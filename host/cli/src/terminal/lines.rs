//! Plain text output: one line for each event, one summary per second of board time. No control codes.

use crate::watch::narrate::{Narrator, seconds};
use anyhow::Result;
use std::io::Write;
use taxel::client::{Client, Event};
use taxel::session::Show;
use taxel::source::Source;
use taxel_core::format::Micros;

/// Prints lines.
pub struct Lines<W> {
    label: String,
    narrator: Narrator,
    out: W,
    /// Time and frame number of the last summary.
    summed: Option<(Micros, u32)>,
}

impl<W: Write> Lines<W> {
    /// Output for a source.
    pub fn new(source: &Source, out: W) -> Lines<W> {
        Lines {
            label: source.label.clone(),
            narrator: Narrator::new(source.counts_per_newton),
            out,
            summed: None,
        }
    }

    /// What it writes to.
    pub fn output(&mut self) -> &mut W {
        &mut self.out
    }

    fn summary(&mut self, client: &Client, frame: u32, time: Micros) -> Result<()> {
        let (last, first) = *self.summed.get_or_insert((time, frame));
        let passed = time.since(last);
        if passed < 1_000_000 {
            return Ok(());
        }
        self.summed = Some((time, frame));
        let (counts, contacts) = (client.counts(), client.contacts().len());
        let rate = f64::from(frame.wrapping_sub(first)) * 1e6 / passed as f64;
        let leading = client.leading().as_str();
        Ok(writeln!(
            self.out,
            "{} {rate:.1} frames/s, {} lost, {} thinned, {} refused; contacts: {contacts}, intention: {leading}",
            seconds(time),
            counts.lost,
            counts.thinned,
            counts.refused()
        )?)
    }
}

impl<W: Write> Show<anyhow::Error> for Lines<W> {
    fn event(&mut self, client: &Client, event: &Event) -> Result<()> {
        if let Event::Frame { frame, time, .. } = event {
            return self.summary(client, *frame, *time);
        }
        for line in self.narrator.tell(client, event) {
            writeln!(self.out, "{line}")?;
        }
        if *event == Event::Hello {
            writeln!(self.out, "          from {}", self.label)?;
        }
        Ok(())
    }

    fn follows_another(&self) -> bool {
        true
    }

    fn tells_remarks(&self) -> bool {
        true
    }

    fn idle(&mut self, _: &mut Client) -> Result<bool> {
        self.out.flush()?;
        Ok(true)
    }

    fn end(&mut self, client: &Client) -> Result<()> {
        write!(self.out, "{}", total(client))?;
        Ok(self.out.flush()?)
    }
}

/// Returns the totals.
pub(super) fn total(client: &Client) -> String {
    let counts = client.counts();
    let mut text = format!(
        "end: {} frames, {} messages, {} bytes; {} lost, {} thinned, {} refused\n",
        counts.frames,
        counts.messages,
        counts.bytes,
        counts.lost,
        counts.thinned,
        counts.refused()
    );
    for (kind, count) in counts.refused_by_kind() {
        text += &format!("     refused {count} times: {kind}\n");
    }
    text
}
