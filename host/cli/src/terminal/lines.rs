//! Plain text output: one line for each event, one summary per second of board time. No control codes.

use crate::watch::narrate::{Narrator, seconds};
use std::io::Write;
use taxel::client::{Client, Event, Stamp};
use taxel::session::Observer;
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
    /// Output for a source, which is reported once it is open.
    pub fn new(out: W) -> Lines<W> {
        Lines { label: String::new(), narrator: Narrator::default(), out, summed: None }
    }

    /// Returns what it writes to.
    pub fn output(&mut self) -> &mut W {
        &mut self.out
    }

    fn summary(&mut self, client: &Client, frame: u32, time: Micros) -> taxel::Result<()> {
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

impl<W: Write> Observer for Lines<W> {
    fn opened(&mut self, source: &Source) -> taxel::Result<()> {
        self.label.clone_from(&source.label);
        self.narrator = Narrator::default();
        Ok(())
    }

    fn event(&mut self, client: &Client, event: &Event, _: Stamp) -> taxel::Result<()> {
        if let Event::Frame { frame, time, .. } = event {
            return self.summary(client, *frame, *time);
        }
        for line in self.narrator.narrate(client, event) {
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

    fn idle(&mut self, _: &mut Client) -> taxel::Result<()> {
        Ok(self.out.flush()?)
    }

    fn ended(&mut self, client: &Client, _: Stamp) -> taxel::Result<()> {
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
