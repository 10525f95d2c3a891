//! Frames of one length between markers.

use super::checksum::FrameCheck;
use super::timed_bytes::TimedBytes;
use std::ops::Range;

/// Bytes taken at once, which bounds the memory.
const PIECE: usize = 1024;

/// Form of a record: a marker, a body, and the marker that must stand exactly behind it.
#[derive(Debug, Clone)]
pub struct RecordForm {
    /// Marker in front.
    pub open: Vec<u8>,
    /// Bytes between the markers, with the checksum.
    pub body: usize,
    /// Marker behind; empty if the checksum decides.
    pub close: Vec<u8>,
    /// True if the marker behind begins the next record.
    pub shares: bool,
    /// The frame within the record: from its head, or from the end of the tail before it.
    pub frame: Range<usize>,
    /// The checksum, which ends at the end of the body.
    pub check: FrameCheck,
    /// First byte of the record that is checked.
    pub checked: usize,
}

impl RecordForm {
    /// Bytes to the end of the body.
    fn end(&self) -> usize {
        self.open.len() + self.body
    }

    /// Bytes of the record with both markers.
    fn length(&self) -> usize {
        self.end() + self.close.len()
    }

    /// Bytes from a record to the next one.
    fn step(&self) -> usize {
        if self.shares { self.end() } else { self.length() }
    }

    /// True if both markers stand at their places.
    fn is_marked(&self, bytes: &[u8]) -> bool {
        bytes.starts_with(&self.open)
            && bytes.get(self.end()..).is_some_and(|rest| rest.starts_with(&self.close))
    }

    fn is_checked(&self, bytes: &[u8]) -> bool {
        let (end, length) = (self.end(), self.check.length());
        self.check.agrees(&bytes[self.checked..end - length], &bytes[end - length..end])
    }
}

/// Verdict on the bytes at a place.
enum RecordVerdict {
    /// More bytes are needed.
    Open,
    /// No frame begins here.
    Not,
    /// Another frame could begin within this one, and repeats as well.
    Ambiguous,
    Frame,
}

/// Finds records in a stream. After damage it searches from one byte behind the failed start.
#[derive(Debug)]
pub struct Marked {
    form: RecordForm,
    waiting: TimedBytes,
    is_locked: bool,
    /// Bytes passed over since the last record; none before the first.
    skipped: Option<usize>,
    /// Damaged records.
    pub dropped: u64,
}

impl Marked {
    /// A search from the start of a stream. A marker that only ends records counts as sent before it.
    pub fn new(form: RecordForm) -> Marked {
        let mut waiting = TimedBytes::default();
        if form.shares && form.frame.start == form.open.len() {
            waiting.push(&form.open, 0);
        }
        Marked { form, waiting, is_locked: false, skipped: None, dropped: 0 }
    }

    /// Takes bytes; hands over each frame, its arrival time, and the number of damaged ones so far.
    pub fn push(&mut self, bytes: &[u8], arrival_us: u64, found: &mut dyn FnMut(&[u8], u64, u64)) {
        for piece in bytes.chunks(PIECE) {
            self.waiting.push(piece, arrival_us);
            let mut at = 0;
            loop {
                match self.verdict(&self.waiting.bytes()[at..]) {
                    RecordVerdict::Open => break,
                    RecordVerdict::Not => {
                        at += 1;
                        self.is_locked = false;
                        self.skipped = self.skipped.map(|count| count + 1);
                    }
                    RecordVerdict::Ambiguous => {
                        at += self.form.step();
                        self.skipped = self.skipped.map(|count| count + self.form.step());
                    }
                    RecordVerdict::Frame => {
                        let (skipped, step) = (self.skipped.unwrap_or(0), self.form.step());
                        // Bytes may be missing, or have come in addition.
                        let lost = ((skipped + step / 2) / step).max(usize::from(skipped > 0));
                        self.dropped += lost as u64;
                        (self.is_locked, self.skipped) = (true, Some(0));
                        let frame = at + self.form.frame.start..at + self.form.frame.end;
                        let arrival = self.waiting.arrival(frame.end - 1);
                        found(&self.waiting.bytes()[frame], arrival, self.dropped);
                        at += self.form.step();
                    }
                }
            }
            self.waiting.consume(at);
        }
    }

    fn verdict(&self, bytes: &[u8]) -> RecordVerdict {
        let form = &self.form;
        if !bytes.starts_with(&form.open) {
            return if form.open.starts_with(bytes) { RecordVerdict::Open } else { RecordVerdict::Not };
        }
        if bytes.len() < form.length() {
            return RecordVerdict::Open;
        }
        if !form.is_marked(bytes) || !form.is_checked(bytes) {
            return RecordVerdict::Not;
        }
        if self.is_locked || form.check != FrameCheck::None {
            return RecordVerdict::Frame;
        }
        let mut others = (1..form.step()).filter(|at| bytes[*at..].starts_with(&form.open));
        let length = form.length();
        let worst = others.find_map(|at| match bytes.get(at..at + length) {
            None => Some(RecordVerdict::Open),
            Some(other) => form.is_marked(other).then_some(RecordVerdict::Ambiguous),
        });
        worst.unwrap_or(RecordVerdict::Frame)
    }
}
