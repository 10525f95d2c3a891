//! Contacts and forces on the robot, by link: a message of the package `taxel_msgs`, forces and points as standard
//! messages.

use super::cdr::Cdr;
use super::messages::{self, cloud};
use crate::body::{Surface, TaxelPlace};
use crate::client::Client;
use crate::files::calibrate::{ForceBasis, Newtons};
use crate::json::pose_error;
use taxel_core::format::Micros;
use taxel_core::garment::Area;
use taxel_core::surface::{InBase, Landed, Micrometres, ONE, Uncertainty, UnitVector, Wrench};
use taxel_core::wire::{PressingReport, RegionsReport};

/// Fields of a point.
const FIELDS: [&str; 7] = ["x", "y", "z", "normal_x", "normal_y", "normal_z", "pressure"];

/// `taxel_msgs/msg/Pressing`: `base` is the frame of the robot's base, if there is a robot. Forces whose newtons are
/// unknown are NaN.
pub fn pressing(us: u64, report: &PressingReport, base: &str, newtons: Option<&Newtons>) -> Vec<u8> {
    let scale = newtons.and_then(Newtons::counts_per_newton).unwrap_or(f64::NAN);
    let age = |posed: Micros| report.time.0.wrapping_sub(posed.0) as i64 as f64;
    let name =
        |link: u8| report.links.iter().find(|one| one.link == link).map_or("", |one| one.name.as_str());
    Cdr::default()
        .time(us)
        .text(base)
        .u32(report.frame)
        .text(newtons.and_then(Newtons::basis).map_or("", ForceBasis::as_str))
        .f64(report.posed.map_or(f64::NAN, age))
        .f64(pose_error(report).unwrap_or(f64::NAN))
        .list(&report.contacts, |cdr, contact| {
            let cdr = landed(cdr, contact, name(contact.spot.link), scale);
            uncertain(cdr, &report.contact_bounds, &contact.id, scale)
        })
        .list(&report.links, |cdr, link| {
            let cdr = link_wrench(cdr, link, scale);
            uncertain(cdr, &report.link_bounds, &link.link, scale)
        })
        .finish()
}

/// `taxel_msgs/msg/Landed`, but for what is uncertain of it.
fn landed(cdr: Cdr, contact: &Landed, link: &str, scale: f64) -> Cdr {
    let cdr = cdr.u32(contact.id).text(link);
    let cdr = push(cdr, contact.spot.at, contact.spot.normal, contact.force, scale);
    match contact.base {
        Some(InBase { at, normal, force }) => push(cdr, at, normal, force, scale),
        None => cdr.f64s([f64::NAN; 9]),
    }
}

/// A place, a direction and a force.
fn push(cdr: Cdr, at: Micrometres, normal: UnitVector, force: [i32; 3], scale: f64) -> Cdr {
    let normal = normal.map(|part| f64::from(part) / f64::from(ONE));
    cdr.f64s(metres(at)).f64s(normal).f64s(force.map(|part| f64::from(part) / scale))
}

/// `taxel_msgs/msg/LinkWrench`, but for what is uncertain of it.
fn link_wrench(cdr: Cdr, wrench: &Wrench, scale: f64) -> Cdr {
    let [force, moment] = vectors(wrench, scale);
    let cdr = cdr.text(&wrench.name).f64s(force).f64s(moment);
    cdr.f64(f64::from(wrench.pressed) / scale).u32(wrench.pressed).f64s(metres(wrench.center))
}

/// `taxel_msgs/msg/Uncertain` of a contact or of a link.
fn uncertain<T: PartialEq>(cdr: Cdr, all: &[(T, Uncertainty)], of: &T, scale: f64) -> Cdr {
    let reported = all.iter().find(|(named, _)| named == of);
    let Uncertainty { saturated, faulty, less, more, off } =
        reported.map_or_else(Default::default, |(_, it)| *it);
    let [less, more] = [less, more].map(|counts| f64::from(counts) / scale);
    cdr.u16(saturated).u16(faulty).f64s([less, more, f64::from(off) / 1e6])
}

/// Force and moment.
fn vectors(wrench: &Wrench, scale: f64) -> [[f64; 3]; 2] {
    [wrench.force.map(|part| f64::from(part) / scale), wrench.moment.map(|part| part as f64 / 1000.0 / scale)]
}

fn metres(at: Micrometres) -> [f64; 3] {
    at.map(|um| f64::from(um) / 1e6)
}

/// `geometry_msgs/msg/WrenchStamped` of a link, about its origin; zero if nothing presses on it. Newtons and
/// newton metres with counts per newton, else counts and counts times metres.
pub fn wrench(us: u64, link: &str, wrench: Option<&Wrench>, per_newton: Option<f64>) -> Vec<u8> {
    let parts = wrench.map_or([[0.0; 3]; 2], |wrench| vectors(wrench, per_newton.unwrap_or(1.0)));
    Cdr::default().time(us).text(link).f64s(parts.concat()).finish()
}

/// `taxel_msgs/msg/BodyRegions`
pub fn regions(us: u64, client: &Client, report: &RegionsReport) -> Vec<u8> {
    let named: Vec<_> = report.regions.iter().enumerate().collect();
    Cdr::default()
        .time(us)
        .text("")
        .u32(report.frame)
        .list(&named, |cdr, (number, region)| {
            cdr.text(client.surface_region(*number))
                .u8(region.phase as u8)
                .u8(region.way as u8)
                .u8(region.contacts)
                .text(region.strength.as_str())
                .text(region.extent.as_str())
                .text(&client.shape_name(region.class))
                .u64(region.since.0)
        })
        .finish()
}

/// `sensor_msgs/msg/PointCloud2` of a panel in the frame of the link that it lies on: place and normal of
/// each taxel, and its pressure, counts. NaN for a taxel without a place. Without a place of the panel, its points
/// lie in its own frame. `board`: as of [`messages`].
pub fn points(board: &str, us: u64, area: &Area, surface: Option<&Surface>, values: &[u16]) -> Vec<u8> {
    let placed = surface.and_then(|surface| points_on_link(us, area, surface, values));
    placed.unwrap_or_else(|| messages::points(board, us, area, values))
}

/// Points of a panel on its link; none if no taxel has a place.
fn points_on_link(us: u64, area: &Area, surface: &Surface, values: &[u16]) -> Option<Vec<u8>> {
    let places = surface.places().get(usize::from(area.base)..)?;
    let link = places.iter().take(values.len()).flatten().next()?.link;
    let link = surface.links().get(link)?;
    let point = |(value, place): (&u16, &Option<TaxelPlace>)| {
        let parts = place.map_or([f64::NAN; 6], |place| {
            let ([x, y, z], [nx, ny, nz]) = (place.at.to_array(), place.normal.to_array());
            [x, y, z, nx, ny, nz]
        });
        let [x, y, z, nx, ny, nz] = parts.map(|part| part as f32);
        [x, y, z, nx, ny, nz, f32::from(*value)]
    };
    let points: Vec<[f32; 7]> = values.iter().zip(places).map(point).collect();
    Some(cloud((us, link), area, FIELDS, &points))
}
