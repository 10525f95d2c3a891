//! Reasons why the mind of a robot decided, down to the contacts of its boards.

use super::robot_mind::{RobotMeaning, RobotMind};
use super::senses::SenseCause;
use crate::error::Result;
use crate::fcm::reported::ReportedIntent;
use crate::fcm::robot_source::RobotSource;
use crate::fcm::why::{self, Explained, explain_reported};
use crate::robot::ReadRobot;
use serde_json::{Value, json};
use std::collections::BTreeSet;
use taxel_core::format::Micros;
use taxel_core::wire::IntentReport;

/// Reasons why a concept of a robot's map has its activation.
pub struct RobotReasons {
    /// The map's report, and the map.
    pub reported: ReportedIntent,
    /// The explanation of the concept.
    pub explained: Explained,
    /// Each input: its concept, source, value, age (none: the default), and what it consists of.
    pub inputs: Vec<ReasonInput>,
    /// Name, report and its explanation of each board that announces what counts.
    pub boards: Vec<(String, ReportedIntent, Explained)>,
}

/// Value that an input of the map heard.
pub struct ReasonInput {
    /// Concept of the input.
    pub concept: String,
    /// Source of the value.
    pub source: RobotSource,
    /// Value, in the unit of the source.
    pub value: i32,
    /// Age, ms; none if the default counts.
    pub age_ms: Option<u32>,
    /// Causes of which it consists.
    pub causes: Vec<SenseCause>,
}

impl RobotReasons {
    /// Explains what a mind senses now, `seconds` after the begin: the announced intention, else the
    /// strongest one, or the concept `of`.
    pub fn of(mind: &RobotMind, seconds: f64, of: Option<&str>, robot: &ReadRobot) -> Result<RobotReasons> {
        let RobotMeaning { host_us, leading, outcome, steps, activations, heard, .. } = mind.meaning_now();
        let concepts = activations.into_iter().collect();
        let report = IntentReport { frame: 0, time: Micros(host_us), leading, outcome, steps, concepts };
        let reported = ReportedIntent { map: mind.map().clone(), report, seconds };
        let explained = explain_reported(&reported, of)?;
        let mut inputs = Vec::new();
        let mut spoken = BTreeSet::new();
        for (input, heard) in mind.inputs().iter().zip(&heard) {
            let causes = mind.senses().causes(input, host_us);
            if matches!(input.source, RobotSource::Intent(_)) {
                spoken.extend(causes.iter().filter_map(|cause| cause.board));
            }
            let (concept, source) = (input.concept.clone(), input.source.clone());
            inputs.push(ReasonInput { concept, source, value: heard.value, age_ms: heard.age_ms, causes });
        }
        let board = |number: usize| -> Option<Result<(String, ReportedIntent, Explained)>> {
            let report = mind.senses().report(number)?.clone();
            let map = mind.senses().placement(number)?.map.as_deref()?.clone();
            let reported = ReportedIntent { map, report, seconds };
            let name = robot.boards.get(number)?.name.clone();
            Some(explain_reported(&reported, None).map(|explained| (name, reported, explained)))
        };
        let boards = spoken.into_iter().filter_map(board).collect::<Result<_>>()?;
        Ok(RobotReasons { reported, explained, inputs, boards })
    }

    /// Readable form; `most` paths of each map.
    pub fn text(&self, robot: &ReadRobot, most: usize) -> String {
        let leading = self.reported.report.leading.as_str();
        let mut text = format!("after {:.3} s: {leading} leads\n", self.reported.seconds);
        text += &why::text(&self.reported.map, &self.explained, None, most);
        text += "what it heard\n";
        for input in &self.inputs {
            let age =
                input.age_ms.map_or("the default: nothing is known".into(), |age| format!("{age} ms old"));
            text += &format!("  {}: {} {}, {age}\n", input.concept, said(&input.source), input.value);
            for cause in &input.causes {
                text += &format!("    {}\n", self.cause(robot, cause));
            }
        }
        for (name, reported, explained) in &self.boards {
            text += &format!("board {name}\n");
            let why = reported.text() + &why::text(&reported.map, explained, None, most);
            text.extend(why.lines().map(|line| format!("  {line}\n")));
        }
        text
    }

    fn cause(&self, robot: &ReadRobot, cause: &SenseCause) -> String {
        let board = cause.board.and_then(|number| robot.boards.get(number));
        let board = board.map_or(String::new(), |board| format!("board {}: ", board.name));
        let contact = cause.contact.as_ref().map_or(String::new(), |(id, place)| {
            format!("contact {id} on {} ({}): ", place.region, place.link)
        });
        format!("{board}{contact}{}, {} ms old", cause.value, cause.age_ms)
    }

    /// Returns it as JSON: that of `taxel fcm why` with `leading`, `seconds`, `heard` and `boards`.
    pub fn json(&self, robot: &ReadRobot) -> Value {
        let name = |number: usize| robot.boards.get(number).map_or("", |board| board.name.as_str());
        let cause = |cause: &SenseCause| {
            let mut value = json!({ "value": cause.value, "age_ms": cause.age_ms });
            if let Some(board) = cause.board {
                value["board"] = name(board).into();
            }
            if let Some((id, place)) = &cause.contact {
                value["contact"] = (*id).into();
                value["region"] = place.region.as_str().into();
                value["link"] = place.link.as_str().into();
            }
            value
        };
        let heard = self.inputs.iter().map(|input| {
            json!({
                "concept": input.concept, "source": input.source, "value": input.value, "age_ms": input.age_ms,
                "causes": input.causes.iter().map(cause).collect::<Value>(),
            })
        });
        let boards = self.boards.iter().map(|(name, reported, explained)| {
            let mut value = why::report(explained, None);
            value["board"] = name.as_str().into();
            value["leading"] = reported.report.leading.as_str().into();
            value
        });
        let mut value = why::report(&self.explained, None);
        value["leading"] = self.reported.report.leading.as_str().into();
        value["seconds"] = self.reported.seconds.into();
        value["heard"] = heard.collect();
        value["boards"] = boards.collect();
        value
    }
}

/// A source in words.
fn said(source: &RobotSource) -> String {
    let part = |part: &[String]| if part.is_empty() { "the robot".into() } else { part.join(" or ") };
    match source {
        RobotSource::Intent(leading) => format!("{} of a board", leading.as_str()),
        RobotSource::Load(of) => format!("load of {}", part(of)),
        RobotSource::Cover(of) => format!("touched area of {}", part(of)),
        RobotSource::Lasts(of) => format!("touch of {} lasts", part(of)),
        RobotSource::Apart(a, b) => format!("touch of {} before that of {}", part(a), part(b)),
        RobotSource::Motion(of) => format!("motion of {}", part(of)),
        RobotSource::Hardness(of) => format!("hardness of what {} moved into", part(of)),
        RobotSource::Point(of) => format!("pointedness of what {} moved into", part(of)),
        RobotSource::Slide(of) => format!("sliding of what {} moved into", part(of)),
        RobotSource::Stir(of) => format!("stirring of what {} moved into", part(of)),
        RobotSource::Own => "share by the robot's own motion".into(),
        RobotSource::HostInput(name) => format!("host input {name}"),
    }
}
