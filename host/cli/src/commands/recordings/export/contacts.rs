//! A table of contacts: one row per contact and frame, a thousandth of the table of all taxels.
//!
//! | column | what |
//! |---|---|
//! | `time_us`, `frame` | start of the scan in board time, us; its number |
//! | `id`, `panel_name`, `link` | the contact, by its persistent number; its place |
//! | `column`, `row` | its centroid, taxels |
//! | `x_mm`, `y_mm` | its centroid, mm from the first taxel; empty if the pitch is unknown |
//! | `total` | sum of its pressure, counts |
//! | `force_n`, `force_basis` | normal force, N, and what it rests on: `calibrated`, `nominal`, `simulated`; empty if unknown |
//! | `peak`, `area` | greatest pressure, counts; taxels |
//! | `azimuth_rad`, `nmi` | azimuth of its major axis, empty if none; normalised moment of inertia |
//!
//! A column has the name, the unit and the value of the key in a contact's JSON, rounded.

use super::csv::quoted;
use super::frames::{Frame, Frames};
use anyhow::Result;
use std::fmt::Display;
use std::io::Write;
use taxel_core::body::Placed;

/// Writes the table. Returns the number of frames.
pub fn write(frames: &Frames<'_>, out: &mut impl Write) -> Result<u64> {
    writeln!(
        out,
        "time_us,frame,id,panel_name,link,column,row,x_mm,y_mm,total,force_n,force_basis,peak,area,azimuth_rad,nmi"
    )?;
    frames.each("exporting", |frame| frame.contacts.iter().try_for_each(|placed| row(frame, placed, out)))
}

fn row(frame: &Frame, placed: &Placed, out: &mut impl Write) -> Result<()> {
    let contact = &placed.contact;
    let area = frame.recorded.layout.areas().get(usize::from(contact.panel));
    let (name, link) = area.map_or(Default::default(), |area| (quoted(&area.name), quoted(&area.link)));
    let [column, row] = [contact.x.to_f64(), contact.y.to_f64()];
    let pitch = area.map_or([0.0; 2], |area| area.pitch_um.map(|um| f64::from(um) / 1000.0));
    let mm = |at: f64, pitch: f64| (pitch > 0.0).then(|| format!("{:.3}", at * pitch));
    let units = &frame.recorded.units;
    let force = units.force(&frame.recorded.layout, &frame.values, placed);
    let basis = if force.is_some() { units.basis() } else { "" };
    let force = force.map(|newtons| format!("{newtons:.4}"));
    let azimuth = contact.azimuth.map(|turn| format!("{:.4}", turn.to_radians()));
    Ok(writeln!(
        out,
        "{},{},{},{name},{link},{column:.4},{row:.4},{},{},{},{},{basis},{},{},{},{:.6}",
        frame.board_us,
        frame.number,
        contact.id,
        or_empty(mm(column, pitch[0])),
        or_empty(mm(row, pitch[1])),
        contact.total,
        or_empty(force),
        contact.peak,
        contact.area,
        or_empty(azimuth),
        placed.shape.nmi.to_f64(),
    )?)
}

fn or_empty(text: Option<impl Display>) -> String {
    text.map_or(String::new(), |text| text.to_string())
}
