//! NumPy arrays.
//!
//! | array | type, shape | what |
//! |---|---|---|
//! | `PANEL` | u16 \[n, rows, columns\] | pressure, counts; `taxel process` reads them back |
//! | `frame` | u32 \[n\] | number of the scan |
//! | `time_us`, `host_time_us` | u64 \[n\] | its start, the board's time and the host's |
//! | `intent` | f64 \[n, concepts\] | activation of each concept of the scene's map, -1 ..= 1; where there is one |
//! | `contact_frame` | u32 \[m\] | the scan of each contact; a contact has an entry for each frame in which it is |
//! | `contact_id`, `_panel`, `_total`, `_peak`, `_area` | u32 \[m\] | |
//! | `contact_x`, `_y`, `_azimuth`, `_nmi` | f64 \[m\] | taxels, taxels, rad (NaN: none), 1 |

use super::frames::{self, Frames};
use anyhow::{Context, Result};
use npyz::{AutoSerialize, WriterBuilder};
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;
use taxel_core::body::Placed;
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

type Archive = ZipWriter<BufWriter<File>>;

/// An array's name, and its value for a contact.
type Column<T> = (&'static str, fn(&Placed) -> T);

/// What is told of a contact in whole numbers, and in others.
const WHOLE: [Column<u32>; 5] = [
    ("contact_id", |placed| placed.contact.id),
    ("contact_panel", |placed| placed.contact.panel.into()),
    ("contact_total", |placed| placed.contact.total),
    ("contact_peak", |placed| placed.contact.peak.into()),
    ("contact_area", |placed| placed.contact.area.into()),
];
const REAL: [Column<f64>; 4] = [
    ("contact_x", |placed| placed.contact.x.to_f64()),
    ("contact_y", |placed| placed.contact.y.to_f64()),
    ("contact_azimuth", |placed| placed.contact.azimuth.map_or(f64::NAN, |turn| turn.to_radians())),
    ("contact_nmi", |placed| placed.shape.nmi.to_f64()),
];

/// Writes the archive; the number of frames. It goes through the recording once for what is small, and once for each panel.
pub fn write(frames: &Frames<'_>, path: &Path) -> Result<u64> {
    let mut archive = Archive::new(BufWriter::new(File::create(path).context("it cannot be written")?));
    let mut areas = Vec::new();
    let (mut numbers, mut times, mut host_times) = (Vec::new(), Vec::new(), Vec::new());
    let (mut of, mut contacts, mut intent) = (Vec::new(), Vec::new(), Vec::new());
    let mut concepts = 0;
    let count = frames.each(|frame| {
        areas = frame.worn.layout.areas().to_vec();
        numbers.push(frame.number);
        times.push(frame.board_us);
        host_times.push(frame.host_us);
        of.extend(frame.contacts.iter().map(|_| frame.number));
        contacts.extend_from_slice(&frame.contacts);
        concepts = frame.worn.concepts.len() as u64;
        intent.extend(frame.activations.iter().map(|activation| activation.to_f64()));
        Ok(())
    })?;
    for area in &areas {
        let shape = [count, area.rows.into(), area.columns.into()];
        let mut array = begin::<u16>(&mut archive, &area.name, &shape)?;
        frames.each(|frame| Ok(array.extend(frames::panel(area, &frame.values).iter().copied())?))?;
        array.finish()?;
    }
    list(&mut archive, "frame", numbers)?;
    list(&mut archive, "time_us", times)?;
    list(&mut archive, "host_time_us", host_times)?;
    if concepts > 0 {
        let mut array = begin::<f64>(&mut archive, "intent", &[count, concepts])?;
        array.extend(intent)?;
        array.finish()?;
    }
    list(&mut archive, "contact_frame", of)?;
    for (name, value) in WHOLE {
        list(&mut archive, name, contacts.iter().map(value).collect())?;
    }
    for (name, value) in REAL {
        list(&mut archive, name, contacts.iter().map(value).collect())?;
    }
    archive.finish()?.flush()?;
    Ok(count)
}

fn begin<'a, T: AutoSerialize>(
    archive: &'a mut Archive,
    name: &str,
    shape: &[u64],
) -> Result<npyz::NpyWriter<T, &'a mut Archive>> {
    let options = SimpleFileOptions::default().large_file(true);
    archive.start_file(format!("{name}.npy"), options)?;
    Ok(npyz::WriteOptions::<T>::new().default_dtype().shape(shape).writer(archive).begin_nd()?)
}

fn list<T: AutoSerialize>(archive: &mut Archive, name: &str, values: Vec<T>) -> Result<()> {
    let mut array = begin::<T>(archive, name, &[values.len() as u64])?;
    array.extend(values)?;
    Ok(array.finish()?)
}
