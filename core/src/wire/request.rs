//! Requests: the messages to the board.

use crate::condition::Certificate;
use crate::fold::Posture;
use crate::format::Q15;
use crate::gesture::GestureConfig;
use crate::intent::Feed;
use heapless::Vec;
use serde::{Deserialize, Serialize};

/// Greatest length of a host's message: a garment, and its frame around it.
pub const LONGEST_REQUEST: usize = 3072;
/// Bytes of a piece of a table.
pub const TABLE_PIECE: usize = 256;

/// Greatest number of prototypes of an `AddShapes`.
pub const SHAPES_ADDED: usize = 64;

/// A message to the board. Variants are only appended.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[allow(clippy::large_enum_variant)] // used where it is decoded, never stored
pub enum Request<'a> {
    /// postcard of a [`Garment`](crate::garment::Garment)
    SetGarment(&'a [u8]),
    /// postcard of a [`Scene`](crate::scene::Scene)
    SetScene(&'a [u8]),
    /// Take the mean of the next `frames` frames as the baseline; refused while something touches.
    Tare {
        /// 1 ..= 4096
        frames: u16,
    },
    /// Start streaming.
    Start,
    /// Stop streaming.
    Stop,
    /// Report the board's time.
    Sync {
        /// Returned in the answer.
        token: u32,
    },
    /// Positions of the robot's joints.
    Posture(Posture),
    /// Set a concept that the host feeds, until the next value, or until the host has been silent for 3 s:
    /// then 0.
    Concept {
        /// Slot of the map's input.
        slot: u8,
        /// -1 ..= 1
        value: Q15,
    },
    /// Send the next image alone.
    KeyFrame,
    /// Examine lines and inputs, and judge all taxels anew: faulty ones count as good until a fault is found
    /// again.
    SelfTest,
    /// Store garment, scene and calibration.
    Save,
    /// Set the gains of taxels from number `first` on, Q4.12 (4096 is 1.0).
    SetGain {
        /// Number of the first taxel.
        first: u16,
        /// The gains.
        gains: Vec<u16, 64>,
    },
    /// Set the rate of `Budget` reports.
    Budget {
        /// Rate per second; 0: never, 65535: with each frame.
        hz: u16,
    },
    /// Set a concept that the host feeds, with the age of the value and the value to use when that is too
    /// old, or when the host has been silent for 3 s.
    Feed(Feed),
    /// Set the recognition of gestures; none turns it off, as at the start. Not a part of the scene.
    SetGestures(Option<GestureConfig>),
    /// Name the calibration of the gains that were set. `Hello` has it until a gain or the garment changes.
    SetCalibration(Certificate),
    /// postcard of a [`GalleryHead`](crate::shape::GalleryHead), whose prototypes follow; empty: back to the
    /// built-in base
    SetShapes(&'a [u8]),
    /// postcard of a list of at most [`SHAPES_ADDED`] [`Exemplar`](crate::shape::Exemplar)s of that gallery.
    /// With the last one the gallery is in force, or refused and dropped.
    AddShapes(&'a [u8]),
    /// Set the confidence that the announcement of a gesture needs, in thousandths, at most 999; 0 at the
    /// start. Not a part of the scene; `SetGestures` does not change it.
    SetCertainty(u16),
    /// Set the stored settings aside, or restore them; the board restarts once it has answered. Settings that
    /// are set aside are kept until the next `Save`.
    ResetSettings {
        /// True: restore them.
        undo: bool,
    },
    /// Set the number of forms that are measured in a frame. Not a part of the scene; `SetScene` does not
    /// change it.
    SetForms {
        /// Number of held contacts that have their turn in a frame; 0: all; 1 at the start.
        in_frame: u8,
        /// True: send [`FormsReport`](super::FormsReport)s.
        ages: bool,
    },
    /// Set the rate of raw codes beside those of the scene, until the next such request. Nothing else
    /// changes.
    SetRaw {
        /// Rate per second; 0: that of the scene; 65535: with every scan.
        hz: u16,
    },
    /// postcard of a [`TablePiece`], which is stored in flash. Pieces come in order, each after the answer to
    /// the one before. With the last one the table is checked and, from then on and after each start, in
    /// force; until then the one before it is.
    SetSurface(&'a [u8]),
    /// postcard of at most [`LINKS`](crate::surface::LINKS) links of the surface, each its name and its
    /// [`Pose`](crate::surface::Pose): for places and forces in the robot's frame. A pose lasts until the
    /// next one for its link.
    SetPoses(&'a [u8]),
    /// Set the rate of [`PressingReport`](super::PressingReport)s per second; 0, as at the start: never;
    /// 65535: with every scan.
    SetPressing(u16),
    /// postcard of a [`TablePiece`] of the table of folds; as `SetSurface`.
    SetFolds(&'a [u8]),
    /// postcard of the board's time of the poses, and of a list of
    /// [`MovingPose`](crate::surface::MovingPose)s: as `SetPoses`, of links that move. The board carries them
    /// on to the time of each frame, for [`CARRIED_US`](crate::surface::CARRIED_US) at most.
    MovePoses(&'a [u8]),
}

/// A piece of a [`Table`](crate::surface::Table) of the surface, or of a
/// [`FoldTable`](crate::fold::FoldTable).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct TablePiece<'a> {
    /// Length of the whole table; 0: none is in force from now on.
    pub length: u32,
    /// Position of the piece: 0 begins a table.
    pub offset: u32,
    /// [`TABLE_PIECE`] bytes, or what is left.
    pub bytes: &'a [u8],
}

impl Request<'_> {
    /// Number of the variant.
    pub const fn number(&self) -> u8 {
        match self {
            Request::SetGarment(_) => 0,
            Request::SetScene(_) => 1,
            Request::Tare { .. } => 2,
            Request::Start => 3,
            Request::Stop => 4,
            Request::Sync { .. } => 5,
            Request::Posture(_) => 6,
            Request::Concept { .. } => 7,
            Request::KeyFrame => 8,
            Request::SelfTest => 9,
            Request::Save => 10,
            Request::SetGain { .. } => 11,
            Request::Budget { .. } => 12,
            Request::Feed(_) => 13,
            Request::SetGestures(_) => 14,
            Request::SetCalibration(_) => 15,
            Request::SetShapes(_) => 16,
            Request::AddShapes(_) => 17,
            Request::SetCertainty(_) => 18,
            Request::ResetSettings { .. } => 19,
            Request::SetForms { .. } => 20,
            Request::SetRaw { .. } => 21,
            Request::SetSurface(_) => 22,
            Request::SetPoses(_) => 23,
            Request::SetPressing(_) => 24,
            Request::SetFolds(_) => 25,
            Request::MovePoses(_) => 26,
        }
    }
}
