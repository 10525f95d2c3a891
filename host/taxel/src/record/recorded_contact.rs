//! A contact in a recording.

use crate::json::ContactLine;
use serde::Serialize;
use std::borrow::Cow;

/// A contact, without what follows from other keys or from the garment. The wire has its numbers exactly.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RecordedContact<'a> {
    /// Number of the contact, unique since the board's start.
    id: u32,
    /// `onset`, `held` or `released`.
    phase: &'static str,
    /// Name of the panel.
    panel_name: &'a str,
    /// Region of the body.
    region: &'a str,
    /// Sum of the pressure of its taxels, counts.
    total: u32,
    /// Greatest pressure of a taxel, counts.
    peak: u16,
    /// Row of that taxel, from 0.
    peak_row: u16,
    /// Column of that taxel, from 0.
    peak_column: u16,
    /// Number of taxels.
    area: u16,
    /// Number of taxels at its edge.
    perimeter: u16,
    /// Mean slope over those taxels, counts per taxel.
    edge: u16,
    /// Centroid along the columns, taxels from the first column.
    column: f64,
    /// Centroid along the rows, taxels from the first row.
    row: f64,
    /// Direction of the long axis, rad; absent if there is no clear direction.
    #[serde(skip_serializing_if = "Option::is_none")]
    azimuth_rad: Option<f64>,
    /// Elongation, 0 (round) to 1 (a line).
    anisotropy: f64,
    /// Width across the long axis, mm.
    breadth_mm: f64,
    /// Normalised moment of inertia; depends on the pressure.
    nmi: f64,
    /// `nmi` times the root of the mean pressure, weighted by the pressure itself.
    nmi_s2: f64,
    /// Name of the shape, or `unknown`.
    shape: Cow<'a, str>,
    /// Share of the votes for that shape, 0 to 1; of an unknown shape, how far it is from all known ones.
    confidence: f64,
    /// Displacement along the columns since the onset, taxels.
    moved_columns: f64,
    /// Displacement along the rows since the onset, taxels.
    moved_rows: f64,
    /// Velocity along the columns, taxels/s.
    columns_per_s: f64,
    /// Velocity along the rows, taxels/s.
    rows_per_s: f64,
    /// True if it slides over the surface.
    slip: bool,
    /// True if all of it may be drift of the baseline.
    unsure: bool,
    /// Time since the onset, ms.
    duration_ms: u32,
    /// Greatest total so far, counts.
    peak_total: u32,
    /// Width at the greatest total, mm.
    peak_breadth_mm: f64,
    /// First row of the box around its taxels on its panel.
    top: u16,
    /// Last row of the box.
    bottom: u16,
    /// First column of the box.
    left: u16,
    /// Last column of the box.
    right: u16,
    /// Age of the form, frames; absent unless ages were requested.
    #[serde(skip_serializing_if = "Option::is_none")]
    form_age: Option<u8>,
}

impl<'a> RecordedContact<'a> {
    /// The contact of a line, its numbers rounded to thousandths, those of `nmi` to a hundredth of that.
    pub fn of(line: ContactLine<'a>) -> RecordedContact<'a> {
        RecordedContact {
            id: line.id,
            phase: line.phase,
            panel_name: line.panel_name,
            region: line.region,
            total: line.total,
            peak: line.peak,
            peak_row: line.peak_row,
            peak_column: line.peak_column,
            area: line.area,
            perimeter: line.perimeter,
            edge: line.edge,
            column: rounded(line.column, 1e3),
            row: rounded(line.row, 1e3),
            azimuth_rad: line.azimuth_rad.map(|azimuth| rounded(azimuth, 1e3)),
            anisotropy: rounded(line.anisotropy, 1e3),
            breadth_mm: line.breadth_mm,
            nmi: rounded(line.nmi, 1e5),
            nmi_s2: rounded(line.nmi_s2, 1e3),
            shape: line.shape,
            confidence: rounded(line.confidence, 1e3),
            moved_columns: rounded(line.moved_columns, 1e3),
            moved_rows: rounded(line.moved_rows, 1e3),
            columns_per_s: rounded(line.columns_per_s, 1e3),
            rows_per_s: rounded(line.rows_per_s, 1e3),
            slip: line.slip,
            unsure: line.unsure,
            duration_ms: line.duration_ms,
            peak_total: line.peak_total,
            peak_breadth_mm: line.peak_breadth_mm,
            top: line.top,
            bottom: line.bottom,
            left: line.left,
            right: line.right,
            form_age: line.form_age,
        }
    }
}

/// A number, rounded to this many parts of one; never -0.
fn rounded(number: f64, parts: f64) -> f64 {
    (number * parts).round() / parts + 0.0
}
