//! Bytes that wait to be decoded, with their arrival times.

/// Bytes in the order of their arrival.
#[derive(Debug, Default)]
pub struct TimedBytes {
    bytes: Vec<u8>,
    /// Number of bytes up to each arrival, and its time.
    arrivals: Vec<(usize, u64)>,
}

impl TimedBytes {
    /// Appends bytes.
    pub fn push(&mut self, bytes: &[u8], arrival_us: u64) {
        self.bytes.extend_from_slice(bytes);
        self.arrivals.push((self.bytes.len(), arrival_us));
    }

    /// The bytes.
    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// Arrival time of a byte, us.
    pub fn arrival(&self, at: usize) -> u64 {
        let index = self.arrivals.partition_point(|(end, _)| *end <= at);
        self.arrivals.get(index).or(self.arrivals.last()).map_or(0, |(_, time)| *time)
    }

    /// Drops the first bytes.
    pub(crate) fn consume(&mut self, count: usize) {
        self.bytes.drain(..count.min(self.bytes.len()));
        self.arrivals.retain_mut(|(end, _)| {
            let stays = *end > count;
            *end = end.saturating_sub(count);
            stays
        });
    }
}
