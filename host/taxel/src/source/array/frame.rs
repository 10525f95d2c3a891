//! A frame of an array, and what was lost.

/// One frame: raw values in the order of the panel, row by row from the top left.
#[derive(Debug, Clone, PartialEq)]
pub struct ArrayFrame {
    /// One for each taxel, before range and direction.
    pub values: Vec<f64>,
    /// Host's arrival time of its last byte, us.
    pub arrival_us: u64,
    /// The sensor's own time, us since any moment; none if it sends none.
    pub time_us: Option<u64>,
    /// The sensor's own number; none if it sends none.
    pub sequence: Option<u32>,
}

/// Frames that were not delivered.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub struct ArrayLoss {
    /// Frames that came damaged.
    pub dropped: u64,
    /// Frames that the sensor numbered and that did not come.
    pub missed: u64,
}

/// A frame in the order of the stream.
#[derive(Debug, Default, PartialEq)]
pub(super) struct StreamFrame {
    pub values: Vec<f64>,
    pub arrival_us: u64,
    /// The sensor's time, us; it may have wrapped.
    pub time_us: Option<u64>,
    pub sequence: Option<u32>,
}
