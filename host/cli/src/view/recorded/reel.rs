//! Reads a recording from any image on.

use super::survey::{RecordedTime, Survey};
use super::wire_message::with_report;
use std::collections::BTreeSet;
use std::sync::Arc;
use taxel::client::{Client, Event, RetainedState};
use taxel::files::calibrate::ForceScale;
use taxel::recording::{ClipMessage, Clips, GapMark};
use taxel_core::wire::Report;

/// Most chunks to search backwards for the key frame of an image; a board sends one each second.
const REACH: usize = 64;

/// Fade time of a touch in the page, us: `FADE_S` of `afterglow.js`.
const FADE_US: u64 = 800_000;

/// Topics with lasting state, except for maps of health, which come in parts.
const LASTING: [&str; 9] = [
    "/taxel/hello",
    "/taxel/contacts",
    "/taxel/symbols",
    "/taxel/intent",
    "/taxel/health",
    "/taxel/budget",
    "/taxel/temperature",
    "/taxel/self_test",
    "/taxel/regions",
];
/// Most chunks to search backwards for maps of health.
const MAPS: usize = 16;

/// A message, as its chunk and its index in it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Cursor {
    chunk: usize,
    index: usize,
}

/// The recording, and the state of its client.
#[derive(Debug)]
pub struct Reel {
    clips: Clips,
    clock: RecordedTime,
    survey: Arc<Survey>,
    client: Client,
    scale: ForceScale,
    next: Cursor,
    /// Begins and ends of gaps with their times, us, and the number of those passed.
    gaps: Vec<(u64, GapMark)>,
    passed: usize,
    /// The last image played.
    shown: Option<Cursor>,
    /// Afterglow at the last jump, counts by taxel: earlier pressure, fading with its age.
    glow: Vec<u16>,
}

impl Reel {
    /// Starts at the beginning. `gaps` have the host's times, ns.
    pub fn new(clips: Clips, survey: Arc<Survey>, gaps: Vec<(u64, GapMark)>, scale: ForceScale) -> Reel {
        let (clock, next) = (RecordedTime::of(&clips), Cursor { chunk: 0, index: 0 });
        let gaps = gaps.into_iter().map(|(ns, mark)| (clock.at(ns), mark)).collect();
        let (mut client, glow) = (Client::new(), Vec::new());
        client.weigh_by(scale.clone());
        Reel { clips, clock, survey, client, scale, next, gaps, passed: 0, shown: None, glow }
    }

    /// The client after the last message.
    pub fn client(&self) -> &Client {
        &self.client
    }

    /// Messages of a chunk; none if it is damaged, which the survey reports.
    fn clip(&mut self, chunk: usize) -> Arc<[ClipMessage]> {
        self.clips.clip(chunk).unwrap_or_default()
    }

    /// Next message with its time, us; none at the end.
    pub fn peek(&mut self) -> Option<(u64, ClipMessage)> {
        while self.next.chunk < self.clips.places().len() {
            if let Some(piece) = self.clip(self.next.chunk).get(self.next.index) {
                return Some((self.clock.at(piece.header.log_time), piece.clone()));
            }
            self.next = Cursor { chunk: self.next.chunk + 1, index: 0 };
        }
        None
    }

    /// Time of the next begin or end of a gap, us.
    pub fn gap(&self) -> Option<u64> {
        self.gaps.get(self.passed).map(|(at, _)| *at)
    }

    /// Plays the next begin or end of a gap, unless a message or this time, us, precedes it.
    pub fn play_gap(&mut self, until: u64) -> Option<(u64, Event)> {
        let until = self.peek().map_or(until, |(at, _)| at.min(until));
        let (at, mark) = self.gaps.get(self.passed).filter(|(at, _)| *at <= until)?.clone();
        self.passed += 1;
        mark.apply(&mut self.client);
        std::iter::from_fn(|| self.client.next_event(&[]).1).last().map(|event| (at, event))
    }

    /// Plays the next message; none if it is not a message of a board.
    pub fn play(&mut self) -> Option<Event> {
        let (_, piece) = self.peek()?;
        let event = self.push(&piece.data);
        if matches!(event, Some(Event::Frame { .. })) {
            self.shown = Some(self.next);
        }
        self.next.index += 1;
        event
    }

    fn push(&mut self, frame: &[u8]) -> Option<Event> {
        let client = &mut self.client;
        let event = client.push_all(frame).1;
        // There is no board to answer.
        client.take_requests();
        event
    }

    /// Shows the last image up to a time, else the first. Returns its time and its event; none if there is no
    /// image.
    pub fn seek(&mut self, to: u64) -> Option<(u64, Event)> {
        let image = self.image_at(to).or_else(|| self.image_after(Cursor { chunk: 0, index: 0 }))?;
        self.show(image)
    }

    /// Steps by this many images, at most to the first or last image.
    pub fn step(&mut self, images: i32) -> Option<(u64, Event)> {
        let mut image = self.shown?;
        for _ in 0..images.unsigned_abs() {
            let next = Cursor { index: image.index + 1, ..image };
            let found = if images > 0 { self.image_after(next) } else { self.image_before(image) };
            image = found.unwrap_or(image);
        }
        self.show(image)
    }

    /// Restores the client's state at an image.
    fn show(&mut self, image: Cursor) -> Option<(u64, Event)> {
        let shown_at =
            self.clip(image.chunk).get(image.index).map(|piece| self.clock.at(piece.header.log_time))?;
        let first = self.image_at(shown_at.saturating_sub(FADE_US)).unwrap_or(image).min(image);
        let key = self.key_of(first);
        self.client = Client::new();
        self.client.weigh_by(self.scale.clone());
        self.glow.clear();
        let retained = self.survey.known(key.chunk).unwrap_or_else(|| self.gathered(key.chunk));
        for frame in retained.frames() {
            self.push(&frame);
        }
        let mut last = None;
        for (at, piece) in self.between(key, image) {
            let event = self.push(&piece.data);
            if matches!(event, Some(Event::Frame { .. })) {
                self.shine(shown_at.saturating_sub(at));
            }
            last = event.map(|event| (at, event)).or(last);
        }
        self.client.recount();
        self.shown = Some(image);
        self.next = Cursor { index: image.index + 1, ..image };
        self.passed = self.gaps.partition_point(|(at, _)| *at < shown_at);
        last
    }

    /// Adds the client's image to the afterglow, `age` microseconds before the target image.
    fn shine(&mut self, age: u64) {
        let (Some(left), Some((_, image))) = (FADE_US.checked_sub(age), self.client.image()) else { return };
        self.glow.resize(image.len(), 0);
        for (glow, value) in self.glow.iter_mut().zip(image) {
            *glow = (*glow).max((u64::from(*value) * left / FADE_US) as u16);
        }
    }

    /// Afterglow at the last jump, counts by taxel.
    pub fn glow(&self) -> &[u16] {
        &self.glow
    }

    /// Message of the current image.
    pub fn shown(&mut self) -> Option<ClipMessage> {
        let Cursor { chunk, index } = self.shown?;
        self.clip(chunk).get(index).cloned()
    }

    /// Shows the key frame before the current image, or the image itself if it is one.
    pub fn show_key(&mut self) -> Option<ClipMessage> {
        let key = self.key_of(self.shown?);
        self.show(key);
        self.shown()
    }

    /// Skips the next message.
    pub fn pass(&mut self) {
        self.next.index += 1;
    }

    /// State just before the current image.
    pub fn retained(&mut self) -> RetainedState {
        let Some(image) = self.shown else { return RetainedState::default() };
        let mut retained = self.survey.retained(image.chunk);
        for piece in self.clip(image.chunk).iter().take(image.index) {
            with_report(piece, |seq, report| _ = retained.take(seq, report, &piece.data));
        }
        retained
    }

    /// State at the beginning of a chunk that the survey has not reached: the last message of each topic, by
    /// the file's index.
    fn gathered(&mut self, end: usize) -> RetainedState {
        let last = |topic| self.clips.with_topic(topic, end).next();
        let mut chunks: BTreeSet<usize> = LASTING.into_iter().filter_map(last).collect();
        chunks.extend(self.clips.with_topic("/taxel/health_map", end).take(MAPS));
        // The moment at which an intention led may be in the chunk before.
        chunks.extend(self.clips.with_topic("/taxel/intent", end).take(2));
        // A board reports its base of shapes after its hello.
        chunks.extend(last("/taxel/hello").map(|hello| hello + 1).filter(|next| *next < end));
        // Names of regions precede the first list of regions after it.
        let since = last("/taxel/hello").unwrap_or(0);
        let lists = self.clips.with_topic("/taxel/regions", end);
        chunks.extend(lists.take_while(|chunk| *chunk >= since).last());
        let mut retained = self.survey.beginning();
        for chunk in chunks {
            for piece in self.clip(chunk).iter() {
                with_report(piece, |seq, report| _ = retained.take(seq, report, &piece.data));
            }
        }
        // Without an index, nothing is known before the survey.
        if retained.is_empty() { self.survey.retained(end) } else { retained }
    }

    /// Messages from the beginning of the chunk of `key` up to an image, without unneeded images.
    fn between(&mut self, key: Cursor, image: Cursor) -> Vec<(u64, ClipMessage)> {
        let mut pieces = Vec::new();
        for chunk in key.chunk..=image.chunk {
            for (index, piece) in self.clip(chunk).iter().enumerate() {
                let at = Cursor { chunk, index };
                if at <= image && (at >= key || is_image(piece).is_none()) {
                    pieces.push((self.clock.at(piece.header.log_time), piece.clone()));
                }
            }
        }
        pieces
    }

    /// The key frame from which an image can be decoded.
    fn key_of(&mut self, image: Cursor) -> Cursor {
        for chunk in (image.chunk.saturating_sub(REACH)..=image.chunk).rev() {
            let clip = self.clip(chunk);
            let end = if chunk == image.chunk { image.index + 1 } else { clip.len() };
            if let Some(index) = clip.iter().take(end).rposition_of(|piece| is_image(piece) == Some(true)) {
                return Cursor { chunk, index };
            }
        }
        image
    }

    /// The last image up to a time.
    fn image_at(&mut self, to: u64) -> Option<Cursor> {
        let clock = self.clock;
        let end = self.clips.places().partition_point(|place| clock.at(place.start) <= to);
        (0..end).rev().find_map(|chunk| {
            let clip = self.clip(chunk);
            let due =
                |piece: &ClipMessage| clock.at(piece.header.log_time) <= to && is_image(piece).is_some();
            clip.iter().rposition_of(due).map(|index| Cursor { chunk, index })
        })
    }

    fn image_before(&mut self, image: Cursor) -> Option<Cursor> {
        (0..=image.chunk).rev().find_map(|chunk| {
            let clip = self.clip(chunk);
            let end = if chunk == image.chunk { image.index } else { clip.len() };
            let index = clip.iter().take(end).rposition_of(|piece| is_image(piece).is_some())?;
            Some(Cursor { chunk, index })
        })
    }

    /// The first image from a message on.
    fn image_after(&mut self, from: Cursor) -> Option<Cursor> {
        (from.chunk..self.clips.places().len()).find_map(|chunk| {
            let clip = self.clip(chunk);
            let start = if chunk == from.chunk { from.index } else { 0 };
            let found = clip.iter().skip(start).position(|piece| is_image(piece).is_some())?;
            Some(Cursor { chunk, index: start + found })
        })
    }
}

/// Position of the last item that meets a condition.
trait LastPosition: Iterator {
    fn rposition_of(self, holds: impl Fn(Self::Item) -> bool) -> Option<usize>;
}

impl<I: Iterator> LastPosition for I {
    fn rposition_of(self, holds: impl Fn(I::Item) -> bool) -> Option<usize> {
        self.enumerate().filter_map(|(index, item)| holds(item).then_some(index)).last()
    }
}

/// True for a key frame; none if the message is not an image.
fn is_image(piece: &ClipMessage) -> Option<bool> {
    let alone = |_, report: &Report<'_>| match report {
        Report::Frame(frame) => Some(frame.base.is_none()),
        _ => None,
    };
    with_report(piece, alone).flatten()
}
