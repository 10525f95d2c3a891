//! Reads a recording once, beside its player: for the overview, and so that any part of it can be shown.

use super::overview::Overview;
use super::wire_message::with_report;
use crate::view::hub::PageHub;
use crate::view::line_kind::LineKind;
use crate::view::said::{EventLines, Said, gap};
use std::sync::Arc;
use std::thread;
use std::time::Duration;
use taxel::client::{Client, Event, RetainedState};
use taxel::files::calibrate::ForceScale;
use taxel::recording::{ClipMessage, Clips, HELLO, lost};
use taxel::source::shared::Shared;
use taxel::text::words;
use taxel::time::Instant;
use taxel_core::wire::{self, Report};

/// Time between two progress messages.
const UPDATE: Duration = Duration::from_millis(500);

/// State at the beginning of each chunk.
#[derive(Debug, Default)]
pub struct Survey {
    found: Shared<Surveyed>,
    beginning: RetainedState,
}

#[derive(Debug, Default)]
struct Surveyed {
    retained: Vec<RetainedState>,
    done: bool,
}

impl Survey {
    /// Starts in a thread of its own.
    pub fn start(
        mut clips: Clips,
        clock: RecordedTime,
        scale: ForceScale,
        hub: Arc<PageHub>,
    ) -> anyhow::Result<Arc<Survey>> {
        let beginning = beginning(&mut clips);
        let survey = Arc::new(Survey { beginning: beginning.clone(), ..Survey::default() });
        let mut client = Client::new();
        client.weigh_by(scale);
        let mut surveyor = Surveyor {
            clips,
            clock,
            overview: Overview::new(clock.duration()),
            retained: beginning,
            client,
            lines: EventLines::default(),
        };
        for frame in surveyor.retained.frames() {
            surveyor.report(0, &frame);
        }
        let found = survey.clone();
        thread::Builder::new().name("survey".into()).spawn(move || {
            surveyor.go(&found, &hub);
            found.found.change(|found| found.done = true);
        })?;
        Ok(survey)
    }

    /// State before the first message.
    pub fn beginning(&self) -> RetainedState {
        self.beginning.clone()
    }

    /// State at the beginning of a chunk; none if it is not known yet.
    pub fn known(&self, chunk: usize) -> Option<RetainedState> {
        let found = self.found.lock();
        found.retained.get(chunk).or(found.retained.last().filter(|_| found.done)).cloned()
    }

    /// State at the beginning of a chunk; waits until it is known.
    pub fn retained(&self, chunk: usize) -> RetainedState {
        loop {
            if let Some(retained) = self.known(chunk) {
                return retained;
            }
            let found = self.found.lock();
            if found.done {
                return found.retained.last().cloned().unwrap_or_default();
            }
            drop(self.found.wait(found, Duration::from_millis(50)));
        }
    }
}

/// State before the first message: the attached `Hello`, in case its chunk is lost.
fn beginning(clips: &mut Clips) -> RetainedState {
    let first = (0..clips.places().len()).find_map(|chunk| clips.clip(chunk).ok()?.first().cloned());
    let mut retained = RetainedState::default();
    if let (Some(first), Some(hello)) = (first, clips.attached(HELLO))
        && let Some(frame) = lost(hello, &first.data)
    {
        let piece = ClipMessage { data: frame.into(), ..first };
        with_report(&piece, |seq, report| _ = retained.take(seq, report, &piece.data));
    }
    retained
}

/// Converts log times to microseconds since the recording began.
#[derive(Debug, Clone, Copy)]
pub struct RecordedTime {
    start: u64,
    end: u64,
}

impl RecordedTime {
    /// Times of this recording.
    pub fn of(clips: &Clips) -> RecordedTime {
        let start = clips.places().first().map_or(0, |place| place.start);
        let end = clips.places().iter().map(|place| place.end).max().unwrap_or(start);
        RecordedTime { start, end }
    }

    /// Duration, us.
    pub fn duration(&self) -> u64 {
        self.at(self.end)
    }

    /// Converts a log time, ns.
    pub fn at(&self, ns: u64) -> u64 {
        ns.clamp(self.start, self.end).saturating_sub(self.start) / 1000
    }
}

struct Surveyor {
    clips: Clips,
    clock: RecordedTime,
    overview: Overview,
    retained: RetainedState,
    client: Client,
    lines: EventLines,
}

impl Surveyor {
    fn go(&mut self, survey: &Survey, hub: &PageHub) {
        let mut sent = Instant::now();
        for chunk in 0..self.clips.places().len() {
            survey.found.change(|found| found.retained.push(self.retained.clone()));
            let at = self.clips.places().get(chunk).map_or(0, |place| self.clock.at(place.start));
            match self.clips.clip(chunk) {
                Ok(clip) => clip.iter().for_each(|piece| self.take(piece)),
                Err(error) => {
                    let cause = words::chain(&error).last().map(ToString::to_string).unwrap_or_default();
                    let text = format!("a part of the recording cannot be read: {cause}");
                    self.overview.say(at, Said { kind: LineKind::Gap, time_us: None, text });
                }
            }
            self.overview.reach(at);
            if sent.elapsed() >= UPDATE {
                hub.state("overview", &self.overview.message());
                sent = Instant::now();
            }
        }
        self.overview.reach(self.clock.duration());
        hub.state("overview", &self.overview.message());
    }

    /// Images are only counted; decoding them would take most of the time.
    fn take(&mut self, piece: &ClipMessage) {
        let at = self.clock.at(piece.header.log_time);
        let mut bytes = piece.data.strip_suffix(&[0]).unwrap_or(&piece.data).to_vec();
        let message = wire::open(&mut bytes).ok();
        let read = message.and_then(|message| wire::decode::<(u32, Report<'_>)>(message).ok());
        let Some((seq, report)) = read else { return self.report(at, &piece.data) };
        let lost = self.retained.take(seq, &report, &piece.data);
        if lost > 0 {
            self.overview.say(at, gap(lost, None));
        }
        match &report {
            Report::Frame(_) | Report::Raw(_) => {}
            _ => self.report(at, &piece.data),
        }
    }

    /// Handles a message.
    fn report(&mut self, at: u64, frame: &[u8]) {
        let client = &mut self.client;
        let Some(event) = client.push_all(frame).1 else { return };
        for said in self.lines.lines(client, &event) {
            self.overview.say(at, said);
        }
        match &event {
            Event::Contacts { .. } => {
                let totals = client.contacts().iter().map(|placed| placed.contact.total);
                self.overview.press(at, totals.fold(0, u32::saturating_add));
            }
            Event::Intent(report) => self.overview.lead(at, report.leading),
            _ => {}
        }
    }
}
