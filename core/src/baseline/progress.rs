//! Progress of a tare.

/// Progress of a tare, as reported.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub enum Tare {
    /// No tare was requested, or the last one has been reported as done.
    #[default]
    Idle,
    /// The image is zero until the tare ends.
    Running {
        /// frames still to come
        left: u16,
    },
    /// The last frame completed it: the next one uses the new baseline.
    Done,
}

/// State of a tare.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Progress {
    pub(crate) tare: Tare,
    /// Number of frames of the tare.
    pub(crate) frames: u16,
    /// Panels being tared; set by its first frame.
    pub(crate) panels: Option<u8>,
    pub(crate) tared: bool,
}

impl Progress {
    pub(crate) const fn new() -> Self {
        Progress { tare: Tare::Idle, frames: 0, panels: None, tared: false }
    }

    pub(crate) const fn tare(&self) -> Tare {
        self.tare
    }

    pub(crate) const fn mark_tared(&mut self) {
        self.tared = true;
    }

    pub(crate) const fn request(&mut self, frames: u16) {
        self.tare = Tare::Running { left: frames };
        self.frames = frames;
        self.panels = None;
    }
}
