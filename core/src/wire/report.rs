//! Reports: the messages from the board.

use super::codec::decode;
use crate::body::Placed;
use crate::boot::Boot;
use crate::fold::Doubt;
use crate::format::{Celsius, Micros, Name, Q15};
use crate::garment::PANELS;
use crate::health::TaxelHealth;
use crate::intent::{CONCEPTS, Leading, Outcome};
use crate::pipeline::CONTACTS;
use crate::react::Reaction;
use crate::selftest::Findings;
use crate::shape::GALLERY_CLASSES;
use crate::surface::{LINKS, Landed, LinkName, REGIONS, RegionSymbol, Uncertainty, Wrench};
use crate::symbol::{RegionState, Symbol};
use heapless::Vec;
use serde::{Deserialize, Serialize};

/// First bytes of a `Hello`.
pub const MAGIC: [u8; 4] = *b"TAXL";
/// Version of the protocol. Later messages and fields do not change it: see the [module](super).
pub const PROTOCOL: u16 = 2;

/// Declares the reports: for each its number, which is its urgency too, and when it is sent.
macro_rules! reports {
    ($($(#[$doc:meta])+ $constant:ident = $number:literal, $name:ident($body:ty), $when:literal;)+) => {
        /// A message from the board.
        #[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
        #[allow(clippy::large_enum_variant)] // used where it is decoded, never stored
        pub enum Report<'a> {
            $($(#[$doc])+ #[doc = concat!("Sent ", $when, ".")] $name($body),)+
        }

        /// Numbers of the variants. `(number, &body)` gives the postcard bytes of the variant without a move of
        /// the body.
        impl Report<'_> {
            $(#[doc = concat!("Number of `", stringify!($name), "`.")] pub const $constant: u32 = $number;)+
        }

        /// Name of each report and when it is sent, by number.
        pub const REPORTS: &[(&str, &str)] = &[$((stringify!($name), $when),)+];
    };
}

// The numbers are those of the variants, and the order in which the board sends what is due: the first of them
// first. A number is never used for anything else; a new report is appended.
reports! {
    /// Identity and settings of the board.
    #[serde(borrow)]
    HELLO = 0, Hello(Hello<'a>), "at the start, each second until `Start`, in answer to `Start`, and after a change";
    /// Answer to `Sync`.
    SYNC = 1, Sync(SyncReport), "in answer to `Sync`";
    /// Start of a frame of the USB.
    START_OF_FRAME = 2, StartOfFrame(StartOfFrame), "after each answer to `Sync`, by a board on USB";
    /// Findings about lines and inputs.
    SELF_TEST = 3, SelfTest(SelfTestReport), "in answer to `Start` and `SelfTest`, and when a line breaks in use";
    /// Answer to a request.
    #[serde(borrow)]
    ANSWER = 4, Answer(Answer<'a>), "in answer to every request but `Sync`";
    /// A reaction that began within a frame.
    REFLEX = 5, Reflex(ReflexReport), "with the `Reaction` that began by reflex; always";
    /// A reaction that began or ended.
    REACTION = 6, Reaction(ReactionReport), "always";
    /// Taught shapes.
    SHAPES = 7, Shapes(ShapesReport), "when a gallery was taught or dropped, and in answer to `Start`";
    /// Contacts.
    CONTACTS = 8, Contacts(ContactList), "at the scene's rate; onsets, ends and changes of doubt always";
    /// Symbols.
    SYMBOLS = 9, Symbols(SymbolList), "when there is an event; a state per touched region";
    /// Meaning of the touch.
    INTENT = 10, Intent(IntentReport), "with each inference; changes of the leading intention always";
    /// Recognised gesture.
    GESTURE = 11, Gesture(GestureReport), "with each announced class, and at the end of a touch";
    /// A sentence for people.
    #[serde(borrow)]
    LOG = 12, Log(Log<'a>), "when something is wrong";
    /// Faulty taxels.
    HEALTH_MAP = 13, HealthMap(HealthMap), "in answer to `Start`, and when it changes; in as many parts as needed";
    /// Counters of the board.
    HEALTH = 14, Health(Health), "each second";
    /// Time spent on frames.
    BUDGET = 15, Budget(Budget), "each second, or at the requested rate";
    /// Temperature of the converter.
    TEMPERATURE = 16, Temperature(Temperature), "each second, by a board with a thermometer";
    /// Names of the surface's regions.
    REGION_NAMES = 17, RegionNames(RegionNames), "before the first `Regions` after a `Start` or of another surface";
    /// Touch state of each region of the surface.
    REGIONS = 18, Regions(RegionsReport), "when a region of the surface changes, and each second";
    /// Contacts and forces on the robot.
    PRESSING = 19, Pressing(PressingReport), "at the scene's rate while something touches, and once after";
    /// Expected pressure of the garment's folds.
    FOLDS = 20, Folds(FoldsReport), "ten times per second while a table of folds is in force";
    /// A conditioned image.
    #[serde(borrow)]
    FRAME = 21, Frame(Frame<'a>), "at the scene's rate, when the link has room";
    /// Raw codes.
    #[serde(borrow)]
    RAW = 22, Raw(Raw<'a>), "at the requested rate, when the link has room";
}

/// Identity and settings of the board. Its first two fields are the same in all versions.
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
    /// UTF-8: id, date, fit error of the calibration in force; empty without one: values are counts
    pub calibration: &'a [u8],
    /// UTF-8: unique id of the board's chip; empty without one
    pub chip: &'a [u8],
    /// Start of the board; none if it does not know
    pub boot: Option<Boot>,
}

impl Hello<'_> {
    /// The protocol of a `Hello` of any version, from the bytes of its body; none if it is not that of a board.
    pub fn protocol_of(body: &[u8]) -> Option<u16> {
        let (magic, rest) = body.split_first_chunk()?;
        (*magic == MAGIC).then(|| decode(rest).ok())?
    }
}

/// A conditioned image.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Frame<'a> {
    /// Number of the scan.
    pub frame: u32,
    /// Start of the scan.
    pub time: Micros,
    /// Number of the frame that it differs from; none: it stands alone.
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
    /// The codes, encoded as an image alone.
    pub data: &'a [u8],
}

/// Contacts of a frame.
#[derive(Debug, Default, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct ContactList {
    /// Number of the scan of the newest state.
    pub frame: u32,
    /// Start of that scan.
    pub time: Micros,
    /// Number of contacts that did not fit.
    pub dropped: u16,
    /// Present contacts, and all that ended since the last list.
    pub contacts: Vec<Placed, LISTED>,
    /// Ids of the contacts that may be drift of their baseline; no intention follows from them. See
    /// [`unsure`](crate::unsure).
    pub unsure: Vec<u32, CONTACTS>,
    /// Ids of present contacts whose form is older than this frame, with its age in frames, which saturates at
    /// 255; if the scene's stream has them.
    pub form_ages: Vec<(u32, u8), CONTACTS>,
}

/// Greatest number of contacts, or events, of a list: all that can be present, and as many that have ended.
pub const LISTED: usize = 2 * CONTACTS;

/// Events and regions of a frame.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct SymbolList {
    /// Number of the scan.
    pub frame: u32,
    /// Start of the scan.
    pub time: Micros,
    /// Onsets, changes of words, releases.
    pub events: Vec<Symbol, LISTED>,
    /// Touched regions.
    pub regions: Vec<RegionState, PANELS>,
}

/// Meaning of the touch.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct IntentReport {
    /// Number of the scan.
    pub frame: u32,
    /// Start of the scan.
    pub time: Micros,
    /// The announced intention.
    pub leading: Leading,
    /// End of the inference.
    pub outcome: Outcome,
    /// Steps of the inference.
    pub steps: u16,
    /// Activation of each concept of the scene's map.
    pub concepts: Vec<Q15, CONCEPTS>,
}

/// A reaction that began or ended.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct ReactionReport {
    /// Number of the scan.
    pub frame: u32,
    /// Start of the scan.
    pub time: Micros,
    /// The reaction.
    pub reaction: Reaction,
}

/// Counters of the board, from its start on.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Health {
    /// The board's time.
    pub time: Micros,
    /// Finished scans.
    pub scans: u32,
    /// Scans that failed.
    pub failed: u32,
    /// Complete frames that were never read.
    pub overruns: u32,
    /// Images that were due and not sent, because the link had no room.
    pub thinned_frames: u32,
    /// Contact updates that were due and not sent.
    pub thinned_contacts: u32,
    /// Guaranteed messages that did not fit in the queue.
    pub lost: u32,
    /// Received frames that were refused.
    pub refused: u32,
    /// Duration of the last scan, us.
    pub scan_us: u32,
    /// Duration of the last perception, us.
    pub process_us: u32,
}

/// Time spent on frames: per part, the most that any of the frames took, including all work until the next
/// frame.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Budget {
    /// Number of the last of these scans.
    pub frame: u32,
    /// Start of that scan.
    pub time: Micros,
    /// Number of frames: 1, or all since the last such report.
    pub frames: u16,
    /// Duration of the scan, us. The next scan runs meanwhile.
    pub scan_us: u32,
    /// Time from the codes to the reactions, us.
    pub process_us: u32,
    /// Time of encoding messages and handing them to the link, us.
    pub encode_us: u32,
    /// Time for which a message waited for room on the link, us. The processor does not wait.
    pub send_us: u32,
    /// See [`Health`].
    pub overruns: u32,
    /// See [`Health`].
    pub thinned_frames: u32,
}

/// Temperature of the converter; a sheet beside it follows slowly.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Temperature {
    /// Start of the scan in which it was measured.
    pub time: Micros,
    /// One sample of the converter's thermometer: may be several degrees off, but shows changes.
    pub celsius: Celsius,
}

/// Faulty taxels in a range of numbers; all others in it are good.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct HealthMap {
    /// The board's time.
    pub time: Micros,
    /// First taxel of the range.
    pub first: u16,
    /// Taxel after the last of the range: the garment ends there, or another message continues.
    pub end: u16,
    /// Faulty taxels, ascending.
    pub taxels: Vec<FaultyTaxels, 64>,
}

/// Consecutive taxels with the same fault.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct FaultyTaxels {
    /// Number of the first.
    pub first: u16,
    /// Number of taxels, at least 1.
    pub count: u16,
    /// The fault.
    pub health: TaxelHealth,
}

/// Result of a self-test of lines and inputs.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct SelfTestReport {
    /// The board's time at the end of the self-test.
    pub time: Micros,
    /// Findings of the test.
    pub findings: Findings,
}

/// Recognised gesture, by the scene's model.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct GestureReport {
    /// Number of the scan.
    pub frame: u32,
    /// Start of the scan.
    pub time: Micros,
    /// Number of the touch, from 1.
    pub touch: u32,
    /// Index of the touched panel.
    pub panel: u8,
    /// Class of the model, from 0.
    pub class: u8,
    /// Name of the class.
    pub name: Name,
    /// Score of the class, Q18.
    pub score: i32,
    /// Lead over the score of the second class, Q18.
    pub lead: u32,
    /// Time for which the touch was observed, ms.
    pub observed_ms: u32,
    /// True if the touch is over; then the result is for all of it.
    pub ended: bool,
    /// Share of touches of that age and lead that are of that class; none if the model does not know it.
    pub confidence: Option<Q15>,
}

/// Contacts and forces on the robot, at the rate of the scene's stream while something touches, and once when
/// nothing does any more. See [`surface`](crate::surface).
#[derive(Debug, Default, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct PressingReport {
    /// Number of the scan.
    pub frame: u32,
    /// Start of the scan.
    pub time: Micros,
    /// Time at which the poses in force were received; none without one.
    pub posed: Option<Micros>,
    /// The contacts that have a place.
    pub contacts: Vec<Landed, CONTACTS>,
    /// The links that something presses on.
    pub links: Vec<Wrench, LINKS>,
    /// Uncertainty of contacts, with their ids; of those that have some.
    pub contact_bounds: Vec<(u32, Uncertainty), CONTACTS>,
    /// Uncertainty of links, with their indices in the table; of those that have some.
    pub link_bounds: Vec<(u8, Uncertainty), LINKS>,
    /// The most by which places on a link are off in the frame of the poses, um; of links whose poses say it.
    pub pose_errors: Vec<(u8, u32), LINKS>,
}

/// Touch state of each region of the surface: when one of them changes, and once a second; from a board whose
/// body has regions. See [`RegionStates`](crate::surface::RegionStates).
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct RegionsReport {
    /// Number of the scan.
    pub frame: u32,
    /// Start of the scan.
    pub time: Micros,
    /// All regions, in the order of their names.
    pub regions: Vec<RegionSymbol, REGIONS>,
}

/// Names of the surface's regions: before the first [`RegionsReport`] after a `Start`, and after another
/// surface came into force.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct RegionNames {
    /// Names in the order of the body.
    pub names: Vec<LinkName, REGIONS>,
}

/// Expected pressure of the garment's folds, ten times per second while a table of folds is in force. See
/// [`fold`](crate::fold).
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct FoldsReport {
    /// Number of the scan.
    pub frame: u32,
    /// Start of the scan.
    pub time: Micros,
    /// Time at which the posture in force was received; none without one.
    pub posed: Option<Micros>,
    /// True if the folds follow the posture. False if there is none, or it is too old: taxels that fold are
    /// then touched only beyond the most that they feel at any posture.
    pub followed: bool,
    /// Number of taxels of which something is expected, or that are in doubt.
    pub taxels: u16,
    /// Sum of the expected pressures, counts.
    pub total: u32,
    /// Sum of the doubts, counts.
    pub doubt: u32,
    /// Present contacts on such taxels.
    pub contacts: Vec<Doubt, CONTACTS>,
}

/// Shapes that the board was taught. The class of a contact is 1 + its index in these names.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct ShapesReport {
    /// Number of prototypes of the gallery in force; 0: the built-in base is in force.
    pub prototypes: u16,
    /// Names of the gallery's classes.
    pub names: Vec<Name, GALLERY_CLASSES>,
}

/// A reaction began before its frame was complete. The `Reaction` itself follows, or was sent with a frame
/// that showed the cause.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct ReflexReport {
    /// Number of the scan in which it began.
    pub frame: u32,
    /// Time at which the deciding sub-field had been read; the pin was asserted at once.
    pub time: Micros,
    /// Row of the scene's table.
    pub index: u8,
    /// Number of the taxel that decided.
    pub taxel: u16,
    /// Pressure of the taxel, counts.
    pub value: u16,
    /// Number of the taxel that agrees, if two must.
    pub other: Option<u16>,
}

/// Severity of a log message.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Level {
    /// Information.
    Info,
    /// Something does not work as requested.
    Warn,
    /// Something does not work.
    Error,
}

/// A sentence for people.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Log<'a> {
    /// The board's time.
    pub time: Micros,
    /// Severity.
    pub level: Level,
    /// The sentence.
    pub text: &'a str,
}

/// Answer to `Sync`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct SyncReport {
    /// Token of the request.
    pub token: u32,
    /// The board's time when the request was read.
    pub received: Micros,
    /// The board's time when this answer was handed to the link.
    pub sent: Micros,
}

/// Start of a frame of the USB: all boards on one host controller see the starts, one each millisecond, at the
/// same moments and with the same numbers (USB 2.0, 8.4.3).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct StartOfFrame {
    /// Number of the frame, 0 to 2047.
    pub number: u16,
    /// The board's time when it noticed the start.
    pub noticed: Micros,
    /// Greatest time by which it may have begun before, us.
    pub late_us: u16,
}

/// Answer to a request.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Answer<'a> {
    /// Number of the request's variant; 255: the request could not be read.
    pub request: u8,
    /// None if the request was carried out; otherwise the reason for its refusal.
    pub refusal: Option<&'a str>,
}
