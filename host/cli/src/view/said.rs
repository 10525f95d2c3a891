//! Events as lines of the log and marks on the timeline.

use super::line_kind::LineKind;
use super::lines::SayLine;
use crate::watch::narrate::{Narrator, seconds};
use taxel::client::{Client, Event, time_of};
use taxel_core::contact::Phase;
use taxel_core::format::Micros;

/// A line.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Said {
    /// Kind.
    pub kind: LineKind,
    /// Board time, us; none if it has none.
    pub time_us: Option<u64>,
    /// Sentence without its time.
    pub text: String,
}

impl Said {
    /// A sentence of the host's own.
    pub fn note(text: impl Into<String>) -> Said {
        Said { kind: LineKind::Note, time_us: None, text: text.into() }
    }

    /// The message `say`.
    pub fn message(&self) -> SayLine<'_> {
        SayLine { kind: self.kind, time_us: self.time_us, said: &self.text }
    }
}

/// Turns events into lines.
#[derive(Debug, Default, Clone)]
pub struct EventLines {
    narrator: Narrator,
    lost: u64,
}

impl EventLines {
    /// Lines for an event, and for messages lost before it.
    pub fn narrate(&mut self, client: &Client, event: &Event) -> Vec<Said> {
        let lost = client.counts().lost.saturating_sub(self.lost);
        self.lost = client.counts().lost;
        let mut said: Vec<Said> = (lost > 0).then(|| gap(lost, time_of(client, event))).into_iter().collect();
        said.extend(self.lines(client, event));
        said
    }

    /// Lines for an event.
    pub fn lines(&mut self, client: &Client, event: &Event) -> Vec<Said> {
        let time_us = time_of(client, event);
        let kinds = kinds(event);
        let lines = self.narrator.narrate(client, event).into_iter().enumerate();
        let said = |(index, line): (usize, String)| {
            let stamp = time_us.map(|time| format!("{} ", seconds(Micros(time))));
            let text = stamp.as_deref().and_then(|stamp| line.strip_prefix(stamp));
            let kind = kinds.get(index).or(kinds.last()).copied().unwrap_or(LineKind::Note);
            match text {
                Some(text) => Said { kind, time_us, text: text.into() },
                None => Said { kind, time_us: None, text: line },
            }
        };
        lines.map(said).collect()
    }
}

/// Line about lost messages.
pub fn gap(lost: u64, time_us: Option<u64>) -> Said {
    let text = if lost == 1 { "1 message is missing".into() } else { format!("{lost} messages are missing") };
    Said { kind: LineKind::Gap, time_us, text }
}

/// Kind of each line of an event; the last one applies to all further lines.
fn kinds(event: &Event) -> Vec<LineKind> {
    match event {
        Event::Symbols(list) => {
            let reported = list.events.iter().filter(|symbol| symbol.phase != Phase::Held);
            reported
                .map(
                    |symbol| {
                        if symbol.phase == Phase::Released { LineKind::Release } else { LineKind::Onset }
                    },
                )
                .collect()
        }
        Event::Intent(_) => vec![LineKind::Intention],
        Event::Reaction(_) => vec![LineKind::Reaction],
        Event::Gesture(_) => vec![LineKind::Gesture],
        _ => Vec::new(),
    }
}
