//! Requests: the messages to the board.

use crate::condition::Certificate;
use crate::fold::Posture;
use crate::format::Micros;
use crate::intent::Feed;
use crate::surface::{LINKS, LinkPose};
use heapless::Vec;
use serde::{Deserialize, Serialize};

/// Greatest length of a host's message: a garment, and its frame around it.
pub const LONGEST_REQUEST: usize = 3072;
/// Bytes of a piece of a table.
pub const TABLE_PIECE: usize = 256;

/// Greatest number of prototypes of an `AddShapes`.
pub const SHAPES_ADDED: usize = 64;

/// Declares the requests with their numbers.
macro_rules! requests {
    ($(
        $(#[$doc:meta])+
        $number:literal $name:ident $(($body:ty))? $({ $($(#[$field_doc:meta])+ $field:ident: $type:ty,)+ })?;
    )+) => {
        /// A message to the board.
        #[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
        #[allow(clippy::large_enum_variant)] // used where it is decoded, never stored
        pub enum Request<'a> {
            $($(#[$doc])+ $name $(($body))? $({ $($(#[$field_doc])+ $field: $type,)+ })?,)+
        }

        impl Request<'_> {
            /// Number of the variant.
            pub const fn number(&self) -> u8 {
                match self { $(Request::$name { .. } => $number,)+ }
            }
        }

        /// Name of each request, by number.
        pub const REQUESTS: &[&str] = &[$(stringify!($name),)+];
    };
}

// The numbers are those of the variants. A number is never used for anything else; a new request is appended.
requests! {
    /// Start streaming.
    0 Start;
    /// Stop streaming.
    1 Stop;
    /// Report the board's time.
    2 Sync {
        /// Returned in the answer.
        token: u32,
    };
    /// Send the next image alone.
    3 KeyFrame;
    /// Send more than the scene's stream has, until the next such request or a restart. It is not saved: a
    /// board must not start with a flood.
    4 Stream {
        /// Frames of raw codes per second; 0: never; 65535: with every scan.
        raw_hz: u16,
        /// `Budget` reports per second; 0: never; 65535: with every scan; 1 at the start.
        budget_hz: u16,
    };
    /// postcard of a [`Garment`](crate::garment::Garment)
    5 SetGarment(&'a [u8]);
    /// postcard of a [`Scene`](crate::scene::Scene)
    6 SetScene(&'a [u8]);
    /// postcard of a [`TablePiece`]
    7 SetTable(&'a [u8]);
    /// postcard of a [`GalleryHead`](crate::shape::GalleryHead), whose prototypes follow; empty: back to the
    /// built-in base
    8 SetShapes(&'a [u8]);
    /// postcard of a list of at most [`SHAPES_ADDED`] [`Exemplar`](crate::shape::Exemplar)s of that gallery.
    /// With the last one the gallery is in force, or refused and dropped.
    9 AddShapes(&'a [u8]);
    /// Set the gains of taxels from number `first` on, Q4.12 (4096 is 1.0).
    10 SetGain {
        /// Number of the first taxel.
        first: u16,
        /// The gains.
        gains: Vec<u16, 64>,
    };
    /// Name the calibration of the gains that were set. `Hello` has it until a gain or the garment changes.
    11 SetCalibration(Certificate);
    /// Take the mean of the next `frames` frames as the baseline; refused while something touches.
    12 Tare {
        /// 1 ..= 4096
        frames: u16,
    };
    /// Examine lines and inputs, and judge all taxels anew: faulty ones count as good until a fault is found
    /// again.
    13 SelfTest;
    /// Store garment, scene and calibration.
    14 Save;
    /// Set the stored settings aside, or restore them; the board restarts once it has answered. Settings that
    /// are set aside are kept until the next `Save`.
    15 ResetSettings {
        /// True: restore them.
        undo: bool,
    };
    /// Positions of the robot's joints.
    16 Posture(Posture);
    /// postcard of [`Poses`]: for places and forces in the robot's frame. A pose lasts until the next one for
    /// its link. A link that moves is carried on to the time of each frame, for
    /// [`CARRIED_US`](crate::surface::CARRIED_US) at most.
    17 SetPoses(&'a [u8]);
    /// Set a concept that the host feeds, with the age of the value and the value to use when that is too
    /// old, or when the host has been silent for 3 s.
    18 Feed(Feed);
}

/// A piece of a table, which is stored in flash. Pieces come in order, each after the answer to the one before.
/// With the last one the table is checked and, from then on and after each start, in force; until then the one
/// before it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct TablePiece<'a> {
    /// Content of the table.
    pub kind: TableKind,
    /// Length of the whole table; 0: none is in force from now on.
    pub length: u32,
    /// Position of the piece: 0 begins a table.
    pub offset: u32,
    /// [`TABLE_PIECE`] bytes, or what is left.
    pub bytes: &'a [u8],
}

/// Content of a table in flash.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum TableKind {
    /// Places of the taxels, see [`Table`](crate::surface::Table).
    Surface,
    /// Pressure of the garment's folds, see [`FoldTable`](crate::fold::FoldTable).
    Folds,
}

/// Content of a `SetPoses`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Poses {
    /// The board's time of the poses; none: when they arrive.
    pub at: Option<Micros>,
    /// Links of the surface.
    pub links: Vec<LinkPose, LINKS>,
}
