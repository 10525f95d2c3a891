//! The JSON messages to a page, one struct each, but for those that are lines of `taxel live --json`. The
//! docs of the fields are the descriptions in `page/messages.d.ts`.

use super::limits::SceneLimits;
use super::line_kind::LineKind;
use crate::palette::PagePalette;
use crate::watch::Felt;
use serde::Serialize;
use taxel::fcm::layers::Role;
use taxel::json::lines::{FrameLine, HelloLine, PressingLine};
#[cfg(feature = "schema")]
use taxel::json::schema::TypeIs;
use taxel::mind::RobotMeaningLine;
use taxel_core::garment::Absent;

/// Garment, scene and firmware of the board, and how the page shows them.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PageHello<'a> {
    /// The board's own.
    #[serde(flatten)]
    pub line: HelloLine<'a>,
    /// The source.
    pub label: &'a str,
    /// Colours and scale.
    pub palette: PagePalette,
    /// Counts per newton on a taxel; null if unknown.
    pub counts_per_newton: Option<f64>,
    /// Basis of forces: `calibrated`, `nominal` or `simulated`; null if they are in counts.
    pub force_basis: Option<&'static str>,
    /// Counts at which a contact ends.
    pub low: u16,
    /// Rectangles of positions without a taxel.
    #[cfg_attr(feature = "schema", schemars(with = "Vec<AbsentTaxels>"))]
    pub absent: &'a [Absent],
    /// The cognitive map; null if the scene has none.
    pub map: Option<PageMap<'a>>,
}

/// A rectangle of positions without a taxel.
#[cfg(feature = "schema")]
#[derive(schemars::JsonSchema)]
#[allow(dead_code)] // describes `taxel_core::garment::Absent`
struct AbsentTaxels {
    /// Index of the panel.
    panel: u8,
    /// First row.
    row: u16,
    /// First column.
    column: u16,
    /// Number of rows.
    rows: u16,
    /// Number of columns.
    columns: u16,
}

/// A cognitive map.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PageMap<'a> {
    /// The concepts.
    pub concepts: Vec<PageConcept<'a>>,
    /// The edges whose weight is not 0.
    pub edges: Vec<PageEdge>,
}

/// A concept of a map.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PageConcept<'a> {
    /// Name of the concept.
    pub name: &'a str,
    /// Layer in the drawing, from 0.
    pub layer: usize,
    /// Part of the concept: `felt`, `meaning` or `feeling`.
    #[cfg_attr(feature = "schema", schemars(with = "String"))]
    pub role: Role,
}

/// An edge of a map.
#[derive(Debug, Clone, Copy, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PageEdge {
    /// Index of the cause.
    pub from: u8,
    /// Index of the effect.
    pub to: u8,
    /// Weight, -1 to 1.
    pub weight: f64,
}

/// The line of an image: that of the frame, but with the activations of the last moment at which the
/// announced intention led.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PageFrame<'a> {
    /// The frame.
    #[serde(flatten)]
    pub line: FrameLine<'a>,
    /// Touch that is felt, for people.
    pub felt: Felt,
    /// Shape of each contact for people: `touch` unless the recogniser is sure of it.
    pub shapes: Vec<String>,
    /// Time since the beginning, us, of a recording.
    #[cfg_attr(feature = "schema", schemars(with = "u64"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub at_us: Option<u64>,
    /// Number of jumps in time, of a recording.
    #[cfg_attr(feature = "schema", schemars(with = "u32"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub seeks: Option<u32>,
    /// Contacts and forces on the robot; absent without a body.
    #[cfg_attr(feature = "schema", schemars(with = "PressingLine"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pressing: Option<PressingLine<'a>>,
    /// True if the image is from before the page was opened.
    #[cfg_attr(feature = "schema", schemars(with = "bool"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub past: Option<bool>,
}

/// The pressure just before a moment of a recording.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = TypeIs("glow")))]
#[serde(tag = "type", rename = "glow")]
pub struct GlowLine {
    /// The moment, us of the board.
    pub time_us: u64,
    /// Number of jumps in time.
    pub seeks: u32,
    /// Taxels and their pressure, counts, fading with its age.
    pub taxels: Vec<(u16, u16)>,
}

/// Faults of lines and inputs.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = TypeIs("pins")))]
#[serde(tag = "type", rename = "pins")]
pub struct PinsLine {
    /// Number of faults.
    pub faults: usize,
    /// A sentence for each, or one if there are none.
    pub table: Vec<String>,
}

/// The taxel under the pointer.
#[derive(Debug, Clone, Copy, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = TypeIs("taxel")))]
#[serde(tag = "type", rename = "taxel")]
pub struct TaxelLine {
    /// Number of the taxel.
    pub taxel: u16,
    /// Scan of the code; null before it has come.
    pub frame: Option<u32>,
    /// Raw code; null before it has come.
    pub code: Option<u16>,
    /// Block that reads it; null if none does.
    pub block: Option<u8>,
    /// Row in that block; null if it has none.
    pub wired_row: Option<u8>,
    /// Column in that block; null if it has none.
    pub wired_column: Option<u8>,
}

/// Causes of a concept's activation, in shares of the sum that causes it.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = TypeIs("why")))]
#[serde(tag = "type", rename = "why")]
pub struct WhyLine {
    /// Name of the concept.
    pub concept: String,
    /// Activation, -1 to 1.
    pub activation: f64,
    /// Share of each input over all its paths, the greatest first.
    pub inputs: Vec<(String, f64)>,
    /// The paths, the greatest share first.
    pub paths: Vec<PathShare>,
    /// Shares due to no input, by reason.
    pub rest: Vec<(String, f64)>,
    /// Sum of the paths and the rest.
    pub sum: f64,
}

/// Share of a path.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PathShare {
    /// Names of the concepts from an input to the last before the explained one.
    pub concepts: Vec<String>,
    /// The share.
    pub share: f64,
}

/// State of the link.
#[derive(Debug, Clone, Copy, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = TypeIs("link")))]
#[serde(tag = "type", rename = "link")]
pub struct LinkLine {
    /// Frames of the board, 1/s.
    pub rate: f64,
    /// Frames received.
    pub frames: u64,
    /// Messages lost.
    pub lost: u64,
    /// Images left out, because the link had no room.
    pub thinned: u64,
    /// Frames of the wire that were refused.
    pub refused: u64,
    /// Restarts of the board.
    pub restarts: u64,
    /// Half of the last round trip to the board, ms; null if unknown.
    pub latency_ms: Option<f64>,
    /// Number of open pages.
    pub pages: usize,
}

/// The log so far.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = TypeIs("log")))]
#[serde(tag = "type", rename = "log")]
pub struct LogLine<'a> {
    /// Lines, the oldest first.
    pub said: Vec<SayLine<'a>>,
}

/// A line of the log.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = TypeIs("say")))]
#[serde(tag = "type", rename = "say")]
pub struct SayLine<'a> {
    /// `onset`, `release`, `intention`, `reaction`, `gesture`, `gap` or `note`.
    #[cfg_attr(feature = "schema", schemars(with = "String"))]
    pub kind: LineKind,
    /// Time, us of the board; null if it has none.
    pub time_us: Option<u64>,
    /// The sentence.
    pub said: &'a str,
}

/// The stream has ended.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = TypeIs("end")))]
#[serde(tag = "type", rename = "end")]
pub struct EndLine {
    /// The reason, for people.
    pub text: String,
}

/// The last message of a type is no longer valid.
#[derive(Debug, Clone, Copy, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = TypeIs("none")))]
#[serde(tag = "type", rename = "none")]
pub struct NoneLine {
    /// The type.
    pub of: &'static str,
}

/// State of the player of a recording.
#[derive(Debug, Clone, Copy, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = TypeIs("player")))]
#[serde(tag = "type", rename = "player")]
pub struct PlayerLine {
    /// Time since the beginning, s.
    pub at: f64,
    /// Duration of the recording, s.
    pub duration: f64,
    /// First and last moment that is played, s.
    pub range: [f64; 2],
    /// Multiple of the recorded speed.
    pub speed: f64,
    /// True if the range is repeated.
    #[serde(rename = "loop")]
    pub repeats: bool,
    /// False while paused.
    pub playing: bool,
    /// Number of jumps in time.
    pub seeks: u32,
}

/// Summary of a recording.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = TypeIs("overview")))]
#[serde(tag = "type", rename = "overview")]
pub struct OverviewLine<'a> {
    /// Duration of the recording, us.
    pub duration_us: u64,
    /// Time up to which everything is known, us since the beginning.
    pub known_us: u64,
    /// Duration of a part, us.
    pub width_us: u64,
    /// Greatest total of each part, counts.
    pub totals: &'a [u32],
    /// Changes of the leading intention: us since the beginning, name.
    pub intentions: &'a [(u64, &'static str)],
    /// Lines of the log: us since the beginning, kind, text.
    #[cfg_attr(feature = "schema", schemars(with = "Vec<(u64, String, String)>"))]
    pub said: Vec<(u64, LineKind, &'a str)>,
    /// Number of lines about contacts that were left out.
    pub unlisted: u64,
}

/// Head of a binary message.
#[cfg(feature = "schema")]
#[derive(schemars::JsonSchema)]
#[allow(dead_code)] // describes what `message::image` writes around a line that is a text already
pub struct ImageHead {
    /// Line of the image.
    frame: PageFrame<'static>,
    /// Time, us of the board, and total, counts, of each frame since the last image, newest last.
    samples: Vec<(u64, u32)>,
    /// Images that were not sent because of a newer one.
    replaced: u64,
    /// Samples and lines that were dropped, because the page did not read.
    missed: u64,
}

/// What pages can set on the board, and have set.
#[derive(Debug, Clone, Copy, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = TypeIs("setup")))]
#[serde(tag = "type", rename = "setup")]
pub struct SetupLine {
    /// Limits and filter of the board's scene.
    pub limits: SceneLimits,
    /// Number of steps that can be undone.
    pub undo: usize,
    /// True if the board has been set since it was saved.
    pub unsaved: bool,
    /// True if the board is simulated: it is asked nothing that would need a question.
    pub simulated: bool,
    /// True if pages may only look.
    pub read_only: bool,
}

/// Tools that can press the garment of a simulated board.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = TypeIs("hand")))]
#[serde(tag = "type", rename = "hand")]
pub struct HandLine {
    /// The tools.
    pub tools: Vec<ToolLine>,
    /// The scripts that can be played.
    pub scripts: Vec<ScriptLine>,
    /// Name of the script that plays; null if none does.
    pub playing: Option<String>,
    /// Number of touches by hand that are kept: they can be played again and saved.
    pub touches: usize,
}

/// A tool.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ToolLine {
    /// Name.
    pub name: &'static str,
    /// Length and width, mm.
    pub size_mm: [f64; 2],
    /// Force of a short press, N.
    pub force_n: f64,
    /// Most that a long press comes to, N.
    pub most_n: f64,
}

/// A script of touches.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ScriptLine {
    /// Name.
    pub name: String,
    /// Title.
    pub title: String,
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(line: &impl Serialize) -> String {
        serde_json::to_string(line).unwrap()
    }

    #[test]
    fn messages_keep_their_bytes() {
        let glow = GlowLine { time_us: 5, seeks: 2, taxels: vec![(7, 90)] };
        assert_eq!(text(&glow), r#"{"type":"glow","time_us":5,"seeks":2,"taxels":[[7,90]]}"#);
        let pins = PinsLine { faults: 0, table: vec!["none".into()] };
        assert_eq!(text(&pins), r#"{"type":"pins","faults":0,"table":["none"]}"#);
        let block = Some(3);
        let taxel =
            TaxelLine { taxel: 7, frame: None, code: None, block, wired_row: None, wired_column: block };
        assert_eq!(
            text(&taxel),
            concat!(
                r#"{"type":"taxel","taxel":7,"frame":null,"code":null,"#,
                r#""block":3,"wired_row":null,"wired_column":3}"#
            )
        );
        let said = SayLine { kind: LineKind::Onset, time_us: Some(9), said: "on" };
        assert_eq!(text(&said), r#"{"type":"say","kind":"onset","time_us":9,"said":"on"}"#);
        assert_eq!(text(&EndLine { text: "over".into() }), r#"{"type":"end","text":"over"}"#);
        assert_eq!(text(&NoneLine { of: "taxel" }), r#"{"type":"none","of":"taxel"}"#);
        let player = PlayerLine {
            at: 0.5,
            duration: 10.0,
            range: [0.0, 10.0],
            speed: 1.0,
            repeats: false,
            playing: true,
            seeks: 3,
        };
        let reported = concat!(
            r#"{"type":"player","at":0.5,"duration":10.0,"range":[0.0,10.0],"speed":1.0,"#,
            r#""loop":false,"playing":true,"seeks":3}"#
        );
        assert_eq!(text(&player), reported);
        let overview = OverviewLine {
            duration_us: 9,
            known_us: 8,
            width_us: 7,
            totals: &[1, 2],
            intentions: &[(3, "threat")],
            said: vec![(4, LineKind::Gap, "lost")],
            unlisted: 0,
        };
        let reported = concat!(
            r#"{"type":"overview","duration_us":9,"known_us":8,"width_us":7,"totals":[1,2],"#,
            r#""intentions":[[3,"threat"]],"said":[[4,"gap","lost"]],"unlisted":0}"#
        );
        assert_eq!(text(&overview), reported);
    }

    #[test]
    fn the_link_is_reported_with_all_its_counts() {
        let link = LinkLine {
            rate: 195.5,
            frames: 1,
            lost: 2,
            thinned: 3,
            refused: 4,
            restarts: 5,
            latency_ms: None,
            pages: 6,
        };
        let reported = concat!(
            r#"{"type":"link","rate":195.5,"frames":1,"lost":2,"thinned":3,"refused":4,"#,
            r#""restarts":5,"latency_ms":null,"pages":6}"#
        );
        assert_eq!(text(&link), reported);
    }
}

/// A robot of several boards, one of which the page shows.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = TypeIs("robot")))]
#[serde(tag = "type", rename = "robot")]
pub struct RobotLine<'a> {
    /// Name of the robot.
    pub name: &'a str,
    /// Name of the board that the page shows.
    pub board: &'a str,
    /// All boards, in the order of the robot's file.
    pub boards: &'a [RobotBoardLine<'a>],
}

/// State of a board of a robot.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RobotBoardLine<'a> {
    /// Name of the board.
    pub name: &'a str,
    /// `live`, or `absent`, `lost`, `other`, `over`, `failed`: its picture is not live.
    pub state: &'static str,
    /// Host time at which it was last live, us since 1970; null if it is, or never was.
    pub since_us: Option<u64>,
    /// Reason why it is not live.
    pub why: Option<String>,
    /// Contacts on it.
    pub contacts: usize,
    /// Counts per newton on its taxels; null if unknown.
    pub counts_per_newton: Option<f64>,
}

/// Meaning of the touches of all boards to the robot.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RobotIntentLine {
    /// The robot's own.
    #[serde(flatten)]
    pub line: RobotMeaningLine,
    /// The announced intention and what holds, in words.
    pub text: String,
}
