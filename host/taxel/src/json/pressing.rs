//! The JSON message of what presses on the robot.

use super::lines::{LandedLine, PressingLine, PushLine, WrenchLine};
use crate::client::Client;
use taxel_core::surface::{Landed, Micrometres, ONE, UnitVector, Wrench};
use taxel_core::wire::PressingReport;

/// The message of a report that the client has just taken.
pub fn line<'a>(client: &Client, report: &'a PressingReport) -> PressingLine<'a> {
    let name =
        |link: u8| report.links.iter().find(|wrench| wrench.link == link).map_or("", |w| w.name.as_str());
    let contact = |landed: &Landed| LandedLine {
        id: landed.id,
        link: name(landed.spot.link),
        own: push(landed.spot.at, landed.spot.normal, landed.force),
        base: landed.base.map(|base| push(base.at, base.normal, base.force)),
    };
    PressingLine {
        frame: report.frame,
        time_us: report.time.0,
        posed_us: report.posed.map(|time| time.0),
        pose_age_us: report.posed.map(|time| report.time.0.wrapping_sub(time.0) as i64),
        pose_error_m: client.pose_error(report.frame).filter(|_| report.posed.is_some()),
        contacts: report.contacts.iter().map(contact).collect(),
        links: report.links.iter().map(wrench).collect(),
    }
}

fn wrench(wrench: &Wrench) -> WrenchLine<'_> {
    WrenchLine {
        link: &wrench.name,
        force: wrench.force,
        moment: wrench.moment.map(|moment| moment as f64 / 1000.0),
        pressed: wrench.pressed,
        center_m: metres(wrench.center),
    }
}

fn push(at: Micrometres, normal: UnitVector, force: [i32; 3]) -> PushLine {
    PushLine { at_m: metres(at), normal: normal.map(|part| f64::from(part) / f64::from(ONE)), force }
}

fn metres(at: Micrometres) -> [f64; 3] {
    at.map(|um| f64::from(um) / 1e6)
}
