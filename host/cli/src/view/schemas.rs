//! The JSON schemas of the messages between the program and a page.

use super::lines::{
    EndLine, GlowLine, HandLine, ImageHead, LinkLine, LogLine, NoneLine, OverviewLine, PageHello, PinsLine,
    PlayerLine, RobotIntentLine, RobotLine, SayLine, SetupLine, TaxelLine, WhyLine,
};
use super::message::PageRequest;
use crate::folding::FoldingLine;
use crate::on_robot::{BodyLine, FigureLine, PosesLine};
use serde_json::Value;
use taxel::json::lines::{BudgetLine, HealthLine, HealthMapLine, LostLine};
use taxel::json::schema::of;

/// The schema of each message, and of what a page asks, by the name of its struct.
pub fn derived() -> Vec<(&'static str, Value)> {
    vec![
        ("PageHello", of::<PageHello<'static>>()),
        ("HealthLine", of::<HealthLine>()),
        ("HealthMapLine", of::<HealthMapLine>()),
        ("BudgetLine", of::<BudgetLine>()),
        ("LostLine", of::<LostLine<'static>>()),
        ("ImageHead", of::<ImageHead>()),
        ("BodyLine", of::<BodyLine<'static>>()),
        ("PosesLine", of::<PosesLine<'static>>()),
        ("FigureLine", of::<FigureLine<'static>>()),
        ("FoldingLine", of::<FoldingLine>()),
        ("GlowLine", of::<GlowLine>()),
        ("PinsLine", of::<PinsLine>()),
        ("TaxelLine", of::<TaxelLine>()),
        ("LinkLine", of::<LinkLine>()),
        ("SayLine", of::<SayLine<'static>>()),
        ("LogLine", of::<LogLine<'static>>()),
        ("WhyLine", of::<WhyLine>()),
        ("EndLine", of::<EndLine>()),
        ("HandLine", of::<HandLine>()),
        ("SetupLine", of::<SetupLine>()),
        ("NoneLine", of::<NoneLine>()),
        ("PlayerLine", of::<PlayerLine>()),
        ("OverviewLine", of::<OverviewLine<'static>>()),
        ("RobotLine", of::<RobotLine<'static>>()),
        ("RobotIntentLine", of::<RobotIntentLine>()),
        ("PageRequest", of::<PageRequest>()),
    ]
}
