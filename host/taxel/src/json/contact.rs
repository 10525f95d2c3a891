//! A contact as JSON.

use serde::Serialize;
use std::borrow::Cow;
use taxel_core::body::Placed;
use taxel_core::contact::{Contact, Phase};
use taxel_core::format::Name;
use taxel_core::garment::Layout;

/// A contact with its shape and place.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ContactLine<'a> {
    /// Number of the contact, unique since the board's start.
    pub id: u32,
    /// `onset`, `held` or `released`.
    pub phase: &'static str,
    /// Index of the panel.
    pub panel: u8,
    /// Name of the panel.
    pub panel_name: &'a str,
    /// Region of the body.
    pub region: &'a str,
    /// Link of the robot.
    pub link: &'a str,
    /// Sum of the pressure of its taxels, counts.
    pub total: u32,
    /// Greatest pressure of a taxel, counts.
    pub peak: u16,
    /// Row of that taxel, from 0.
    pub peak_row: u16,
    /// Column of that taxel, from 0.
    pub peak_column: u16,
    /// Number of taxels.
    pub area: u16,
    /// Number of taxels at its edge.
    pub perimeter: u16,
    /// Mean slope over those taxels, counts per taxel.
    pub edge: u16,
    /// Centroid along the columns, taxels from the first column.
    pub column: f64,
    /// Centroid along the rows, taxels from the first row.
    pub row: f64,
    /// Centroid along the columns, mm from the first column; absent if the pitch is unknown.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub x_mm: Option<f64>,
    /// Centroid along the rows, mm from the first row; absent if the pitch is unknown.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub y_mm: Option<f64>,
    /// Direction of the long axis, rad; null if there is no clear direction.
    pub azimuth_rad: Option<f64>,
    /// Elongation, 0 (round) to 1 (a line).
    pub anisotropy: f64,
    /// Width across the long axis, mm.
    pub breadth_mm: f64,
    /// Normalised moment of inertia; depends on the pressure.
    pub nmi: f64,
    /// `nmi` times the root of the peak.
    pub nmi_peak: f64,
    /// `nmi` times the root of the mean pressure, weighted by the pressure itself.
    pub nmi_s2: f64,
    /// Name of the shape, or `unknown`.
    pub shape: Cow<'a, str>,
    /// Share of the votes for that shape, 0 to 1; of an unknown shape, how far it is from all known ones.
    pub confidence: f64,
    /// Displacement along the columns since the onset, taxels.
    pub moved_columns: f64,
    /// Displacement along the rows since the onset, taxels.
    pub moved_rows: f64,
    /// Velocity along the columns, taxels/s.
    pub columns_per_s: f64,
    /// Velocity along the rows, taxels/s.
    pub rows_per_s: f64,
    /// True if it slides over the surface.
    pub slip: bool,
    /// True if all of it may be drift of the baseline.
    pub unsure: bool,
    /// Time since the onset, ms.
    pub duration_ms: u32,
    /// Greatest total so far, counts.
    pub peak_total: u32,
    /// Width at the greatest total, mm.
    pub peak_breadth_mm: f64,
    /// First row of the box around its taxels on its panel.
    pub top: u16,
    /// Last row of the box.
    pub bottom: u16,
    /// First column of the box.
    pub left: u16,
    /// Last column of the box.
    pub right: u16,
    /// Age of the form, frames; absent unless ages were requested.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub form_age: Option<u8>,
    /// Normal force, N; absent if it is unknown.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub force_n: Option<f64>,
}

impl<'a> ContactLine<'a> {
    /// A contact of this shape. `unsure`: it may be drift.
    pub fn of(placed: &Placed, layout: &'a Layout, shape: Cow<'a, str>, unsure: bool) -> ContactLine<'a> {
        let Placed { contact, shape: form, region } = placed;
        let area = layout.areas().get(usize::from(contact.panel));
        let [x_mm, y_mm] = place_mm(layout, contact);
        ContactLine {
            id: contact.id,
            phase: phase(contact.phase),
            panel: contact.panel,
            panel_name: area.map_or("", |a| a.name.as_str()),
            region: layout.regions().get(usize::from(*region)).map_or("", Name::as_str),
            link: area.map_or("", |a| a.link.as_str()),
            total: contact.total,
            peak: contact.peak,
            peak_row: contact.peak_at.row,
            peak_column: contact.peak_at.column,
            area: contact.area,
            perimeter: contact.perimeter,
            edge: contact.edge,
            column: contact.x.to_f64(),
            row: contact.y.to_f64(),
            x_mm,
            y_mm,
            azimuth_rad: contact.azimuth.map(|a| a.to_radians()),
            anisotropy: contact.anisotropy.to_f64(),
            breadth_mm: f64::from(contact.breadth) / 10.0,
            nmi: form.nmi.to_f64(),
            nmi_peak: form.nmi_peak.to_f64(),
            nmi_s2: form.nmi_s2.to_f64(),
            shape,
            confidence: form.confidence.to_f64(),
            moved_columns: contact.dx.to_f64(),
            moved_rows: contact.dy.to_f64(),
            columns_per_s: contact.vx.to_f64(),
            rows_per_s: contact.vy.to_f64(),
            slip: contact.slip,
            unsure,
            duration_ms: contact.duration_ms,
            peak_total: contact.peak_total,
            peak_breadth_mm: f64::from(contact.peak_breadth) / 10.0,
            top: contact.bounds.top,
            bottom: contact.bounds.bottom,
            left: contact.bounds.left,
            right: contact.bounds.right,
            form_age: None,
            force_n: None,
        }
    }
}

/// Centroid of a contact on its panel, mm; none if the pitch is unknown.
fn place_mm(layout: &Layout, contact: &Contact) -> [Option<f64>; 2] {
    let area = layout.areas().get(usize::from(contact.panel)).filter(|area| !area.pitch_um.contains(&0));
    let Some([x, y]) = area.map(|area| area.pitch_um.map(|um| f64::from(um) / 1000.0)) else {
        return [None; 2];
    };
    [Some(contact.x.to_f64() * x), Some(contact.y.to_f64() * y)]
}

/// Name of a phase.
fn phase(phase: Phase) -> &'static str {
    match phase {
        Phase::Onset => "onset",
        Phase::Held => "held",
        Phase::Released => "released",
    }
}
