//! Reports: the messages from the board.

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
/// Version of the protocol.
pub const PROTOCOL: u16 = 1;

/// A message from the board; numbers as in the [module's](super) table.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[allow(clippy::large_enum_variant)] // used where it is decoded, never stored
pub enum Report<'a> {
    /// Identity and settings of the board.
    #[serde(borrow)]
    Hello(Hello<'a>),
    /// A conditioned image.
    #[serde(borrow)]
    Frame(Frame<'a>),
    /// Contacts.
    Contacts(ContactList),
    /// Symbols.
    Symbols(SymbolList),
    /// Meaning of the touch.
    Intent(IntentReport),
    /// A reaction that began or ended.
    Reaction(ReactionReport),
    /// Counters of the board.
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
    /// Time spent on frames.
    Budget(Budget),
    /// Faulty taxels.
    HealthMap(HealthMap),
    /// Temperature of the converter.
    Temperature(Temperature),
    /// Findings about lines and inputs.
    SelfTest(SelfTestReport),
    /// Recognised gesture.
    Gesture(GestureReport),
    /// Taught shapes.
    Shapes(ShapesReport),
    /// A reaction that began within a frame.
    Reflex(ReflexReport),
    /// Confidence of the next gesture report.
    Confidence(ConfidenceReport),
    /// Cause of the last reset.
    Boot(Boot),
    /// Contacts that may be drift.
    Unsure(UnsureReport),
    /// Ages of the forms in the next list of contacts.
    Forms(FormsReport),
    /// What presses on the robot.
    Pressing(PressingReport),
    /// What the garment's folds are expected to press.
    Folds(FoldsReport),
    /// What is unknown of what presses.
    Bounds(BoundsReport),
    /// What each region of the surface feels.
    Regions(RegionsReport),
    /// Names of the surface's regions.
    RegionNames(RegionNames),
    /// When a frame of the USB began.
    StartOfFrame(StartOfFrame),
}

/// Numbers of the variants. `(number, &body)` gives the postcard bytes of the variant without a move of the
/// body.
impl Report<'_> {
    /// Number of `Hello`.
    pub const HELLO: u32 = 0;
    /// Number of `Frame`.
    pub const FRAME: u32 = 1;
    /// Number of `Contacts`.
    pub const CONTACTS: u32 = 2;
    /// Number of `Symbols`.
    pub const SYMBOLS: u32 = 3;
    /// Number of `Intent`.
    pub const INTENT: u32 = 4;
    /// Number of `Reaction`.
    pub const REACTION: u32 = 5;
    /// Number of `Health`.
    pub const HEALTH: u32 = 6;
    /// Number of `Log`.
    pub const LOG: u32 = 7;
    /// Number of `Sync`.
    pub const SYNC: u32 = 8;
    /// Number of `Answer`.
    pub const ANSWER: u32 = 9;
    /// Number of `Raw`.
    pub const RAW: u32 = 10;
    /// Number of `Budget`.
    pub const BUDGET: u32 = 11;
    /// Number of `HealthMap`.
    pub const HEALTH_MAP: u32 = 12;
    /// Number of `Temperature`.
    pub const TEMPERATURE: u32 = 13;
    /// Number of `SelfTest`.
    pub const SELF_TEST: u32 = 14;
    /// Number of `Gesture`.
    pub const GESTURE: u32 = 15;
    /// Number of `Shapes`.
    pub const SHAPES: u32 = 16;
    /// Number of `Reflex`.
    pub const REFLEX: u32 = 17;
    /// Number of `Confidence`.
    pub const CONFIDENCE: u32 = 18;
    /// Number of `Boot`.
    pub const BOOT: u32 = 19;
    /// Number of `Unsure`.
    pub const UNSURE: u32 = 20;
    /// Number of `Forms`.
    pub const FORMS: u32 = 21;
    /// Number of `Pressing`.
    pub const PRESSING: u32 = 22;
    /// Number of `Folds`.
    pub const FOLDS: u32 = 23;
    /// Number of `Bounds`.
    pub const BOUNDS: u32 = 24;
    /// Number of `Regions`.
    pub const REGIONS: u32 = 25;
    /// Number of `RegionNames`.
    pub const REGION_NAMES: u32 = 26;
    /// Number of `StartOfFrame`.
    pub const START_OF_FRAME: u32 = 27;
}

/// Identity and settings of the board. This layout is frozen.
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
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct ContactList {
    /// Number of the scan of the newest state.
    pub frame: u32,
    /// Start of that scan.
    pub time: Micros,
    /// Number of contacts that did not fit.
    pub dropped: u16,
    /// Present contacts, and all that ended since the last list.
    pub contacts: Vec<Placed, LISTED>,
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
    /// Its findings.
    pub findings: Findings,
}

/// Recognised gesture, by the model that `SetGestures` has chosen.
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
}

/// Confidence of the [`GestureReport`] that follows, for the same frame and touch. Not sent if the model
/// gives none.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct ConfidenceReport {
    /// Number of the scan.
    pub frame: u32,
    /// Start of the scan.
    pub time: Micros,
    /// Number of the touch, from 1.
    pub touch: u32,
    /// Share of touches of that age and lead that are of that class.
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
    /// Ids of the contacts that are unsure now; any other is sure, or has ended.
    pub contacts: Vec<u32, CONTACTS>,
}

/// Ages of the forms of contacts, if [`Request::SetForms`](super::Request::SetForms) asked for them. Sent
/// before the [`ContactList`] of that frame if one of the forms is older.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct FormsReport {
    /// Number of the scan.
    pub frame: u32,
    /// Start of the scan.
    pub time: Micros,
    /// Ids of contacts whose form is older than this frame, with its age in frames; saturates at 255.
    pub ages: Vec<(u32, u8), LISTED>,
}

/// What presses on the robot, if [`Request::SetPressing`](super::Request::SetPressing) asked for it: at its
/// rate while something touches, and once when nothing does any more. See [`surface`](crate::surface).
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
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
}

/// What is unknown of the next [`PressingReport`], which is of the same frame: of contacts, links and poses
/// where something is. Not sent if nothing is unknown.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct BoundsReport {
    /// Number of the scan.
    pub frame: u32,
    /// By contact, with its id.
    pub contacts: Vec<(u32, Uncertainty), CONTACTS>,
    /// By link, with its index in the table.
    pub links: Vec<(u8, Uncertainty), LINKS>,
    /// The most by which places on a link are off in the frame of the poses, um; of links whose poses say it.
    pub poses: Vec<(u8, u32), LINKS>,
}

/// What each region of the surface feels: when one of them changes, and once a second; from a board whose
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
    /// In the order of the body.
    pub names: Vec<LinkName, REGIONS>,
}

/// What the garment's folds are expected to press, ten times per second while a table of folds is in force.
/// See [`fold`](crate::fold).
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
    /// Its pressure, counts.
    pub value: u16,
    /// Number of the taxel that agrees, if two must.
    pub other: Option<u16>,
}

/// Severity of a log message.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Level {
    /// For information.
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

/// When a frame of the USB began: all boards on one host controller see its starts, one each millisecond, at
/// the same moments and with the same numbers (USB 2.0, 8.4.3).
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
