//! The JSON message of what presses on the robot.

use super::lines::{LandedLine, PressingLine, PushLine, UncertainLine, WrenchLine};
use crate::body::{DVec3, Surface, wrenches};
use crate::client::Client;
use std::collections::BTreeSet;
use taxel_core::body::Placed;
use taxel_core::contact::Contact;
use taxel_core::format::Micros;
use taxel_core::garment::{Layout, Place};
use taxel_core::surface::{Landed, Micrometres, ONE, Uncertainty, UnitVector, Wrench};
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
        uncertain: uncertain(&report.contact_bounds, &landed.id),
    };
    PressingLine {
        frame: report.frame,
        time_us: report.time.0,
        posed_us: report.posed.map(|time| time.0),
        pose_age_us: report.posed.map(|time| report.time.0.wrapping_sub(time.0) as i64),
        pose_error_m: pose_error(report),
        contacts: report.contacts.iter().map(contact).collect(),
        links: report.links.iter().map(|it| wrench(it, report)).collect(),
    }
}

/// The message that a board would send about the client's newest image and contacts, of this time, if it had the
/// surface: for boards that have none, and for recordings. A contact's taxels are those of the panel of its peak
/// that join this; where it crosses a seam, the pressure beyond counts as theirs. A link's force is the sum over
/// all taxels, touched or not. None without an image of this surface's garment.
pub fn computed<'a>(
    client: &Client,
    time: Micros,
    layout: &Layout,
    surface: &'a Surface,
) -> Option<PressingLine<'a>> {
    let (frame, image) = client.image().filter(|(_, image)| image.len() == surface.places().len())?;
    let low = client.description().map_or(1, |description| description.scene.contact.low);
    let counts = |force: DVec3| force.to_array().map(|part| part.round() as i32);
    let name = |link: usize| surface.links().get(link).map_or("", String::as_str);
    let contact = |Placed { contact, .. }: &Placed| {
        let place = surface.at(layout, contact.panel, contact.x.to_f64(), contact.y.to_f64())?;
        let force = counts(force_of(contact, layout, surface, image, low));
        let own = PushLine { at_m: place.at.to_array(), normal: place.normal.to_array(), force };
        Some(LandedLine { id: contact.id, link: name(place.link), own, base: None, uncertain: None })
    };
    let pressed: Vec<f64> = image.iter().map(|counts| f64::from(*counts)).collect();
    let links = wrenches(surface, &pressed).into_iter().filter(|wrench| wrench.pressed > 0.0);
    Some(PressingLine {
        frame,
        time_us: time.0,
        posed_us: None,
        pose_age_us: None,
        pose_error_m: None,
        contacts: client.contacts().iter().filter_map(contact).collect(),
        links: links
            .map(|wrench| WrenchLine {
                link: name(wrench.link),
                force: counts(wrench.force),
                moment: wrench.moment.to_array(),
                pressed: wrench.pressed as u32,
                center_m: wrench.center.to_array(),
                uncertain: None,
            })
            .collect(),
    })
}

/// Force of a contact, counts: the sum over the taxels of a panel that join its peak, at or above the low
/// threshold, scaled to its total.
fn force_of(contact: &Contact, layout: &Layout, surface: &Surface, image: &[u16], low: u16) -> DVec3 {
    let Place { panel, row, column } = contact.peak_at;
    let (mut waiting, mut seen) = (vec![(row, column)], BTreeSet::new());
    let (mut force, mut total) = (DVec3::ZERO, 0.0);
    while let Some((row, column)) = waiting.pop() {
        let Some(taxel) = layout.taxel(Place { panel, row, column }) else { continue };
        let pressure = image.get(taxel).copied().unwrap_or(0);
        if pressure < low.max(1) || !seen.insert(taxel) {
            continue;
        }
        if let Some(place) = surface.places().get(taxel).copied().flatten() {
            force -= place.normal * f64::from(pressure);
            total += f64::from(pressure);
        }
        let around = |at: u16| at.saturating_sub(1)..=at.saturating_add(1);
        waiting.extend(around(row).flat_map(|row| around(column).map(move |column| (row, column))));
    }
    if total > 0.0 { force * (f64::from(contact.total) / total) } else { DVec3::ZERO }
}

fn wrench<'a>(wrench: &'a Wrench, report: &PressingReport) -> WrenchLine<'a> {
    WrenchLine {
        link: &wrench.name,
        force: wrench.force,
        moment: wrench.moment.map(|moment| moment as f64 / 1000.0),
        pressed: wrench.pressed,
        center_m: metres(wrench.center),
        uncertain: uncertain(&report.link_bounds, &wrench.link),
    }
}

/// The most by which a place in the base is off, m, because joints are not known exactly and move on; none if
/// nobody knows.
pub fn pose_error(report: &PressingReport) -> Option<f64> {
    report.posed?;
    report.pose_errors.iter().map(|(_, um)| f64::from(*um) * 1e-6).reduce(f64::max)
}

/// Returns the uncertainty of a contact or of a link.
fn uncertain<T: PartialEq>(all: &[(T, Uncertainty)], of: &T) -> Option<UncertainLine> {
    let (_, it) = all.iter().find(|(named, _)| named == of)?;
    let Uncertainty { saturated, faulty, less, more, off } = *it;
    Some(UncertainLine { saturated, faulty, less, more, off_m: f64::from(off) / 1e6 })
}

fn push(at: Micrometres, normal: UnitVector, force: [i32; 3]) -> PushLine {
    PushLine { at_m: metres(at), normal: normal.map(|part| f64::from(part) / f64::from(ONE)), force }
}

fn metres(at: Micrometres) -> [f64; 3] {
    at.map(|um| f64::from(um) / 1e6)
}
