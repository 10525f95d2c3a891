//! The board itself: what it is, and how it is.

#[cfg(feature = "schema")]
use crate::json::schema::TypeIs;
use serde::Serialize;
use taxel_core::boot::{Aside, BootCause};
use taxel_core::selftest::Fault;
use taxel_core::wire::{Budget, Health};

/// Garment, scene and firmware of the board.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = TypeIs("hello")))]
#[serde(tag = "type", rename = "hello")]
pub struct HelloLine<'a> {
    /// The board's time, us.
    pub time_us: u64,
    /// Name and version of the firmware.
    pub firmware: &'a str,
    /// Unique id of the board's chip; empty if it has none, as a simulated board.
    pub chip: &'a str,
    /// True of a simulated board.
    pub simulated: bool,
    /// Name of the garment.
    pub garment: &'a str,
    /// Name of the scene.
    pub scene: &'a str,
    /// Id, date and fit of the calibration in force; empty without one: values are counts.
    pub calibration: &'a str,
    /// Start of the board; null if it does not know it.
    pub boot: Option<StartLine>,
    /// Number of taxels.
    pub taxels: usize,
    /// Names of the regions of the body.
    pub regions: Vec<&'a str>,
    /// The panels, in the order of their taxels.
    pub panels: Vec<HelloPanel<'a>>,
}

/// A panel of the garment.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct HelloPanel<'a> {
    /// Name of the panel.
    pub name: &'a str,
    /// Link of the robot.
    pub link: &'a str,
    /// Region of the body.
    pub region: &'a str,
    /// Number of rows.
    pub rows: u16,
    /// Number of columns.
    pub columns: u16,
    /// Distance of columns and of rows, um; 0 if unknown.
    pub pitch_um: [u32; 2],
}

/// Start of the board.
#[derive(Debug, Clone, Copy, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct StartLine {
    /// `power`, `pin`, `watchdog`, `panic`, `request` or `other`.
    #[cfg_attr(feature = "schema", schemars(with = "String"))]
    pub cause: BootCause,
    /// Resets by watchdog or panic up to this one, each less than a minute after the one before.
    pub resets: u8,
    /// Reason why the stored settings are not in use: `no` (they are), `resets`, `pin` or `request`.
    #[cfg_attr(feature = "schema", schemars(with = "String"))]
    pub aside: Aside,
}

/// The board cannot be used by this program.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = TypeIs("unusable")))]
#[serde(tag = "type", rename = "unusable")]
pub struct UnusableLine<'a> {
    /// The reason, for people.
    pub why: &'a str,
}

/// Counters of the board, from its start on.
#[derive(Debug, Clone, Copy, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = TypeIs("health")))]
#[serde(tag = "type", rename = "health")]
pub struct HealthLine {
    /// Duration of the last perception, us.
    pub process_us: u32,
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
    /// The board's time, us.
    pub time_us: u64,
}

impl From<&Health> for HealthLine {
    fn from(health: &Health) -> HealthLine {
        let Health { time, scans, failed, overruns, thinned_frames, .. } = *health;
        let Health { thinned_contacts, lost, refused, scan_us, process_us, .. } = *health;
        HealthLine {
            process_us,
            scans,
            failed,
            overruns,
            thinned_frames,
            thinned_contacts,
            lost,
            refused,
            scan_us,
            time_us: time.0,
        }
    }
}

/// Time spent on frames: of each part, the most that any of the frames took.
#[derive(Debug, Clone, Copy, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = TypeIs("budget")))]
#[serde(tag = "type", rename = "budget")]
pub struct BudgetLine {
    /// Number of the last of these scans.
    pub frame: u32,
    /// Images that were due and not sent, because the link had no room.
    pub thinned_frames: u32,
    /// Number of frames: 1, or all since the last such message.
    pub frames: u16,
    /// Duration of the scan, us.
    pub scan_us: u32,
    /// Time from the codes to the reactions, us.
    pub process_us: u32,
    /// Time of encoding messages and handing them to the link, us.
    pub encode_us: u32,
    /// Time for which a message waited for room on the link, us.
    pub send_us: u32,
    /// Complete frames that were never read.
    pub overruns: u32,
    /// Start of the last scan, us of the board.
    pub time_us: u64,
}

impl From<&Budget> for BudgetLine {
    fn from(budget: &Budget) -> BudgetLine {
        let Budget { frame, time, frames, scan_us, process_us, .. } = *budget;
        let Budget { encode_us, send_us, overruns, thinned_frames, .. } = *budget;
        BudgetLine {
            frame,
            thinned_frames,
            frames,
            scan_us,
            process_us,
            encode_us,
            send_us,
            overruns,
            time_us: time.0,
        }
    }
}

/// Temperature of the converter.
#[derive(Debug, Clone, Copy, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = TypeIs("temperature")))]
#[serde(tag = "type", rename = "temperature")]
pub struct TemperatureLine {
    /// Start of the scan in which it was measured, us of the board.
    pub time_us: u64,
    /// Temperature, degrees Celsius; may be several degrees off, but shows changes.
    pub celsius: f64,
}

/// Faulty taxels.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = TypeIs("health_map")))]
#[serde(tag = "type", rename = "health_map")]
pub struct HealthMapLine {
    /// The board's time, us.
    pub time_us: u64,
    /// True if the list is complete; else more follows.
    pub whole: bool,
    /// The faulty taxels, ascending.
    pub faulty: Vec<FaultyTaxel>,
}

/// A faulty taxel.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FaultyTaxel {
    /// Number of the taxel.
    pub taxel: u16,
    /// Fault, for people.
    pub health: String,
}

/// Result of a self-test of lines and inputs.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = TypeIs("self_test")))]
#[serde(tag = "type", rename = "self_test")]
pub struct SelfTestLine<'a> {
    /// The board's time at the end of the self-test, us.
    pub time_us: u64,
    /// Select lines that were examined.
    pub lines: u8,
    /// Converter inputs that were examined.
    pub inputs: u8,
    /// The faults found.
    pub faults: Vec<PinFaultLine<'a>>,
}

/// A faulty pin.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PinFaultLine<'a> {
    /// GPIO number.
    pub pin: u8,
    /// `stuck-high`, `stuck-low`, `open`, `grounded`, `supplied`, or `{"bridged": pin}`.
    #[cfg_attr(feature = "schema", schemars(with = "serde_json::Value"))]
    pub fault: &'a Fault,
}

/// A log message of the board, or a remark of the host about the link.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = TypeIs("log")))]
#[serde(tag = "type", rename = "log")]
pub struct LogLine<'a> {
    /// The board's time, us.
    pub time_us: u64,
    /// `info`, `warn` or `error`.
    pub level: &'static str,
    /// The message.
    pub text: &'a str,
}

/// The link to the board is lost, and waited for. What was present has ended just before.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = TypeIs("lost")))]
#[serde(tag = "type", rename = "lost")]
pub struct LostLine<'a> {
    /// Host time at which the board was last heard, us since 1970.
    pub since_us: u64,
    /// The reason, for people.
    pub why: &'a str,
}

/// The lost board is back, and its settings are restored.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = TypeIs("back")))]
#[serde(tag = "type", rename = "back")]
pub struct BackLine<'a> {
    /// Time for which it was lost, s.
    pub after_s: f64,
    /// Words on whether it had restarted and what was set again, for people.
    pub how: &'a str,
}

/// Another board answers in place of the one before.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = TypeIs("other")))]
#[serde(tag = "type", rename = "other")]
pub struct OtherLine<'a> {
    /// Difference, for people.
    pub why: &'a str,
}

/// Answer to a `Sync`.
#[derive(Debug, Clone, Copy, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = TypeIs("sync")))]
#[serde(tag = "type", rename = "sync")]
pub struct SyncLine {
    /// The number sent along with the request.
    pub token: u32,
    /// Time at which the board received it, us of the board.
    pub received_us: u64,
    /// Time at which the board answered, us of the board.
    pub sent_us: u64,
}

/// Start of a frame of the USB.
#[derive(Debug, Clone, Copy, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = TypeIs("start_of_frame")))]
#[serde(tag = "type", rename = "start_of_frame")]
pub struct StartOfFrameLine {
    /// Number of the frame, 0 to 2047.
    pub number: u16,
    /// Time at which the board noticed its start, us of the board.
    pub noticed_us: u64,
    /// Greatest time by which it may have begun before, us.
    pub late_us: u16,
}

/// Answer to another request.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = TypeIs("answer")))]
#[serde(tag = "type", rename = "answer")]
pub struct AnswerLine<'a> {
    /// Name of the request.
    pub request: &'static str,
    /// Reason why it was refused; null if it was done.
    pub refusal: Option<&'a str>,
}

/// Bytes from the board that are not a message.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = TypeIs("refused")))]
#[serde(tag = "type", rename = "refused")]
pub struct RefusedLine {
    /// The reason, for people.
    pub why: String,
}
