//! Reports of a board, as messages of the package `taxel_msgs` (host/ros2/taxel_msgs), whose files define their
//! fields and units.

use super::cdr::Cdr;
use super::names::frame;
use crate::body::{DVec3, Surface, TaxelPlace};
use crate::client::Client;
use taxel_core::body::Placed;
use taxel_core::contact::Phase;
use taxel_core::format::{Name, Q15};
use taxel_core::garment::Area;
use taxel_core::intent::Outcome;
use taxel_core::shape::Class;
use taxel_core::symbol::{RegionState, Symbol};
use taxel_core::wire::{Health, IntentReport, ReactionReport, SymbolList};

/// Metres per micrometre.
const UM: f64 = 1e-6;

/// Header of a message about the whole garment.
fn head(us: u64) -> Cdr {
    Cdr::default().time(us).text("")
}

/// `taxel_msgs/msg/Contacts`: the present contacts of a client, and the `released` ones; with a body also
/// their places on links, if newtons are known also their forces. `board`: as of [`messages`](super::messages).
pub fn contacts(
    board: &str,
    us: u64,
    client: &Client,
    list_of: (u32, u16),
    released: &[Placed],
    surface: Option<&Surface>,
) -> Vec<u8> {
    let (frame, dropped) = list_of;
    let each = |cdr: Cdr, placed: &Placed| {
        let (at, force) = (&placed.contact, newtons(client, placed));
        let on = surface.zip(client.layout()).and_then(|(surface, layout)| {
            let place = surface.at(layout, at.panel, at.x.to_f64(), at.y.to_f64())?;
            Some((surface.links().get(place.link)?.as_str(), place))
        });
        on_link(contact(cdr, (board, us), client, placed, force), on, force)
    };
    let basis = client.force_basis().unwrap_or_default();
    head(us).u32(frame).text(basis).list(client.contacts(), each).list(released, each).u16(dropped).finish()
}

/// Normal force of a contact; NaN if it is not known.
fn newtons(client: &Client, placed: &Placed) -> f64 {
    client.force(placed).unwrap_or(f64::NAN)
}

/// The last fields of `taxel_msgs/msg/Contact`: the place on a link.
fn on_link(cdr: Cdr, on: Option<(&str, TaxelPlace)>, force: f64) -> Cdr {
    let unknown = DVec3::splat(f64::NAN);
    let (link, at, normal) = on.map_or(("", unknown, unknown), |(link, on)| (link, on.at, on.normal));
    // A component of 0 has no sign.
    let pushes = (normal * -force).to_array().map(|part| part + 0.0);
    cdr.text(link).f64s(at.to_array()).f64s(normal.to_array()).f64s(pushes)
}

/// `taxel_msgs/msg/Contact`, but for its place on a link.
fn contact(cdr: Cdr, (board, us): (&str, u64), client: &Client, placed: &Placed, force: f64) -> Cdr {
    let Placed { contact, shape, region } = placed;
    let area = client.layout().and_then(|layout| layout.areas().get(usize::from(contact.panel)));
    let (x, y) = (contact.x.to_f64(), contact.y.to_f64());
    let pitch = area.map(|area| area.pitch_um).filter(|pitch| !pitch.contains(&0));
    let position = pitch.map_or([f64::NAN, f64::NAN, 0.0], |[x_um, y_um]| {
        [x * (f64::from(x_um) * UM), y * (f64::from(y_um) * UM), 0.0]
    });
    let name = |name: fn(&Area) -> &Name| area.map_or("", |area| name(area).as_str());
    cdr.time(us)
        .text(&area.map_or_else(String::new, |area| frame(board, area)))
        .u8((contact.phase != Phase::Released).into())
        .u32(contact.id)
        .u8(phase(contact.phase))
        .u8(contact.panel)
        .text(name(|area| &area.name))
        .text(client.region_name(*region))
        .text(name(|area| &area.link))
        .f64s(position)
        .f64(force)
        .u32(contact.total)
        .u16(contact.peak)
        .u16(contact.peak_at.row)
        .u16(contact.peak_at.column)
        .u16(contact.bounds.top)
        .u16(contact.bounds.bottom)
        .u16(contact.bounds.left)
        .u16(contact.bounds.right)
        .u16(contact.area)
        .u16(contact.perimeter)
        .u16(contact.edge)
        .f64s([x, y])
        .f64(contact.azimuth.map_or(f64::NAN, |azimuth| azimuth.to_radians()))
        .f64(contact.anisotropy.to_f64())
        .f64(f64::from(contact.breadth) / 10.0)
        .f64s([shape.nmi.to_f64(), shape.nmi_peak.to_f64(), shape.nmi_s2.to_f64()])
        .text(&client.shape_name(shape.class))
        .f64(shape.confidence.to_f64())
        .f64s([contact.dx.to_f64(), contact.dy.to_f64(), contact.vx.to_f64(), contact.vy.to_f64()])
        .u8(contact.slip.into())
        .u8(client.is_unsure(contact.id).into())
        .u32(contact.duration_ms)
        .u32(contact.peak_total)
        .f64(f64::from(contact.peak_breadth) / 10.0)
}

/// Number of a phase in `Contact.msg`.
fn phase(phase: Phase) -> u8 {
    match phase {
        Phase::Onset => 0,
        Phase::Held => 1,
        Phase::Released => 2,
    }
}

/// `taxel_msgs/msg/Symbols`
pub fn symbols(us: u64, client: &Client, list: &SymbolList) -> Vec<u8> {
    let symbol = |cdr: Cdr, symbol: &Symbol| {
        let words = &symbol.words;
        cdr.u32(symbol.contact)
            .u8(phase(symbol.phase))
            .text(client.region_name(symbol.region))
            .text(words.strength.as_str())
            .text(words.extent.as_str())
            .text(words.span.as_str())
            .u8(words.moving.into())
            .text(&client.shape_name(Class(words.class.0)))
            .u32(symbol.peak_total)
            .u32(symbol.duration_ms)
    };
    let region = |cdr: Cdr, region: &RegionState| {
        cdr.text(client.region_name(region.region))
            .u8(region.contacts)
            .u32(region.total)
            .u16(region.peak)
            .u8(region.moving.into())
            .u64(region.since.0)
    };
    head(us).u32(list.frame).list(&list.events, symbol).list(&list.regions, region).finish()
}

/// `taxel_msgs/msg/Reaction`
pub fn reaction(us: u64, report: &ReactionReport) -> Vec<u8> {
    let reaction = &report.reaction;
    head(us)
        .u32(report.frame)
        .u8(reaction.index)
        .text(&reaction.name)
        .u8(reaction.active.into())
        .i32(reaction.value)
        .finish()
}

/// `taxel_msgs/msg/Intent`
pub fn intent(us: u64, client: &Client, report: &IntentReport) -> Vec<u8> {
    let outcome = match report.outcome {
        Outcome::Fixed => "fixed",
        Outcome::Cycle(_) => "cycle",
        Outcome::Unsettled => "unsettled",
    };
    let activations = client.activations();
    head(us)
        .u32(report.frame)
        .text(report.leading.as_str())
        .text(outcome)
        .u16(report.steps)
        .list(client.concepts(), |cdr, name: &Name| cdr.text(name))
        .list(&activations, |cdr, value: &Q15| cdr.f64(value.to_f64()))
        .finish()
}

/// `taxel_msgs/msg/Health`
pub fn health(us: u64, client: &Client, health: &Health) -> Vec<u8> {
    let counters = [
        health.scans,
        health.failed,
        health.overruns,
        health.thinned_frames,
        health.thinned_contacts,
        health.lost,
        health.refused,
    ];
    let faulty: Vec<u16> = client.faulty().keys().copied().collect();
    counters
        .into_iter()
        .fold(head(us), Cdr::u32)
        .u32(health.scan_us)
        .u32(health.process_us)
        .list(&faulty, |cdr, taxel| cdr.u16(*taxel))
        .finish()
}
