//! What came over the wire.

use taxel_core::body::Placed;
use taxel_core::boot::Boot;
use taxel_core::format::Micros;
use taxel_core::wire::{
    Budget, ConfidenceReport, FormsReport, GestureReport, Health, IntentReport, Level, ReactionReport,
    ReflexReport, SelfTestReport, SymbolList, SyncReport, Temperature, UnsureReport, WireError,
};

/// Something that came; what lasts is then found in the [`Client`](super::Client).
#[derive(Debug, Clone, PartialEq)]
pub enum Event {
    /// Garment and scene are known, or known anew.
    Hello,
    /// How the board came to start; the `Hello` before it told the rest.
    Boot(Boot),
    /// A `Hello` that this program cannot use, and why.
    Unusable(String),
    /// A conditioned image.
    Frame {
        /// Number of the scan.
        frame: u32,
        /// Start of the scan.
        time: Micros,
        /// It stands alone.
        alone: bool,
        /// Whether it could be decoded.
        image: ImageNews,
    },
    /// Contacts; those that are there are in the client.
    Contacts {
        /// Number of the scan.
        frame: u32,
        /// Start of the scan.
        time: Micros,
        /// Contacts that did not fit.
        dropped: u16,
        /// Those that have gone.
        released: Vec<Placed>,
    },
    /// What was said of contacts.
    Symbols(Box<SymbolList>),
    /// What the touch means.
    Intent(Box<IntentReport>),
    /// Which gesture goes on; how sure that is, is found in the client.
    Gesture(GestureReport),
    /// How sure the gesture is that is told next.
    Confidence(ConfidenceReport),
    /// Which contacts may be drift; they are in the client, too.
    Unsure(Box<UnsureReport>),
    /// How old the forms are of the contacts that are told next; they are in the client, too.
    Forms(Box<FormsReport>),
    /// What the board was taught; the names are in the client, too.
    Shapes {
        /// Names of the classes; none: the built-in base is in force.
        names: Vec<String>,
        /// Prototypes.
        prototypes: u16,
    },
    /// Something the garment did by itself.
    Reaction(ReactionReport),
    /// A reaction began within a frame.
    Reflex(ReflexReport),
    /// Counters of the board.
    Health(Health),
    /// Where the board's time goes.
    Budget(Budget),
    /// How warm the board is.
    Temperature(Temperature),
    /// Which taxels are ill; they are in the client.
    HealthMap {
        /// The board's time.
        time: Micros,
        /// The map is complete; else more of it follows.
        whole: bool,
    },
    /// How lines and inputs are.
    SelfTest(SelfTestReport),
    /// A sentence of the board.
    Log {
        /// The board's time.
        time: Micros,
        /// How grave.
        level: Level,
        /// The sentence.
        text: String,
    },
    /// Answer to `Sync`.
    Sync(SyncReport),
    /// Answer to another request.
    Answer {
        /// Number of the request's variant; 255: it could not be read.
        request: u8,
        /// It was done; else why not.
        refusal: Option<String>,
    },
    /// Raw codes.
    Raw {
        /// Number of the scan.
        frame: u32,
        /// Start of the scan.
        time: Micros,
        /// They could be decoded.
        whole: bool,
    },
    /// Bytes that are no message.
    Refused(WireError),
}

/// Whether an image could be decoded; where not, the next that stands alone is asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ImageNews {
    /// Decoded, and the checksum of the board's own image is right.
    Whole,
    /// It differs from an image that did not come.
    NoBase,
    /// The code or the checksum is wrong.
    Wrong,
}
