//! Events from the wire.

use std::time::Duration;
use taxel_core::body::Placed;
use taxel_core::format::Micros;
use taxel_core::wire::{
    Budget, FoldsReport, GestureReport, Health, IntentReport, Level, PressingReport, ReactionReport,
    ReflexReport, RegionsReport, SelfTestReport, StartOfFrame, SymbolList, SyncReport, Temperature,
    WireError,
};

/// An event; persistent state is found in the [`Client`](super::Client).
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Event {
    /// Garment, scene and the cause of the board's start were received.
    Hello,
    /// A `Hello` that this program cannot use, and why.
    Unusable(String),
    /// A conditioned image.
    Frame {
        /// Number of the scan.
        frame: u32,
        /// Start of the scan.
        time: Micros,
        /// True for a key frame.
        alone: bool,
        /// Result of decoding.
        image: ImageNews,
    },
    /// Contacts; the present ones are in the client.
    Contacts {
        /// Number of the scan.
        frame: u32,
        /// Start of the scan.
        time: Micros,
        /// Number of contacts that did not fit.
        dropped: u16,
        /// Released contacts.
        released: Vec<Placed>,
        /// Ids of the contacts that may be drift since this list; those that may be now are in the client.
        doubted: Vec<u32>,
    },
    /// Symbols of contacts.
    Symbols(Box<SymbolList>),
    /// Intention of the touch.
    Intent(Box<IntentReport>),
    /// Gesture of a touch.
    Gesture(GestureReport),
    /// Contacts and forces on the robot.
    Pressing(Box<PressingReport>),
    /// Expected pressure of the garment's folds.
    Folds(Box<FoldsReport>),
    /// Touch state of each region of the robot's surface; the names are in the client.
    Regions(Box<RegionsReport>),
    /// The base of shapes; the names are in the client, too.
    Shapes {
        /// Names of the classes; empty while the built-in base is in use.
        names: Vec<String>,
        /// Number of prototypes.
        prototypes: u16,
    },
    /// A reaction of the garment.
    Reaction(ReactionReport),
    /// A reaction within a frame.
    Reflex(ReflexReport),
    /// Counters of the board.
    Health(Health),
    /// Time budget of the board.
    Budget(Budget),
    /// Temperature of the board.
    Temperature(Temperature),
    /// Faulty taxels; they are in the client.
    HealthMap {
        /// The board's time.
        time: Micros,
        /// The map is complete; else more parts follow.
        whole: bool,
    },
    /// State of lines and inputs.
    SelfTest(SelfTestReport),
    /// A log message of the board.
    Log {
        /// The board's time.
        time: Micros,
        /// Severity.
        level: Level,
        /// Text.
        text: String,
    },
    /// Answer to `Sync`.
    Sync(SyncReport),
    /// Start of a frame of the USB.
    StartOfFrame(StartOfFrame),
    /// Answer to another request.
    Answer {
        /// Number of the request; 255 if it was unreadable.
        request: u8,
        /// Reason why it was refused; none if it was done.
        refusal: Option<String>,
    },
    /// Raw codes.
    Raw {
        /// Number of the scan.
        frame: u32,
        /// Start of the scan.
        time: Micros,
        /// True if they could be decoded.
        whole: bool,
    },
    /// Bytes that are not a message.
    Refused(WireError),
    /// The link to the board is lost, and waited for. What was present has ended just before: events of the host's own
    /// say so, as the board would.
    Lost {
        /// The reason, a sentence.
        why: String,
        /// Host time at which the board was last heard, us since 1970.
        since_us: u64,
    },
    /// The lost board is back, and its settings are restored.
    Back {
        /// Sentence on whether it had restarted and what was set again.
        how: String,
        /// Time for which it was lost.
        after: Duration,
    },
    /// Another board answers in its place; see [`Identity`](super::Identity). Unless it is refused, all that follows is
    /// of this one, and no setting of the other is sent to it.
    Other {
        /// Sentence on how it differs.
        why: String,
    },
    /// A remark of the host about the link.
    Note {
        /// The board's time, as it was reported last.
        time: Micros,
        /// Severity.
        level: Level,
        /// Text.
        text: String,
    },
}

impl Event {
    /// Sentence of the host's own about the link; none of all else.
    pub fn remark(&self) -> Option<&str> {
        match self {
            Event::Lost { why: text, .. }
            | Event::Back { how: text, .. }
            | Event::Other { why: text }
            | Event::Note { text, .. } => Some(text),
            _ => None,
        }
    }
}

/// Result of decoding an image; on failure the next key frame is requested.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ImageNews {
    /// Decoded, with the board's checksum.
    Whole,
    /// Image whose base image is missing.
    NoBase,
    /// Code or checksum is wrong.
    Wrong,
}
