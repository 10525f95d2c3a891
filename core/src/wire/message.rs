//! The two enums of the wire.

use crate::body::Placed;
use crate::boot::Boot;
use crate::condition::Certificate;
use crate::fold::Posture;
use crate::format::{Celsius, Micros, Name, Q15};
use crate::garment::PANELS;
use crate::gesture::GestureConfig;
use crate::health::TaxelHealth;
use crate::intent::{CONCEPTS, Feed, Leading, Outcome};
use crate::pipeline::CONTACTS;
use crate::react::Reaction;
use crate::selftest::Findings;
use crate::shape::GALLERY_CLASSES;
use crate::symbol::{EVENTS, RegionState, Symbol};
use heapless::Vec;
use serde::{Deserialize, Serialize};

/// First bytes of a `Hello`.
pub const MAGIC: [u8; 4] = *b"TAXL";
/// Version of the protocol.
pub const PROTOCOL: u16 = 1;
/// Longest message of a host: a garment, and its frame around it.
pub const LONGEST_REQUEST: usize = 3072;

/// Most prototypes of an `AddShapes`.
pub const SHAPES_ADDED: usize = 64;

/// What the board tells the host; numbered as in the [module's](super) table.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[allow(clippy::large_enum_variant)] // read where it is used, never stored
pub enum Report<'a> {
    /// Who is there.
    #[serde(borrow)]
    Hello(Hello<'a>),
    /// A conditioned image.
    #[serde(borrow)]
    Frame(Frame<'a>),
    /// Contacts.
    Contacts(ContactList),
    /// Symbols.
    Symbols(SymbolList),
    /// What the touch means.
    Intent(IntentReport),
    /// Something the garment did by itself.
    Reaction(ReactionReport),
    /// How the board is.
    Health(Health),
    /// A sentence for people.
    #[serde(borrow)]
    Log(Log<'a>),
    /// Answer to `Sync`.
    Sync(SyncReport),
    /// Answer to a request.
    #[serde(borrow)]
    Answer(Answer<'a>),
    /// Raw codes.
    #[serde(borrow)]
    Raw(Raw<'a>),
    /// Where the time goes.
    Budget(Budget),
    /// Which taxels are ill.
    HealthMap(HealthMap),
    /// How warm it is.
    Temperature(Temperature),
    /// How lines and inputs are.
    SelfTest(SelfTestReport),
    /// Which gesture goes on.
    Gesture(GestureReport),
    /// Which shapes the board was taught.
    Shapes(ShapesReport),
    /// A reaction began within a frame.
    Reflex(ReflexReport),
    /// How sure the gesture is that is told next.
    Confidence(ConfidenceReport),
    /// How the board came to start.
    Boot(Boot),
    /// Which contacts may be drift.
    Unsure(UnsureReport),
    /// How old the forms of the contacts are that are told next.
    Forms(FormsReport),
}

/// Numbers of the variants. postcard writes `(number, &body)` as it writes the variant, and nothing large is
/// moved into one.
impl Report<'_> {
    /// Of `Hello`.
    pub const HELLO: u32 = 0;
    /// Of `Frame`.
    pub const FRAME: u32 = 1;
    /// Of `Contacts`.
    pub const CONTACTS: u32 = 2;
    /// Of `Symbols`.
    pub const SYMBOLS: u32 = 3;
    /// Of `Intent`.
    pub const INTENT: u32 = 4;
    /// Of `Reaction`.
    pub const REACTION: u32 = 5;
    /// Of `Health`.
    pub const HEALTH: u32 = 6;
    /// Of `Log`.
    pub const LOG: u32 = 7;
    /// Of `Sync`.
    pub const SYNC: u32 = 8;
    /// Of `Answer`.
    pub const ANSWER: u32 = 9;
    /// Of `Raw`.
    pub const RAW: u32 = 10;
    /// Of `Budget`.
    pub const BUDGET: u32 = 11;
    /// Of `HealthMap`.
    pub const HEALTH_MAP: u32 = 12;
    /// Of `Temperature`.
    pub const TEMPERATURE: u32 = 13;
    /// Of `SelfTest`.
    pub const SELF_TEST: u32 = 14;
    /// Of `Gesture`.
    pub const GESTURE: u32 = 15;
    /// Of `Shapes`.
    pub const SHAPES: u32 = 16;
    /// Of `Reflex`.
    pub const REFLEX: u32 = 17;
    /// Of `Confidence`.
    pub const CONFIDENCE: u32 = 18;
    /// Of `Boot`.
    pub const BOOT: u32 = 19;
    /// Of `Unsure`.
    pub const UNSURE: u32 = 20;
    /// Of `Forms`.
    pub const FORMS: u32 = 21;
}

/// Frozen.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Hello<'a> {
    /// [`MAGIC`]
    pub magic: [u8; 4],
    /// [`PROTOCOL`]
    pub protocol: u16,
    /// postcard of the [`Garment`](crate::garment::Garment)
    pub garment: &'a [u8],
    /// UTF-8
    pub firmware: &'a [u8],
    /// postcard of [`Micros`]: the board's time
    pub clock: &'a [u8],
    /// postcard of the [`Scene`](crate::scene::Scene)
    pub scene: &'a [u8],
    /// UTF-8: id, date, fit error of the calibration in force; empty: counts
    pub calibration: &'a [u8],
}

/// A conditioned image.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Frame<'a> {
    /// Number of the scan.
    pub frame: u32,
    /// Start of the scan.
    pub time: Micros,
    /// Frame that it differs from; none: it stands alone.
    pub base: Option<u32>,
    /// [`image_sum`](super::image_sum) of the image.
    pub sum: u32,
    /// The image, see [`encode_image`](super::encode_image).
    pub data: &'a [u8],
}

/// Raw codes.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Raw<'a> {
    /// Number of the scan.
    pub frame: u32,
    /// Start of the scan.
    pub time: Micros,
    /// The codes, coded as an image alone.
    pub data: &'a [u8],
}

/// Contacts of a frame.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct ContactList {
    /// Number of the scan that the newest state is of.
    pub frame: u32,
    /// Start of that scan.
    pub time: Micros,
    /// Contacts that did not fit.
    pub dropped: u16,
    /// Present contacts, and all that have gone since the last list.
    pub contacts: Vec<Placed, LISTED>,
}

/// Most contacts of a list: all that can be present, and as many that have gone.
pub const LISTED: usize = 2 * CONTACTS;

/// What was said of contacts.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct SymbolList {
    /// Number of the scan.
    pub frame: u32,
    /// Start of the scan.
    pub time: Micros,
    /// Onsets, changes of words, releases.
    pub events: Vec<Symbol, EVENTS>,
    /// Regions that are touched.
    pub regions: Vec<RegionState, PANELS>,
}

/// What the touch means.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct IntentReport {
    /// Number of the scan.
    pub frame: u32,
    /// Start of the scan.
    pub time: Micros,
    /// The announced intention.
    pub leading: Leading,
    /// How the inference ended.
    pub outcome: Outcome,
    /// Its steps.
    pub steps: u16,
    /// Activation of each concept of the scene's map.
    pub concepts: Vec<Q15, CONCEPTS>,
}

/// Something the garment did by itself.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct ReactionReport {
    /// Number of the scan.
    pub frame: u32,
    /// Start of the scan.
    pub time: Micros,
    /// What.
    pub reaction: Reaction,
}

/// How the board is. Counters start with the board.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Health {
    /// The board's time.
    pub time: Micros,
    /// Finished scans.
    pub scans: u32,
    /// Scans that failed.
    pub failed: u32,
    /// Frames that the converter produced and nobody fetched.
    pub overruns: u32,
    /// Images that were due and not sent, because the link had no room.
    pub thinned_frames: u32,
    /// Contact updates that were due and not sent.
    pub thinned_contacts: u32,
    /// Guaranteed messages that found no place to wait.
    pub lost: u32,
    /// Received frames that were refused.
    pub refused: u32,
    /// Duration of the last scan, us.
    pub scan_us: u32,
    /// Duration of the last perception, us.
    pub process_us: u32,
}

/// Where the time of frames went: of each kind the most that any of them took, all that was done until the
/// next frame included.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Budget {
    /// Number of the last scan of these.
    pub frame: u32,
    /// Start of that scan.
    pub time: Micros,
    /// How many they are: 1, or all since the last such report.
    pub frames: u16,
    /// Duration of the scan, us. The next one goes on meanwhile.
    pub scan_us: u32,
    /// From the codes to the reactions, us.
    pub process_us: u32,
    /// Messages were encoded and handed to the link, us.
    pub encode_us: u32,
    /// A message waited for room on the link, us. The processor was not held up by that.
    pub send_us: u32,
    /// As in [`Health`].
    pub overruns: u32,
    /// As in [`Health`].
    pub thinned_frames: u32,
}

/// How warm the converter is, which a sheet beside it follows slowly.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Temperature {
    /// Start of the scan in which it was measured.
    pub time: Micros,
    /// One sample of the converter's thermometer, which may be several degrees off but tells changes.
    pub celsius: Celsius,
}

/// Which taxels are ill, of some that follow each other; those that are not named are good.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct HealthMap {
    /// The board's time.
    pub time: Micros,
    /// First taxel that this message speaks of.
    pub first: u16,
    /// Taxel after the last of them: the garment has no more, or another message goes on there.
    pub end: u16,
    /// The ill ones, ascending.
    pub taxels: Vec<Ill, 64>,
}

/// Taxels with following numbers that are ill of the same.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Ill {
    /// Number of the first.
    pub first: u16,
    /// How many, at least 1.
    pub count: u16,
    /// What is wrong with them.
    pub health: TaxelHealth,
}

/// How lines and inputs are.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct SelfTestReport {
    /// The board's time at the end of the self-test.
    pub time: Micros,
    /// What it has found.
    pub findings: Findings,
}

/// Which gesture goes on, as the model says that was asked for with `SetGestures`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct GestureReport {
    /// Number of the scan.
    pub frame: u32,
    /// Start of the scan.
    pub time: Micros,
    /// Number of the touch, from 1.
    pub touch: u32,
    /// Index of the panel that is touched.
    pub panel: u8,
    /// Class of the model, from 0.
    pub class: u8,
    /// Its name.
    pub name: Name,
    /// What it scores, Q18.
    pub score: i32,
    /// By how much it scores more than the second, Q18.
    pub lead: u32,
    /// For how long the touch was observed, ms.
    pub observed_ms: u32,
    /// The touch is over, and this is what it was as a whole.
    pub ended: bool,
}

/// How sure the [`GestureReport`] is that follows, which is of the same frame and touch. Not told where the
/// model does not know.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct ConfidenceReport {
    /// Number of the scan.
    pub frame: u32,
    /// Start of the scan.
    pub time: Micros,
    /// Number of the touch, from 1.
    pub touch: u32,
    /// The share of touches of that age and lead that are of that class.
    pub confidence: Q15,
}

/// Contacts whose baseline is unsure: all of each may be drift, and no intention follows from it. See
/// [`unsure`](crate::unsure).
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct UnsureReport {
    /// Number of the scan.
    pub frame: u32,
    /// Start of the scan.
    pub time: Micros,
    /// Ids of those that are unsure now; one that is not among them is sure, or has gone.
    pub contacts: Vec<u32, CONTACTS>,
}

/// How old the forms of contacts are, if [`Request::SetForms`] asked for it; told before the [`ContactList`]
/// of that frame, where one of them is not of it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct FormsReport {
    /// Number of the scan.
    pub frame: u32,
    /// Start of the scan.
    pub time: Micros,
    /// Ids of those whose form is not of this frame, with the frames since it was looked at; 255: at least so
    /// many.
    pub ages: Vec<(u32, u8), LISTED>,
}

/// Which shapes the board was taught: the class of a contact is 1 + its place among these names.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct ShapesReport {
    /// Prototypes of the gallery in force; 0: the built-in base is.
    pub prototypes: u16,
    /// Names of its classes.
    pub names: Vec<Name, GALLERY_CLASSES>,
}

/// A reaction began before its frame was complete. The `Reaction` itself follows it, or was told with a frame
/// that showed the cause.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct ReflexReport {
    /// Number of the scan in which it began.
    pub frame: u32,
    /// When the sub-field had been read that decided: the pin was asserted at once.
    pub time: Micros,
    /// Row of the scene's table.
    pub index: u8,
    /// Number of the taxel that decided.
    pub taxel: u16,
    /// Its pressure, counts.
    pub value: u16,
    /// The taxel that agrees, where two have to.
    pub other: Option<u16>,
}

/// How grave a sentence is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Level {
    /// good to know
    Info,
    /// something does not work as asked
    Warn,
    /// something does not work
    Error,
}

/// A sentence for people.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Log<'a> {
    /// The board's time.
    pub time: Micros,
    /// How grave.
    pub level: Level,
    /// The sentence.
    pub text: &'a str,
}

/// Answer to `Sync`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct SyncReport {
    /// As in the request.
    pub token: u32,
    /// The board's time when the request was read.
    pub received: Micros,
    /// The board's time when this answer was handed to the link.
    pub sent: Micros,
}

/// Answer to a request.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Answer<'a> {
    /// Number of the request's variant; 255: it could not be read.
    pub request: u8,
    /// It was done; else why not.
    pub refusal: Option<&'a str>,
}

/// What the host asks of the board. Variants are only appended.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[allow(clippy::large_enum_variant)] // read where it is obeyed, never stored
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
    /// Stream.
    Start,
    /// Stop streaming.
    Stop,
    /// Tell the time.
    Sync {
        /// comes back
        token: u32,
    },
    /// How the robot's joints stand.
    Posture(Posture),
    /// Value of a concept that the host feeds, until the next one, or until the host says nothing for 3 s: 0
    /// then.
    Concept {
        /// slot of the map's input
        slot: u8,
        /// -1 ..= 1
        value: Q15,
    },
    /// The next image is to stand alone.
    KeyFrame,
    /// Examine lines and inputs, and judge all taxels anew: those that were ill count as good until they are
    /// found again.
    SelfTest,
    /// Store garment, scene and calibration.
    Save,
    /// Gains of taxels from number `first` on, Q4.12 (4096 is 1.0).
    SetGain {
        /// number of the first taxel
        first: u16,
        /// the gains
        gains: Vec<u16, 64>,
    },
    /// How often `Budget` is reported.
    Budget {
        /// a second; 0: never, 65535: for each frame
        hz: u16,
    },
    /// Value of a concept that the host feeds, with its age and what counts when it is too old, or the host
    /// has said nothing for 3 s.
    Feed(Feed),
    /// How gestures are recognised from now on; none: not at all, as at the start. Not a part of the scene.
    SetGestures(Option<GestureConfig>),
    /// Which calibration the gains that were set belong to; `Hello` names it until a gain or the garment
    /// changes.
    SetCalibration(Certificate),
    /// postcard of a [`GalleryHead`](crate::shape::GalleryHead), whose prototypes follow; empty: the built-in
    /// base is in force again
    SetShapes(&'a [u8]),
    /// postcard of at most [`SHAPES_ADDED`] [`Exemplar`](crate::shape::Exemplar)s of that gallery, a list.
    /// With the last of them the gallery is in force, or refused and forgotten.
    AddShapes(&'a [u8]),
    /// Confidence that an announcement of a gesture takes from now on, in thousandths, at most 999; 0 at the
    /// start. Not a part of the scene; it stays when `SetGestures` comes.
    SetCertainty(u16),
    /// Put the stored settings aside, or take them up again; the board starts anew as soon as it has answered.
    /// What is put aside is kept until the next `Save`.
    ResetSettings {
        /// take them up again
        undo: bool,
    },
    /// How many forms are looked at in a frame from now on. Not a part of the scene; it stays when `SetScene`
    /// comes.
    SetForms {
        /// Of contacts that were there before, in turn; 0: all; 1 at the start.
        in_frame: u8,
        /// Whether [`FormsReport`]s are told.
        ages: bool,
    },
    /// Raw codes a second, beside those that the scene streams, until the next such request. Nothing else
    /// changes.
    SetRaw {
        /// 0: as the scene says; 65535: with every scan
        hz: u16,
    },
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
        }
    }
}
