//! A recording that is read from any image on.

use super::standing::Standing;
use super::survey::{RecordedTime, Survey};
use crate::client::{Client, Event};
use crate::recording::{Clips, Piece};
use std::collections::BTreeSet;
use std::sync::Arc;
use taxel_core::wire::{self, Report};

/// Chunks before an image in which the one that it is told by is looked for: a board sends one each second.
const REACH: usize = 64;

/// Time in which the page lets a touch fade, us: `FADE_S` of `afterglow.js`.
const FADE_US: u64 = 800_000;

/// Topics of what lasts, but for maps of health, which come in parts.
const LASTING: [&str; 8] = [
    "/taxel/hello",
    "/taxel/contacts",
    "/taxel/symbols",
    "/taxel/intent",
    "/taxel/health",
    "/taxel/budget",
    "/taxel/temperature",
    "/taxel/self_test",
];
/// Chunks with maps of health that are gone back through.
const MAPS: usize = 16;

/// A message: its chunk, and which one of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Cursor {
    chunk: usize,
    index: usize,
}

/// The recording, and what its client knows.
#[derive(Debug)]
pub struct Reel {
    clips: Clips,
    clock: RecordedTime,
    survey: Arc<Survey>,
    client: Client,
    next: Cursor,
    /// The last image that was played.
    shown: Option<Cursor>,
    /// What glowed when an image was gone to, counts by taxel: what was felt before it, less the longer ago
    /// it was.
    glow: Vec<u16>,
}

impl Reel {
    /// At its beginning.
    pub fn new(clips: Clips, survey: Arc<Survey>) -> Reel {
        let (clock, next) = (RecordedTime::of(&clips), Cursor { chunk: 0, index: 0 });
        Reel { clips, clock, survey, client: Client::new(), next, shown: None, glow: Vec::new() }
    }

    /// What is known after the last message.
    pub fn client(&self) -> &Client {
        &self.client
    }

    /// The messages of a chunk; none of one that is damaged, of which the survey tells.
    fn clip(&mut self, chunk: usize) -> Arc<[Piece]> {
        self.clips.clip(chunk).unwrap_or_default()
    }

    /// The next message with its time, us; none: there are no more.
    pub fn peek(&mut self) -> Option<(u64, Piece)> {
        while self.next.chunk < self.clips.places().len() {
            if let Some(piece) = self.clip(self.next.chunk).get(self.next.index) {
                return Some((self.clock.at(piece.header.log_time), piece.clone()));
            }
            self.next = Cursor { chunk: self.next.chunk + 1, index: 0 };
        }
        None
    }

    /// Plays the next message; none: it was no message of a board.
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
        let event = frame.iter().find_map(|byte| client.push(*byte));
        // Nobody answers.
        client.take_requests();
        event
    }

    /// Shows the last image up to a time, else the first: its time and what it was told by. None: there is no
    /// image.
    pub fn seek(&mut self, to: u64) -> Option<(u64, Event)> {
        let image = self.image_at(to).or_else(|| self.image_after(Cursor { chunk: 0, index: 0 }))?;
        self.show(image)
    }

    /// Shows the image so many further, or the last there is; back from an image, or the first there is.
    pub fn step(&mut self, images: i32) -> Option<(u64, Event)> {
        let mut image = self.shown?;
        for _ in 0..images.unsigned_abs() {
            let next = Cursor { index: image.index + 1, ..image };
            let found = if images > 0 { self.image_after(next) } else { self.image_before(image) };
            image = found.unwrap_or(image);
        }
        self.show(image)
    }

    /// Puts the client in the state of an image.
    fn show(&mut self, image: Cursor) -> Option<(u64, Event)> {
        let shown_at =
            self.clip(image.chunk).get(image.index).map(|piece| self.clock.at(piece.header.log_time))?;
        let first = self.image_at(shown_at.saturating_sub(FADE_US)).unwrap_or(image).min(image);
        let key = self.key_of(first);
        self.client = Client::new();
        self.glow.clear();
        let standing = self.survey.known(key.chunk).unwrap_or_else(|| self.gathered(key.chunk));
        for frame in standing.frames() {
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
        last
    }

    /// Adds the client's image, which was felt so many microseconds before the one that is gone to.
    fn shine(&mut self, age: u64) {
        let (Some(left), Some((_, image))) = (FADE_US.checked_sub(age), self.client.image()) else { return };
        self.glow.resize(image.len(), 0);
        for (glow, value) in self.glow.iter_mut().zip(image) {
            *glow = (*glow).max((u64::from(*value) * left / FADE_US) as u16);
        }
    }

    /// What glowed when the last image was gone to, counts by taxel.
    pub fn glow(&self) -> &[u16] {
        &self.glow
    }

    /// The image that is shown, as it was sent.
    pub fn shown(&mut self) -> Option<Piece> {
        let Cursor { chunk, index } = self.shown?;
        self.clip(chunk).get(index).cloned()
    }

    /// Shows the image that stands alone before the one that is shown, or this one, where it does.
    pub fn show_key(&mut self) -> Option<Piece> {
        let key = self.key_of(self.shown?);
        self.show(key);
        self.shown()
    }

    /// Leaves the next message out.
    pub fn pass(&mut self) {
        self.next.index += 1;
    }

    /// What held just before the image that is shown.
    pub fn standing(&mut self) -> Standing {
        let Some(image) = self.shown else { return Standing::default() };
        let mut standing = self.survey.standing(image.chunk);
        for piece in self.clip(image.chunk).iter().take(image.index) {
            with_report(piece, |seq, report| _ = standing.take(seq, report, &piece.data));
        }
        standing
    }

    /// What held when a chunk began which the survey has not come to: what was told last of each topic, as
    /// the file's index says.
    fn gathered(&mut self, end: usize) -> Standing {
        let last = |topic| self.clips.with_topic(topic, end).next();
        let mut chunks: BTreeSet<usize> = LASTING.into_iter().filter_map(last).collect();
        chunks.extend(self.clips.with_topic("/taxel/health_map", end).take(MAPS));
        // The moment at which an intention led may lie in the one before.
        chunks.extend(self.clips.with_topic("/taxel/intent", end).take(2));
        // What a board was taught it tells behind its hello.
        chunks.extend(last("/taxel/hello").map(|hello| hello + 1).filter(|next| *next < end));
        let mut standing = self.survey.beginning();
        for chunk in chunks {
            for piece in self.clip(chunk).iter() {
                with_report(piece, |seq, report| _ = standing.take(seq, report, &piece.data));
            }
        }
        // Without an index, nothing is known before the survey comes.
        if standing.is_empty() { self.survey.standing(end) } else { standing }
    }

    /// Messages from the beginning of the chunk of `key` up to an image, without images that nothing needs.
    fn between(&mut self, key: Cursor, image: Cursor) -> Vec<(u64, Piece)> {
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

    /// The image that stands alone from which an image can be decoded.
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
            let due = |piece: &Piece| clock.at(piece.header.log_time) <= to && is_image(piece).is_some();
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

/// The last of those for which something holds.
trait LastPosition: Iterator {
    fn rposition_of(self, holds: impl Fn(Self::Item) -> bool) -> Option<usize>;
}

impl<I: Iterator> LastPosition for I {
    fn rposition_of(self, holds: impl Fn(I::Item) -> bool) -> Option<usize> {
        self.enumerate().filter_map(|(index, item)| holds(item).then_some(index)).last()
    }
}

/// Reads a message; none: it cannot be read.
pub(super) fn with_report<T>(piece: &Piece, read: impl FnOnce(u32, &Report<'_>) -> T) -> Option<T> {
    let mut bytes = piece.data.strip_suffix(&[0]).unwrap_or(&piece.data).to_vec();
    let (seq, report) = wire::decode::<(u32, Report<'_>)>(wire::open(&mut bytes).ok()?).ok()?;
    Some(read(seq, &report))
}

/// Whether an image stands alone; none: it is no image.
fn is_image(piece: &Piece) -> Option<bool> {
    let alone = |_, report: &Report<'_>| match report {
        Report::Frame(frame) => Some(frame.base.is_none()),
        _ => None,
    };
    with_report(piece, alone).flatten()
}
