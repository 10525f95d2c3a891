//! Who measures the stages.

/// Stages, in the order of the data path, for whoever measures them.
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

/// Is told when a stage begins.
pub trait Probe {
    /// `stage` begins, so the one before has ended.
    fn begin(&mut self, stage: Stage);
}

/// Nobody measures.
impl Probe for () {
    fn begin(&mut self, _: Stage) {}
}
