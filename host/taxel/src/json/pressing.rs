//! The JSON message of what presses on the robot.

use super::lines::{LandedLine, PressingLine, PushLine, WrenchLine};
use crate::body::{DVec3, Surface, wrenches};
use crate::client::Client;
use taxel_core::body::Placed;
use taxel_core::format::Micros;
use taxel_core::garment::Layout;
use taxel_core::surface::{Landed, Micrometres, ONE, UnitVector, Wrench};
use taxel_core::wire::PressingReport;

/// The message of a report.
pub fn line(report: &PressingReport) -> PressingLine<'_> {
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
        contacts: report.contacts.iter().map(contact).collect(),
        links: report.links.iter().map(wrench).collect(),
    }
}

/// The message that a board would send about the client's newest image and contacts, of this time, if it had the
/// surface: for boards that have none, and for recordings. A contact's force is its total, against the normal
/// at its centroid (on a curved link a little more than the sum of its taxels' forces); that of a link is
/// the sum over all taxels, touched or not. None without an image of this surface's garment.
pub fn computed<'a>(
    client: &Client,
    time: Micros,
    layout: &Layout,
    surface: &'a Surface,
) -> Option<PressingLine<'a>> {
    let (frame, image) = client.image().filter(|(_, image)| image.len() == surface.places().len())?;
    let counts = |force: DVec3| force.to_array().map(|part| part.round() as i32);
    let name = |link: usize| surface.links().get(link).map_or("", String::as_str);
    let contact = |Placed { contact, .. }: &Placed| {
        let place = surface.at(layout, contact.panel, contact.x.to_f64(), contact.y.to_f64())?;
        let force = counts(place.normal * -f64::from(contact.total));
        let own = PushLine { at_m: place.at.to_array(), normal: place.normal.to_array(), force };
        Some(LandedLine { id: contact.id, link: name(place.link), own, base: None })
    };
    let pressed: Vec<f64> = image.iter().map(|counts| f64::from(*counts)).collect();
    let links = wrenches(surface, &pressed).into_iter().filter(|wrench| wrench.pressed > 0.0);
    Some(PressingLine {
        frame,
        time_us: time.0,
        posed_us: None,
        contacts: client.contacts().iter().filter_map(contact).collect(),
        links: links
            .map(|wrench| WrenchLine {
                link: name(wrench.link),
                force: counts(wrench.force),
                moment: wrench.moment.to_array(),
                pressed: wrench.pressed as u32,
                center_m: wrench.center.to_array(),
            })
            .collect(),
    })
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
