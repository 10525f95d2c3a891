//! A table of contacts: one row per contact and frame, a thousandth of the table of all taxels.
//!
//! | column | what |
//! |---|---|
//! | `time`, `frame` | start of the scan in board time, s; its number |
//! | `id`, `panel`, `link` | the contact, by its persistent number; its place |
//! | `column`, `row` | its centroid, taxels |
//! | `x`, `y` | its centroid, mm from the first taxel; empty if the pitch is unknown |
//! | `total`, `force` | sum of its pressure, counts, and N; empty if no scale for a sum is known |
//! | `peak`, `area` | greatest pressure, counts; taxels |
//! | `azimuth`, `nmi` | azimuth of its major axis, rad, empty if none; normalised moment of inertia |

use super::csv::{quoted, time};
use super::frames::{Frame, Frames};
use anyhow::Result;
use std::fmt::Display;
use std::io::Write;
use taxel_core::body::Placed;

/// Writes the table. Returns the number of frames.
pub fn write(frames: &Frames<'_>, out: &mut impl Write) -> Result<u64> {
    writeln!(out, "time,frame,id,panel,link,column,row,x,y,total,force,peak,area,azimuth,nmi")?;
    frames.each("exporting", |frame| frame.contacts.iter().try_for_each(|placed| row(frame, placed, out)))
}

fn row(frame: &Frame, placed: &Placed, out: &mut impl Write) -> Result<()> {
    let contact = &placed.contact;
    let area = frame.recorded.layout.areas().get(usize::from(contact.panel));
    let (name, link) = area.map_or(Default::default(), |area| (quoted(&area.name), quoted(&area.link)));
    let [column, row] = [contact.x.to_f64(), contact.y.to_f64()];
    let pitch = area.map_or([0.0; 2], |area| area.pitch_um.map(|um| f64::from(um) / 1000.0));
    let mm = |at: f64, pitch: f64| (pitch > 0.0).then(|| format!("{:.3}", at * pitch));
    let force = frame.recorded.units.newtons(contact.total).map(|newtons| format!("{newtons:.4}"));
    let azimuth = contact.azimuth.map(|turn| format!("{:.4}", turn.to_radians()));
    Ok(writeln!(
        out,
        "{},{},{},{name},{link},{column:.4},{row:.4},{},{},{},{},{},{},{},{:.6}",
        time(frame.board_us),
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
