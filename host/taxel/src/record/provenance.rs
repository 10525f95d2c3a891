//! Origin of a recording: its attachments and metadata.

use crate::client::BoardDescription;
use crate::error::Result;
use crate::files::calibrate::{Calibration, ForceScale};
use crate::files::garments;
use crate::recording::{CALIBRATION, Store, Writer, attachment_of};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use taxel_core::garment::Layout;
use taxel_core::wire::PROTOCOL;

/// Properties of a source that its board does not report.
#[derive(Debug, Default, Clone)]
pub struct Origin {
    /// Short name.
    pub label: String,
    /// Scale from counts to newtons, with the calibration that was sent to the board.
    pub scale: ForceScale,
}

/// Attaches garment, scene, geometry and the calibration in use; writes versions, source, calibration and
/// scale as metadata: of the file's only board, or of this one of a robot.
pub fn attach<S: Store>(
    writer: &mut Writer<S>,
    description: &BoardDescription,
    origin: &Origin,
    ns: u64,
    board: Option<&str>,
) -> Result<()> {
    let named = |name: &str| attachment_of(board, name);
    let garment = garments::text(&description.garment, "the garment of a recording")?;
    writer.attach(&named("garment.toml"), "application/toml", garment.as_bytes(), ns)?;
    writer.attach(
        &named("scene.json"),
        "application/json",
        &serde_json::to_vec_pretty(&description.scene)?,
        ns,
    )?;
    let geometry = serde_json::to_vec(&geometry(&description.layout))?;
    writer.attach(&named("geometry.json"), "application/json", &geometry, ns)?;
    let scale = origin.scale.source_counts_per_newton().map_or(String::new(), |counts| counts.to_string());
    let calibration = origin.scale.calibration().filter(|made| made.is_in_force(&description.calibration));
    if let Some(made) = calibration {
        writer.attach(&named(CALIBRATION), "application/toml", made.text()?.as_bytes(), ns)?;
    }
    let words = [
        ("program", concat!("taxel ", env!("CARGO_PKG_VERSION")).to_string()),
        ("firmware", description.firmware.clone()),
        ("simulated", description.is_simulated().to_string()),
        ("protocol", PROTOCOL.to_string()),
        ("source", origin.label.clone()),
        ("host", host()),
        ("garment", description.garment.name.to_string()),
        ("scene", description.scene.name.to_string()),
        ("calibration", description.calibration.clone()),
        ("counts_per_newton", scale),
    ];
    let words = words.into_iter().chain(calibration.into_iter().flat_map(certified));
    let words: BTreeMap<_, _> = words.map(|(name, value)| (name.to_string(), value)).collect();
    writer.metadata(&named("taxel"), words)
}

/// Author, date, method and fit of a calibration.
fn certified(made: &Calibration) -> [(&'static str, String); 5] {
    let [error, worst, hysteresis, noise] =
        [made.fit.error, made.fit.worst, made.fit.hysteresis, made.fit.noise].map(|part| 100.0 * part);
    let fit = format!(
        "forces within {error:.2} % rms, {worst:.2} % at most; hysteresis {hysteresis:.2} %, noise of a taxel {noise:.2} %"
    );
    [
        ("calibration_by", made.by.clone()),
        ("calibration_date", made.date.clone()),
        ("calibration_how", made.how.clone()),
        ("calibration_board", made.board.clone()),
        ("calibration_fit", fit),
    ]
}

/// The host's name, if it has one.
fn host() -> String {
    let known = std::fs::read_to_string("/proc/sys/kernel/hostname").ok();
    let known = known.or_else(|| std::env::var("HOSTNAME").or_else(|_| std::env::var("COMPUTERNAME")).ok());
    known.unwrap_or_default().trim().to_string()
}

/// Panels in order: first taxel, size, pitch, link, region. Taxel `first + row * columns + column` is at
/// (`column * pitch_mm[0]`, `row * pitch_mm[1]`) of its panel.
fn geometry(layout: &Layout) -> Value {
    let panel = |area: &taxel_core::garment::Area| {
        json!({
            "name": area.name,
            "link": area.link,
            "region": layout.regions().get(usize::from(area.region)),
            "first": area.base,
            "rows": area.rows,
            "columns": area.columns,
            "pitch_mm": area.pitch_um.map(|um| f64::from(um) / 1000.0),
        })
    };
    json!({ "taxels": layout.taxels(), "panels": layout.areas().iter().map(panel).collect::<Vec<_>>() })
}
