//! Outgoing messages of one page: at most one image and a few lines, however slow the page is.

use super::message;
use super::shot::Shot;
use std::collections::{BTreeMap, VecDeque};
use std::sync::Arc;
use std::time::Duration;
use taxel::source::shared::Shared;
use taxel::time::Instant;

/// Most log lines queued.
const LINES: usize = 64;
/// Most samples queued: more than a second of them.
const SAMPLES: usize = 256;
/// Shortest time between two images: 60 per second, with a margin for differing clocks.
const PERIOD: Duration = Duration::from_micros(16_500);

/// A message to a page.
#[derive(Debug, PartialEq)]
pub enum Parcel {
    /// A text message.
    Line(Arc<str>),
    /// A binary message, see [`message`].
    Image(Vec<u8>),
    /// The page is closed.
    Closed,
}

/// The queue of one page.
#[derive(Debug, Default)]
pub struct Mailbox {
    queue: Shared<PageQueue>,
    /// Number of the page.
    number: u64,
}

#[derive(Debug, Default)]
struct PageQueue {
    /// Latest message of each kind.
    states: BTreeMap<&'static str, Arc<str>>,
    lines: VecDeque<Arc<str>>,
    shot: Option<Shot>,
    /// Greatest pressure of each taxel since the last image was sent.
    highest: Vec<u16>,
    /// Time and total of each frame since then.
    samples: VecDeque<(u64, u32)>,
    /// Number of images replaced before they were sent.
    replaced: u64,
    /// Number of samples and lines dropped.
    missed: u64,
    sent: Option<Instant>,
    hovered: Option<u16>,
    closed: bool,
}

impl Mailbox {
    /// The queue of the page of this number.
    pub fn numbered(number: u64) -> Mailbox {
        Mailbox { number, ..Mailbox::default() }
    }

    /// Number of the page among those of its board.
    pub fn number(&self) -> u64 {
        self.number
    }

    /// Queues a message that replaces the last one of its kind.
    pub fn state(&self, kind: &'static str, line: Arc<str>) {
        self.queue.change(|waiting| _ = waiting.states.insert(kind, line));
    }

    /// Queues a line of the log.
    pub fn line(&self, line: Arc<str>) {
        self.queue.change(|waiting| {
            waiting.lines.push_back(line);
            while waiting.lines.len() > LINES {
                waiting.lines.pop_front();
                waiting.missed += 1;
            }
        });
    }

    /// Queues an image.
    pub fn shot(&self, shot: &Shot) {
        self.queue.change(|waiting| waiting.take(shot));
    }

    /// Discards the queued image.
    pub fn forget_images(&self) {
        let mut waiting = self.queue.lock();
        waiting.shot = None;
        waiting.highest.fill(0);
        waiting.samples.clear();
    }

    /// Takes a queued text message.
    pub fn line_now(&self) -> Option<Parcel> {
        self.queue.lock().line().map(Parcel::Line)
    }

    /// True if the page is closed.
    pub fn is_closed(&self) -> bool {
        self.queue.lock().closed
    }

    /// Takes the queued image at once.
    pub fn take(&self) -> Option<Parcel> {
        self.queue.lock().image()
    }

    /// Sets the taxel under the pointer.
    pub fn hover(&self, taxel: Option<u16>) {
        self.queue.lock().hovered = taxel;
    }

    /// See [`Mailbox::hover`].
    pub fn hovered(&self) -> Option<u16> {
        self.queue.lock().hovered
    }

    /// Closes the queue.
    pub fn close(&self) {
        self.queue.change(|waiting| waiting.closed = true);
    }

    /// Takes the next message if one is due.
    pub fn due(&self) -> Option<Parcel> {
        self.queue.lock().due(Instant::now())
    }

    /// Waits for the next message: lines at once, images when due.
    pub fn next(&self) -> Parcel {
        let mut waiting = self.queue.lock();
        loop {
            let now = Instant::now();
            if let Some(parcel) = waiting.due(now) {
                return parcel;
            }
            let longest = Duration::from_secs(1);
            let rest = match (&waiting.shot, waiting.sent) {
                (Some(_), Some(sent)) => (sent + PERIOD).saturating_duration_since(now),
                _ => longest,
            };
            waiting = self.queue.wait(waiting, rest.min(longest));
        }
    }
}

impl PageQueue {
    fn take(&mut self, shot: &Shot) {
        if self.highest.len() != shot.image.len() {
            self.highest.clear();
            self.highest.resize(shot.image.len(), 0);
        }
        for (highest, value) in self.highest.iter_mut().zip(shot.image.iter()) {
            *highest = (*highest).max(*value);
        }
        self.samples.push_back((shot.time_us, shot.total));
        while self.samples.len() > SAMPLES {
            self.samples.pop_front();
            self.missed += 1;
        }
        self.replaced += u64::from(self.shot.replace(shot.clone()).is_some());
    }

    fn line(&mut self) -> Option<Arc<str>> {
        self.states.pop_first().map(|(_, line)| line).or_else(|| self.lines.pop_front())
    }

    fn due(&mut self, now: Instant) -> Option<Parcel> {
        if self.closed {
            return Some(Parcel::Closed);
        }
        if let Some(line) = self.line() {
            return Some(Parcel::Line(line));
        }
        if self.shot.is_none() || self.sent.is_some_and(|sent| now < sent + PERIOD) {
            return None;
        }
        self.sent = Some(now);
        self.image()
    }

    /// Takes the queued image, with the maxima and samples since the last one.
    fn image(&mut self) -> Option<Parcel> {
        let shot = self.shot.take()?;
        let samples: Vec<_> = self.samples.drain(..).collect();
        let parcel = message::image(&shot, &self.highest, &samples, self.replaced, self.missed);
        self.highest.fill(0);
        Some(Parcel::Image(parcel))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shot(number: u64, image: &[u16]) -> Shot {
        Shot { line: format!("{number}").into(), image: image.into(), time_us: number, total: number as u32 }
    }

    fn image(parcel: Parcel) -> (serde_json::Value, Vec<u16>) {
        let Parcel::Image(bytes) = parcel else { panic!("{parcel:?} is no image") };
        let length = u32::from_le_bytes(bytes[..4].try_into().unwrap()) as usize;
        let (head, images) = bytes[4..].split_at(length);
        let values = images.chunks(2).map(|b| u16::from_le_bytes([b[0], b[1]])).collect();
        (serde_json::from_slice(head).unwrap(), values)
    }

    #[test]
    fn the_newest_image_replaces_and_the_highest_pressure_stays() {
        let mailbox = Mailbox::default();
        for (number, values) in [(1, [3, 9]), (2, [8, 2]), (3, [1, 4])] {
            mailbox.shot(&shot(number, &values));
        }
        let (head, values) = image(mailbox.next());
        assert_eq!(values, [1, 4, 8, 9]);
        assert_eq!(head["replaced"], 2);
        assert_eq!(head["samples"], serde_json::json!([[1, 1], [2, 2], [3, 3]]));
        mailbox.shot(&shot(4, &[5, 5]));
        let (head, values) = image(mailbox.next());
        assert_eq!((head["frame"].as_u64(), values), (Some(4), vec![5, 5, 5, 5]));
    }

    #[test]
    fn nothing_grows_while_nobody_reads() {
        let mailbox = Mailbox::default();
        for number in 0..10_000 {
            mailbox.shot(&shot(number, &[number as u16; 4]));
            mailbox.line(format!("line {number}").into());
            mailbox.state("health", format!("{number}").into());
        }
        let waiting = mailbox.queue.lock();
        assert_eq!((waiting.lines.len(), waiting.samples.len(), waiting.states.len()), (LINES, SAMPLES, 1));
        assert_eq!(waiting.missed, 2 * 10_000 - (LINES + SAMPLES) as u64);
        assert_eq!(waiting.replaced, 9_999);
        drop(waiting);
        assert_eq!(mailbox.next(), Parcel::Line("9999".into()));
        mailbox.close();
        assert_eq!(mailbox.next(), Parcel::Closed);
    }

    #[test]
    fn images_come_no_faster_than_they_are_drawn() {
        let mailbox = Mailbox::default();
        let begun = Instant::now();
        for number in 0..4 {
            mailbox.shot(&shot(number, &[0]));
            image(mailbox.next());
        }
        assert!(begun.elapsed() >= 3 * PERIOD);
    }
}
