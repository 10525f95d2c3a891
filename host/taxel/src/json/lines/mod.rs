//! The JSON messages about a stream: one struct each.
//!
//! The docs of the fields are the descriptions in the messages' schemas.

mod board;
mod folds;
mod frame;
mod perceived;
mod pressing;
mod regions;
mod touch;

pub use board::{
    AnswerLine, BackLine, BudgetLine, FaultyTaxel, HealthLine, HealthMapLine, HelloLine, HelloPanel, LogLine,
    LostLine, OtherLine, PinFaultLine, RefusedLine, SelfTestLine, StartLine, StartOfFrameLine, SyncLine,
    TemperatureLine, UnusableLine,
};
pub use folds::{DoubtLine, FoldsLine};
pub use frame::{ContactsLine, FrameLine, PanelPixels, RawLine};
pub use perceived::{IntentLine, ReactionLine, ReflexLine, RegionLine, SymbolLine, SymbolsLine, WordsLine};
pub use pressing::{LandedLine, PressingLine, PushLine, UncertainLine, WrenchLine};
pub use regions::{RegionsLine, SurfaceRegionLine};
pub use touch::{GestureLine, ShapesLine};

use serde::Serialize;

/// A message.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(untagged)]
#[allow(clippy::large_enum_variant)] // made, written and dropped
#[allow(missing_docs)] // see the structs
pub enum JsonLine<'a> {
    Hello(HelloLine<'a>),
    Unusable(UnusableLine<'a>),
    Frame(FrameLine<'a>),
    Contacts(ContactsLine<'a>),
    Symbols(SymbolsLine<'a>),
    Intent(IntentLine),
    Gesture(GestureLine<'a>),
    Pressing(PressingLine<'a>),
    Folds(FoldsLine),
    Regions(RegionsLine<'a>),
    Shapes(ShapesLine<'a>),
    Reaction(ReactionLine<'a>),
    Reflex(ReflexLine),
    Health(HealthLine),
    Budget(BudgetLine),
    Temperature(TemperatureLine),
    HealthMap(HealthMapLine),
    SelfTest(SelfTestLine<'a>),
    Log(LogLine<'a>),
    Sync(SyncLine),
    StartOfFrame(StartOfFrameLine),
    Answer(AnswerLine<'a>),
    Raw(RawLine),
    Refused(RefusedLine),
    Lost(LostLine<'a>),
    Back(BackLine<'a>),
    Other(OtherLine<'a>),
}
