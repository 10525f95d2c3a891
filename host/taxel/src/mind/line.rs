//! Meaning of touches to the robot, as JSON and in words.

use super::mover::{Approach, Mover};
use super::probe::Probe;
use super::robot_mind::{RobotMeaning, RobotMind};
use super::sensed_board::SensedTouch;
#[cfg(feature = "schema")]
use crate::json::schema::{self, TypeIs};
use serde::Serialize;
use serde_json::{Map, Value};

/// Topic of these messages in a recording, below `/taxel/`; also their type.
pub const ROBOT_INTENT: &str = "robot_intent";
/// Their schema, as [`robot_intent_schema`] derives it.
pub const ROBOT_INTENT_SCHEMA: &str = include_str!("../../schemas/messages/robot_intent.json");

/// Meaning of the touches of all boards together.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = TypeIs("robot_intent")))]
#[serde(tag = "type", rename = "robot_intent")]
pub struct RobotMeaningLine {
    /// The host's time, us since 1970.
    pub host_time_us: u64,
    /// The announced intention: `none`, `kindness`, `threat` or `attack`.
    pub leading: &'static str,
    /// Names of the concepts with causes that hold: of at least 0.5, and then down to 0.4.
    pub holding: Vec<String>,
    /// Activation of each concept of the map, -1 to 1.
    #[cfg_attr(feature = "schema", schemars(with = "std::collections::BTreeMap<String, f64>"))]
    pub concepts: Map<String, Value>,
    /// Inputs of the map for which nothing is known that is young enough, so that its default counts: names
    /// of their concepts.
    pub defaults: Vec<String>,
    /// Contacts on the robot, and whose motion has caused them.
    pub touches: Vec<RobotTouchLine>,
}

/// A contact of a board.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RobotTouchLine {
    /// Number of the board, in the order of the robot's file.
    pub board: usize,
    /// Id of the board's contact.
    pub contact: u32,
    /// Region on which it lies.
    pub region: String,
    /// Link on which it lies.
    pub link: String,
    /// Pressure, counts; with a calibration in force the force, thousandths of a newton.
    pub load: u32,
    /// `own` if the robot's motion has caused it, `other` if that of what touches it, or `unsure`.
    #[cfg_attr(feature = "schema", schemars(with = "String"))]
    pub mover: Mover,
    /// Motion of the robot's surface before the onset; absent if it is not known.
    #[cfg_attr(feature = "schema", schemars(with = "Approach"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub approach: Option<Approach>,
    /// Properties of the object that the robot has moved into; absent of what touches it.
    #[cfg_attr(feature = "schema", schemars(with = "Probe"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub probe: Option<Probe>,
}

impl RobotTouchLine {
    /// Contacts of all boards that are present.
    pub fn all(mind: &RobotMind) -> Vec<RobotTouchLine> {
        let line = |(board, touch): (usize, &SensedTouch)| RobotTouchLine {
            board,
            contact: touch.felt.contact,
            region: touch.felt.place.region.clone(),
            link: touch.felt.place.link.clone(),
            load: touch.felt.load,
            mover: touch.mover,
            approach: touch.approach,
            probe: (touch.mover == Mover::Own).then(|| touch.course.probe()),
        };
        let boards = 0..mind.senses().boards();
        let all =
            boards.flat_map(|board| mind.senses().touches(board).iter().map(move |touch| (board, touch)));
        all.filter(|(_, touch)| touch.ended_us.is_none()).map(line).collect()
    }
}

impl RobotMeaningLine {
    /// The message of a meaning.
    pub fn of(mind: &RobotMind, meaning: &RobotMeaning) -> RobotMeaningLine {
        let name = |at: usize| mind.map().concept.get(at).map_or(String::new(), |it| it.name.clone());
        let concepts = meaning.activations.iter().enumerate();
        let mut defaults: Vec<String> = Vec::new();
        for (input, heard) in mind.inputs().iter().zip(&meaning.heard) {
            if heard.age_ms.is_none() && !defaults.contains(&input.concept) {
                defaults.push(input.concept.clone());
            }
        }
        RobotMeaningLine {
            host_time_us: meaning.host_us,
            leading: meaning.leading.as_str(),
            holding: meaning.holding.iter().map(|at| name(*at)).collect(),
            concepts: concepts.map(|(at, value)| (name(at), value.to_f64().into())).collect(),
            defaults,
            touches: RobotTouchLine::all(mind),
        }
    }

    /// Returns it in words: `kindness; hug 0.98, happiness 0.90`.
    pub fn text(&self) -> String {
        let value = |name: &String| self.concepts.get(name).and_then(Value::as_f64).unwrap_or(0.0);
        let others = self.holding.iter().filter(|name| *name != self.leading);
        let others: Vec<String> = others.map(|name| format!("{name} {:.2}", value(name))).collect();
        match (self.leading, others.is_empty()) {
            (leading, true) => leading.into(),
            (leading, false) => format!("{leading}; {}", others.join(", ")),
        }
    }
}

/// The schema as the structs give it: as programs for recordings want it, and as it is.
#[cfg(feature = "schema")]
pub fn robot_intent_schema() -> [Value; 2] {
    [schema::plain::<RobotMeaningLine>(), schema::of::<RobotMeaningLine>()]
}
