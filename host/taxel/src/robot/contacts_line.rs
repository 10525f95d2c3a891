//! The robot's contacts as JSON.

use super::contact::RobotContact;
use super::file::ReadRobot;
use super::plane::pitch_mm;
use super::touch::{RobotTouch, RobotTouchPart};
#[cfg(feature = "schema")]
use crate::json::schema::{self, TypeIs};
use serde::Serialize;
use taxel_core::contact::Phase;

/// Topic of these messages in a recording, below `/taxel/`; also their type.
pub const ROBOT_CONTACTS: &str = "robot_contacts";
/// Their schema, as [`robot_contacts_schema`] derives it.
pub const ROBOT_CONTACTS_SCHEMA: &str = include_str!("../../schemas/messages/robot_contacts.json");

/// Contacts of all boards of a robot; what touches both sides of a seam between boards is one contact.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = TypeIs("robot_contacts")))]
#[serde(tag = "type", rename = "robot_contacts")]
pub struct RobotContactsLine<'a> {
    /// Host time of the board's scan that is told, us since 1970.
    pub host_time_us: u64,
    /// Present contacts and those just released, by their ids.
    pub contacts: Vec<RobotContactLine<'a>>,
}

/// A contact of the robot.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RobotContactLine<'a> {
    /// Number of the contact, from 1 upwards; constant from onset to release, on whatever boards it is.
    pub id: u32,
    /// `onset`, `held` or `released`.
    #[cfg_attr(feature = "schema", schemars(with = "String"))]
    pub phase: Phase,
    /// Name of the board on which most of it is.
    pub board: &'a str,
    /// Name of the panel there.
    pub panel_name: &'a str,
    /// Centroid along the columns of that panel, taxels from the first; goes on beyond a seam.
    pub x: f64,
    /// Centroid along the rows, taxels from the first.
    pub y: f64,
    /// Centroid along the columns, mm from the first.
    pub x_mm: f64,
    /// Centroid along the rows, mm from the first.
    pub y_mm: f64,
    /// Sum of the pressure of its taxels on all boards, counts.
    pub total: u32,
    /// Force by the calibrations in force, N; absent unless all of its boards have one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub force_n: Option<f64>,
    /// Greatest pressure of a taxel, counts.
    pub peak: u16,
    /// Number of taxels.
    pub area: u32,
    /// Time since the onset, s.
    pub duration: f64,
    /// Age of pressure and place, us: the mean age of the scans from which they are told.
    pub age_us: u64,
    /// What it consists of, board by board.
    pub parts: Vec<RobotContactPartLine<'a>>,
}

/// What a board has of a contact of the robot.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RobotContactPartLine<'a> {
    /// Name of the board.
    pub board: &'a str,
    /// Id of the board's contact; null if it is too faint to be one there.
    pub contact: Option<u32>,
    /// Its pressure, counts.
    pub total: u32,
    /// Age of what the board has told last, us; below 0 if it is newer.
    pub age_us: i64,
}

impl<'a> RobotContactsLine<'a> {
    /// The robot's contacts at a host time.
    pub fn of(robot: &'a ReadRobot, host_time_us: u64, contacts: &[RobotContact]) -> RobotContactsLine<'a> {
        let contacts =
            contacts.iter().map(|contact| RobotContactLine::of(robot, host_time_us, contact)).collect();
        RobotContactsLine { host_time_us, contacts }
    }
}

impl<'a> RobotContactLine<'a> {
    fn of(robot: &'a ReadRobot, host_time_us: u64, contact: &RobotContact) -> RobotContactLine<'a> {
        let name = |board: usize| robot.boards.get(board).map_or("", |board| board.name.as_str());
        let RobotTouch { host_us, board, panel, centroid, total, newtons, peak, area, parts } =
            &contact.touch;
        let worn = robot.boards.get(*board).and_then(|board| board.garment.as_ref());
        let on = worn.and_then(|worn| worn.layout.areas().get(usize::from(*panel)));
        let [x, y] = *centroid;
        let [x_mm, y_mm] = pitch_mm(on.map_or([0; 2], |on| on.pitch_um));
        let part = |part: &RobotTouchPart| RobotContactPartLine {
            board: name(part.board),
            contact: part.contact,
            total: part.total,
            age_us: part.age_us,
        };
        RobotContactLine {
            id: contact.id,
            phase: contact.phase,
            board: name(*board),
            panel_name: on.map_or("", |on| on.name.as_str()),
            x,
            y,
            x_mm: x * x_mm,
            y_mm: y * y_mm,
            total: *total,
            force_n: *newtons,
            peak: *peak,
            area: *area,
            duration: host_time_us.saturating_sub(contact.onset_us) as f64 / 1e6,
            age_us: host_time_us.saturating_sub(*host_us),
            parts: parts.iter().map(part).collect(),
        }
    }
}

/// The schema as the structs give it: as programs for recordings want it, and as it is.
#[cfg(feature = "schema")]
pub fn robot_contacts_schema() -> [serde_json::Value; 2] {
    [schema::plain::<RobotContactsLine<'static>>(), schema::of::<RobotContactsLine<'static>>()]
}
