//! JSON objects shared by all commands.
//!
//! Lengths are in taxels and, with `_mm`, in millimetres if the garment has a pitch; angles in radians, times
//! in seconds, pressure in counts. Floats are finite or `null`.

mod frames;
mod messages;
pub mod pins;

pub use frames::{Replay, ReplayState};
pub use messages::{MessagePrinter, message};

use serde_json::{Map, Value, json};
use taxel_core::body::Placed;
use taxel_core::contact::{Contact, Phase};
use taxel_core::format::{Name, Q15};
use taxel_core::garment::Layout;
use taxel_core::intent::Leading;
use taxel_core::shape::Base;

/// Encodes a contact with its shape and place. `unsure`: it may be drift.
pub fn contact(placed: &Placed, layout: &Layout, unsure: bool) -> Value {
    let Placed { contact, shape, region } = placed;
    let area = layout.areas().get(usize::from(contact.panel));
    let base = Base::BUILT_IN;
    let mut object = json!({
        "id": contact.id,
        "phase": phase(contact.phase),
        "panel": contact.panel,
        "panel_name": area.map_or("", |a| a.name.as_str()),
        "region": layout.regions().get(usize::from(*region)).map_or("", Name::as_str),
        "link": area.map_or("", |a| a.link.as_str()),
        "total": contact.total,
        "peak": contact.peak,
        "peak_row": contact.peak_at.row,
        "peak_column": contact.peak_at.column,
        "area": contact.area,
        "perimeter": contact.perimeter,
        "edge": contact.edge,
        "x": contact.x.to_f64(),
        "y": contact.y.to_f64(),
        "azimuth": contact.azimuth.map(|a| a.to_radians()),
        "anisotropy": contact.anisotropy.to_f64(),
        "breadth_mm": f64::from(contact.breadth) / 10.0,
        "nmi": shape.nmi.to_f64(),
        "nmi_peak": shape.nmi_peak.to_f64(),
        "nmi_s2": shape.nmi_s2.to_f64(),
        "shape": base.name(shape.class),
        "confidence": shape.confidence.to_f64(),
        "dx": contact.dx.to_f64(),
        "dy": contact.dy.to_f64(),
        "vx": contact.vx.to_f64(),
        "vy": contact.vy.to_f64(),
        "slip": contact.slip,
        "unsure": unsure,
        "duration": f64::from(contact.duration_ms) / 1000.0,
        "peak_total": contact.peak_total,
        "peak_breadth_mm": f64::from(contact.peak_breadth) / 10.0,
    });
    if let (Some(object), Some([x, y])) = (object.as_object_mut(), pitch_mm(layout, contact)) {
        object.insert("x_mm".into(), json!(contact.x.to_f64() * x));
        object.insert("y_mm".into(), json!(contact.y.to_f64() * y));
    }
    object
}

/// Distance of taxel centres on a contact's panel, mm; none if unknown.
fn pitch_mm(layout: &Layout, contact: &Contact) -> Option<[f64; 2]> {
    let pitch = layout.areas().get(usize::from(contact.panel))?.pitch_um;
    (!pitch.contains(&0)).then(|| pitch.map(|um| f64::from(um) / 1000.0))
}

/// Name of a phase.
pub fn phase(phase: Phase) -> &'static str {
    match phase {
        Phase::Onset => "onset",
        Phase::Held => "held",
        Phase::Released => "released",
    }
}

/// Encodes the leading intention and the activation of each concept of the map.
pub fn intent(leading: Leading, names: &[Name], concepts: &[Q15]) -> Value {
    let concepts: Map<String, Value> =
        names.iter().zip(concepts).map(|(name, value)| (name.to_string(), json!(value.to_f64()))).collect();
    json!({ "leading": leading.as_str(), "concepts": concepts })
}
