//! Measurement of the stages.

/// Stages to measure, in the order of the data path.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u8)]
pub enum Stage {
    /// outside the pipeline
    Idle = 0,
    /// baseline, calibration, filter
    Condition = 1,
    /// labels, moments, tracking
    Contact = 2,
    /// NMI, k-NN, place on the body
    Shape = 3,
    /// words, region states and touch over time
    Symbol = 4,
    /// the cognitive map
    Intent = 5,
    /// the table of reactions
    React = 6,
    /// encoding of messages
    Encode = 7,
    /// reading the garment
    Scan = 8,
}

/// Observer of the stages.
pub trait Probe {
    /// Called when `stage` begins, and the previous one has ended.
    fn begin(&mut self, stage: Stage);
}

/// No measurement.
impl Probe for () {
    fn begin(&mut self, _: Stage) {}
}
