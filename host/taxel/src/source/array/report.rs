//! The port of a perceived array: the bytes of its board, and what is reported of its frames.

use super::super::Port;
use super::super::pipe::HostEnd;
use super::super::shared::Shared;
use super::frame::ArrayLoss;
use super::original::{OriginalBytes, OriginalQueue};
use crate::time::Instant;
use std::io;
use std::sync::Arc;
use std::time::Duration;

/// Time between two reports of losses.
const REPORTED: Duration = Duration::from_secs(5);
/// Time after which bytes without any frame are reported.
const FRAMELESS: Duration = Duration::from_secs(3);

/// Counts of what an array has sent.
#[derive(Debug, Default)]
pub struct ArrayReport {
    /// Bytes.
    pub bytes: u64,
    /// Frames that were perceived.
    pub frames: u64,
    /// Frames that were not.
    pub loss: ArrayLoss,
    /// Limits of contacts by the measured noise, in words.
    pub limits: Option<String>,
    /// Reason why a frame cannot be perceived, or why the link has ended.
    pub fault: Option<String>,
    /// What came, for whoever records it.
    pub original: OriginalQueue,
}

impl ArrayReport {
    /// Losses in words; none without any.
    fn lost(&self) -> Option<String> {
        let ArrayLoss { dropped, missed } = self.loss;
        let (frames, unkept) = (self.frames, self.original.dropped);
        let frames = (dropped + missed > 0)
            .then(|| format!("{frames} frames came whole, {dropped} damaged, and {missed} did not come"));
        let unkept = (unkept > 0)
            .then(|| format!("{unkept} of its bytes were not kept, because the disk is too slow"));
        let both: Vec<String> = [frames, unkept].into_iter().flatten().collect();
        (!both.is_empty()).then(|| both.join("; "))
    }
}

/// The port of a perceived array.
pub struct ArrayPort {
    host: HostEnd,
    report: Arc<Shared<ArrayReport>>,
    /// Words about the sensor; none once they were reported.
    about: Option<String>,
    loss: ArrayLoss,
    reported: Instant,
    /// Time of its opening; none once frames have come, or their absence was reported.
    opened: Option<Instant>,
}

impl ArrayPort {
    /// A port of the board at the other end, which begins with some words about the sensor.
    pub fn new(host: HostEnd, report: Arc<Shared<ArrayReport>>, about: String) -> ArrayPort {
        let now = Instant::now();
        ArrayPort {
            host,
            report,
            about: Some(about),
            loss: ArrayLoss::default(),
            reported: now,
            opened: Some(now),
        }
    }
}

impl Port for ArrayPort {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<Option<usize>> {
        self.host.read(buffer)
    }

    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.host.write(bytes)
    }

    fn news(&mut self) -> Option<String> {
        if let Some(about) = self.about.take() {
            return Some(about);
        }
        let mut report = self.report.lock();
        if let Some(text) = report.limits.take().or_else(|| report.fault.take()) {
            return Some(text);
        }
        if let Some(opened) = self.opened
            && (report.frames > 0 || opened.elapsed() > FRAMELESS && report.bytes > 0)
        {
            self.opened = None;
            let bytes = report.bytes;
            return (report.frames == 0).then(|| {
                format!("{bytes} bytes came, and no frame: format, rows, columns or speed may be others")
            });
        }
        if report.loss != self.loss && self.reported.elapsed() > REPORTED {
            (self.loss, self.reported) = (report.loss, Instant::now());
            return report.lost();
        }
        None
    }

    fn original(&mut self) -> Vec<OriginalBytes> {
        self.report.lock().original.take()
    }

    fn remark(&self) -> Option<String> {
        self.report.lock().lost()
    }
}
