//! The decoder of a described array.

use super::answers::Answers;
use super::description::ArrayDescription;
use super::form::{BytesForm, FrameForm};
use super::frame::{ArrayFrame, ArrayLoss, StreamFrame};
use super::marked::Marked;
use super::order::ValueOrder;
use super::rows::Rows;
use super::stamp::{SensorCount, SensorTime};
use super::wiresens::Packets;
use super::words::LineForm;
use super::zeros::Zeros;
use std::ops::Range;

/// Receiver of frames.
pub type FrameSink<'a> = dyn FnMut(ArrayFrame) + 'a;

/// Cuts a stream into frames.
#[derive(Debug)]
pub struct ArrayDecoder {
    cutter: Cutter,
    placed: FramePlacer,
}

#[derive(Debug)]
enum Cutter {
    Marked(Marked, BytesForm, Range<usize>),
    Answers(Answers, BytesForm, Range<usize>),
    Rows(Rows),
    Zeros(Zeros),
    Wiresens(Packets),
}

impl ArrayDecoder {
    /// A decoder of a checked description, at the start of its stream.
    pub fn new(description: &ArrayDescription) -> ArrayDecoder {
        let &ArrayDescription { rows, columns, snake, orientation, ref frame, .. } = description;
        let values = description.values();
        let (down, across) = if orientation.transposed { (columns, rows) } else { (rows, columns) };
        let lines = |separator: &Option<String>, prefix: &Option<String>, skip| LineForm {
            separator: separator.clone(),
            prefix: prefix.clone(),
            time: None,
            skip,
        };
        let (mut count, mut clock) = (None, None);
        let cutter = match frame {
            FrameForm::Bytes(form) => {
                count = form.sequence.map(|place| SensorCount::new(place.form));
                clock = form.time.map(|place| SensorTime::new(place.unit, Some(place.form)));
                match form.record(values) {
                    Ok(Some(record)) => {
                        Cutter::Marked(Marked::new(record), form.clone(), form.values(values))
                    }
                    _ => {
                        let length = form.before + form.value_bytes(values) + form.after;
                        Cutter::Answers(Answers::new(length), form.clone(), form.values(values))
                    }
                }
            }
            FrameForm::Lines { separator, prefix, time, skip } => {
                clock = time.map(|time| SensorTime::new(time.unit, None));
                let time = time.map(|time| (time.field, time.unit));
                Cutter::Rows(Rows::new(LineForm { time, ..lines(separator, prefix, *skip) }, values, None))
            }
            FrameForm::Rows { separator, prefix, skip } => {
                Cutter::Rows(Rows::new(lines(separator, prefix, *skip), across.into(), Some(down.into())))
            }
            FrameForm::Zeros {} => Cutter::Zeros(Zeros::new(values)),
            FrameForm::Wiresens { nodes, id, trailer } => {
                Cutter::Wiresens(Packets::new(values, *nodes, *id, *trailer))
            }
        };
        let order = ValueOrder::new(rows.into(), columns.into(), snake, orientation);
        ArrayDecoder {
            cutter,
            placed: FramePlacer { order, count, clock, loss: ArrayLoss::default(), cut: 0, since: 0 },
        }
    }

    /// Takes bytes that arrived at this time; hands over each frame that they complete.
    pub fn push(&mut self, bytes: &[u8], arrival_us: u64, found: &mut FrameSink<'_>) {
        let ArrayDecoder { cutter, placed } = self;
        match cutter {
            Cutter::Marked(marked, form, values) => {
                marked.push(bytes, arrival_us, &mut |frame, arrival, dropped| {
                    placed.lose(dropped);
                    placed.take(form.numbers(frame, values.clone(), arrival), found);
                })
            }
            Cutter::Answers(answers, ..) => answers.push(bytes, arrival_us),
            Cutter::Rows(rows) => {
                rows.push(bytes, arrival_us, &mut |frame| placed.take(frame, found));
                placed.lose(rows.dropped);
            }
            Cutter::Zeros(zeros) => {
                zeros.push(bytes, arrival_us, &mut |frame| placed.take(frame, found));
                placed.lose(zeros.dropped);
            }
            Cutter::Wiresens(packets) => {
                packets.push(bytes, arrival_us, &mut |frame| placed.take(frame, found));
                let [dropped, missed] = packets.lost();
                placed.loss = ArrayLoss { dropped, missed };
            }
        }
    }

    /// Takes a datagram, which begins with a whole line; one with a frame in a line may lack the end of the line.
    pub(crate) fn datagram(&mut self, bytes: &[u8], arrival_us: u64, found: &mut FrameSink<'_>) {
        let mut lacks_end = false;
        if let Cutter::Rows(rows) = &mut self.cutter {
            lacks_end = rows.begin() && !bytes.ends_with(b"\n");
        }
        self.push(bytes, arrival_us, found);
        if lacks_end {
            self.push(b"\n", arrival_us, found);
        }
    }

    /// Declares that nothing came for a while, which ends an answer.
    pub fn quiet(&mut self, found: &mut FrameSink<'_>) {
        if let Cutter::Answers(answers, form, values) = &mut self.cutter {
            answers.quiet(&mut |frame, arrival| {
                self.placed.take(form.numbers(frame, values.clone(), arrival), found);
            });
            self.placed.lose(answers.dropped);
        }
    }

    /// Frames that were lost so far.
    pub fn loss(&self) -> ArrayLoss {
        self.placed.loss
    }
}

impl BytesForm {
    /// Reads the numbers of a frame, whose values are these bytes.
    fn numbers(&self, frame: &[u8], values: Range<usize>, arrival_us: u64) -> StreamFrame {
        let mut numbers = StreamFrame { arrival_us, ..StreamFrame::default() };
        self.value.read(frame.get(values).unwrap_or(&[]), &mut numbers.values);
        let at = |place: usize| frame.get(place..).unwrap_or(&[]);
        numbers.sequence = self.sequence.map(|place| place.form.count(at(place.at)));
        numbers.time_us = self.time.map(|place| u64::from(place.form.count(at(place.at))) * place.unit.us());
        numbers
    }
}

/// Frames on the panel, in time.
#[derive(Debug)]
struct FramePlacer {
    order: ValueOrder,
    count: Option<SensorCount>,
    clock: Option<SensorTime>,
    loss: ArrayLoss,
    /// Frames dropped by the cutter so far, and since the last frame.
    cut: u64,
    since: u64,
}

impl FramePlacer {
    /// Takes the number of frames that the cutter has dropped so far.
    fn lose(&mut self, cut: u64) {
        let lost = cut - self.cut;
        (self.cut, self.since) = (cut, self.since + lost);
        self.loss.dropped += lost;
    }

    fn take(&mut self, frame: StreamFrame, found: &mut FrameSink<'_>) {
        // What came damaged is not missing.
        let dropped = std::mem::take(&mut self.since);
        if let (Some(count), Some(sequence)) = (&mut self.count, frame.sequence) {
            self.loss.missed += count.gap(sequence).saturating_sub(dropped);
        }
        let time_us = frame.time_us.zip(self.clock.as_mut()).map(|(time, clock)| clock.unwrapped(time));
        // A missing value is no zero.
        if !frame.values.iter().all(|value| value.is_finite()) {
            self.loss.dropped += 1;
            return;
        }
        let StreamFrame { arrival_us, sequence, .. } = frame;
        let mut placed = ArrayFrame { values: Vec::new(), arrival_us, time_us, sequence };
        self.order.place(&frame.values, &mut placed);
        found(placed);
    }
}
