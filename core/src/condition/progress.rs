//! How far a tare is.

/// How far a tare is.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub enum Tare {
    /// None has been asked for, or the last has been reported as done.
    #[default]
    Idle,
    /// The image is zero until so many more frames have been taken in.
    Running {
        /// frames still to come
        left: u16,
    },
    /// The last frame completed it: the next one is measured from the new baseline.
    Done,
}

/// Progress of a tare.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Progress {
    pub(super) tare: Tare,
    /// Frames of the tare.
    pub(super) frames: u16,
    /// Panels that are being tared; latched at its first frame.
    pub(super) panels: Option<u8>,
    pub(super) tared: bool,
}

impl Progress {
    pub(super) const fn new() -> Self {
        Progress { tare: Tare::Idle, frames: 0, panels: None, tared: false }
    }

    pub(super) const fn tare(&self) -> Tare {
        self.tare
    }

    pub(super) const fn mark_tared(&mut self) {
        self.tared = true;
    }

    pub(super) const fn request(&mut self, frames: u16) {
        self.tare = Tare::Running { left: frames };
        self.frames = frames;
        self.panels = None;
    }
}
