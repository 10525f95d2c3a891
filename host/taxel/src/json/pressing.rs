//! The JSON message of what presses on the robot.

use super::lines::{LandedLine, PressingLine, PushLine, UncertainLine, WrenchLine};
use crate::body::{DVec3, Surface, wrenches};
use crate::client::Client;
use crate::files::calibrate::{ForceBasis, Newtons};
use std::collections::BTreeSet;
use taxel_core::body::Placed;
use taxel_core::contact::Contact;
use taxel_core::format::Micros;
use taxel_core::garment::{Layout, Place};
use taxel_core::surface::{Landed, Micrometres, ONE, Uncertainty, UnitVector, Wrench};
use taxel_core::wire::PressingReport;

/// The message of a report, whose forces are these newtons if they are known.
pub fn line<'a>(report: &'a PressingReport, newtons: Option<&Newtons>) -> PressingLine<'a> {
    let scale = newtons.and_then(Newtons::counts_per_newton);
    let name =
        |link: u8| report.links.iter().find(|wrench| wrench.link == link).map_or("", |w| w.name.as_str());
    let contact = |landed: &Landed| LandedLine {
        id: landed.id,
        link: name(landed.spot.link),
        own: push(landed.spot.at, landed.spot.normal, landed.force, scale),
        base: landed.base.map(|base| push(base.at, base.normal, base.force, scale)),
        uncertain: uncertain(&report.contact_bounds, &landed.id),
    };
    PressingLine {
        frame: report.frame,
        time_us: report.time.0,
        posed_us: report.posed.map(|time| time.0),
        pose_age_us: report.posed.map(|time| report.time.0.wrapping_sub(time.0) as i64),
        pose_error_m: pose_error(report),
        contacts: report.contacts.iter().map(contact).collect(),
        links: report.links.iter().map(|it| wrench(it, report, scale)).collect(),
        force_basis: newtons.and_then(Newtons::basis).map(ForceBasis::as_str),
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
    let scale = client.counts_per_newton();
    let low = client.description().map_or(1, |description| description.scene.contact.low);
    let counts = |force: DVec3| force.to_array().map(|part| part.round() as i32);
    let name = |link: usize| surface.links().get(link).map_or("", String::as_str);
    let contact = |Placed { contact, .. }: &Placed| {
        let place = surface.at(layout, contact.panel, contact.x.to_f64(), contact.y.to_f64())?;
        let force = counts(force_of(contact, layout, surface, image, low));
        let own = pushed(place.at.to_array(), place.normal.to_array(), force, scale);
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
                center_m: wrench.center.to_array(),
                uncertain: None,
                ..wrench_line(
                    name(wrench.link),
                    (counts(wrench.force), wrench.moment.to_array(), wrench.pressed as u32),
                    scale,
                )
            })
            .collect(),
        force_basis: client.force_basis(),
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

fn wrench<'a>(wrench: &'a Wrench, report: &PressingReport, scale: Option<f64>) -> WrenchLine<'a> {
    let moment = wrench.moment.map(|moment| moment as f64 / 1000.0);
    WrenchLine {
        center_m: metres(wrench.center),
        uncertain: uncertain(&report.link_bounds, &wrench.link),
        ..wrench_line(&wrench.name, (wrench.force, moment, wrench.pressed), scale)
    }
}

/// Force, moment and sum of magnitudes on a link, in counts and, with counts per newton, in newtons; without its
/// place.
fn wrench_line(
    link: &str,
    (force, moment, pressed): ([i32; 3], [f64; 3], u32),
    scale: Option<f64>,
) -> WrenchLine<'_> {
    WrenchLine {
        link,
        force_counts: force,
        moment_counts_m: moment,
        pressed_counts: pressed,
        force_n: newtons(force, scale),
        moment_nm: scale.map(|scale| moment.map(|part| part / scale)),
        pressed_n: scale.map(|scale| f64::from(pressed) / scale),
        center_m: [0.0; 3],
        uncertain: None,
    }
}

/// A force in newtons; none if the counts per newton are unknown.
fn newtons(force: [i32; 3], scale: Option<f64>) -> Option<[f64; 3]> {
    scale.map(|scale| force.map(|part| f64::from(part) / scale))
}

/// The most by which a place in the base is off, m, because joints are not known exactly and move on; none if
/// nobody knows.
pub(crate) fn pose_error(report: &PressingReport) -> Option<f64> {
    report.posed?;
    report.pose_errors.iter().map(|(_, um)| f64::from(*um) * 1e-6).reduce(f64::max)
}

/// Returns the uncertainty of a contact or of a link.
fn uncertain<T: PartialEq>(all: &[(T, Uncertainty)], of: &T) -> Option<UncertainLine> {
    let (_, it) = all.iter().find(|(named, _)| named == of)?;
    let Uncertainty { saturated, faulty, less, more, off } = *it;
    Some(UncertainLine {
        saturated,
        faulty,
        less_counts: less,
        more_counts: more,
        off_m: f64::from(off) / 1e6,
    })
}

fn push(at: Micrometres, normal: UnitVector, force: [i32; 3], scale: Option<f64>) -> PushLine {
    pushed(metres(at), normal.map(|part| f64::from(part) / f64::from(ONE)), force, scale)
}

fn pushed(at_m: [f64; 3], normal: [f64; 3], force: [i32; 3], scale: Option<f64>) -> PushLine {
    PushLine { at_m, normal, force_counts: force, force_n: newtons(force, scale) }
}

fn metres(at: Micrometres) -> [f64; 3] {
    at.map(|um| f64::from(um) / 1e6)
}
