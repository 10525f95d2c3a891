//! NumPy arrays.
//!
//! | array | type, shape | what |
//! |---|---|---|
//! | `PANEL` | u16 \[n, rows, columns\] | pressure, counts; `taxel process` reads them back; see `entries.rs` for the names |
//! | `frame` | u32 \[n\] | number of the scan |
//! | `time_us`, `host_time_us` | u64 \[n\] | its start in board time and host time |
//! | `intent` | f64 \[n, concepts\] | activation of each concept of the scene's map, -1 ..= 1; if there is a map |
//! | `concepts` | text \[concepts\] | names of the columns of `intent` |
//! | `contact_frame` | u32 \[m\] | scan of each entry; a contact has an entry for each of its frames |
//! | `contact_id`, `_panel`, `_total`, `_peak`, `_area` | u32 \[m\] | |
//! | `contact_x`, `_y`, `_azimuth`, `_nmi` | f64 \[m\] | taxels, taxels, rad (NaN: none), 1 |

use super::archive::Archive;
use super::entries::Entries;
use super::frames::{self, Frame, Frames, RecordedGarment};
use super::npy::{Array, Number};
use anyhow::{Context, Result};
use std::io::{Seek, Write};
use std::path::Path;
use std::rc::Rc;
use taxel_core::body::Placed;

/// Name of an array, and its value for a contact.
type ContactArray<T> = (&'static str, fn(&Placed) -> T);

/// Arrays of contacts, with integers and with floats.
const WHOLE: [ContactArray<u32>; 5] = [
    ("contact_id", |placed| placed.contact.id),
    ("contact_panel", |placed| placed.contact.panel.into()),
    ("contact_total", |placed| placed.contact.total),
    ("contact_peak", |placed| placed.contact.peak.into()),
    ("contact_area", |placed| placed.contact.area.into()),
];
const REAL: [ContactArray<f64>; 4] = [
    ("contact_x", |placed| placed.contact.x.to_f64()),
    ("contact_y", |placed| placed.contact.y.to_f64()),
    ("contact_azimuth", |placed| placed.contact.azimuth.map_or(f64::NAN, |turn| turn.to_radians())),
    ("contact_nmi", |placed| placed.shape.nmi.to_f64()),
];

/// Names of the other arrays besides panels.
const OWN: [&str; 6] = ["frame", "time_us", "host_time_us", "intent", "concepts", "contact_frame"];

/// Writes the archive to `out`, which is at `output`. Returns the number of frames. Reads the recording
/// twice, because arrays begin with their sizes.
pub fn write(frames: &Frames<'_>, output: &Path, out: impl Write + Seek) -> Result<u64> {
    let (mut contacts, mut recorded) = (0, None);
    let count = frames.each("counting", |frame| {
        contacts += frame.contacts.len() as u64;
        recorded.get_or_insert_with(|| frame.recorded.clone());
        Ok(())
    })?;
    let recorded = recorded.context("it holds no image")?;
    let mut arrays = Arrays::begin(output, &recorded, [count, contacts])?;
    frames.each("exporting", |frame| arrays.take(frame))?;
    let mut archive = Archive::new(out);
    arrays.finish(&mut archive)?;
    archive.finish()?.flush()?;
    Ok(count)
}

/// All arrays of a recording.
struct Arrays {
    panels: Vec<Array>,
    numbers: Array,
    times: Array,
    host_times: Array,
    /// Activations, and names of the concepts.
    intent: Option<[Array; 2]>,
    of: Array,
    whole: Vec<Array>,
    real: Vec<Array>,
}

impl Arrays {
    /// Arrays for this many frames and contacts.
    fn begin(output: &Path, recorded: &Rc<RecordedGarment>, [count, contacts]: [u64; 2]) -> Result<Arrays> {
        let list = |name: &str, kind: &str, size: u64| Array::begin(output, name, kind, &[size]);
        let mut taken =
            Entries::of(OWN.into_iter().chain(WHOLE.map(|(name, _)| name)).chain(REAL.map(|(name, _)| name)));
        let panel = |area: &taxel_core::garment::Area| {
            let shape = [count, area.rows.into(), area.columns.into()];
            Array::begin(output, &taken.add(&area.name), u16::KIND, &shape)
        };
        let concepts = recorded.concepts.len() as u64;
        let intent = || -> Result<[Array; 2]> {
            let activations = Array::begin(output, "intent", f64::KIND, &[count, concepts])?;
            Ok([activations, names(output, recorded)?])
        };
        Ok(Arrays {
            panels: recorded.layout.areas().iter().map(panel).collect::<Result<_>>()?,
            numbers: list("frame", u32::KIND, count)?,
            times: list("time_us", u64::KIND, count)?,
            host_times: list("host_time_us", u64::KIND, count)?,
            intent: (concepts > 0).then(intent).transpose()?,
            of: list("contact_frame", u32::KIND, contacts)?,
            whole: WHOLE.iter().map(|(name, _)| list(name, u32::KIND, contacts)).collect::<Result<_>>()?,
            real: REAL.iter().map(|(name, _)| list(name, f64::KIND, contacts)).collect::<Result<_>>()?,
        })
    }

    fn take(&mut self, frame: &Frame) -> Result<()> {
        for (array, area) in self.panels.iter_mut().zip(frame.recorded.layout.areas()) {
            array.put(frames::panel(area, &frame.values).iter().copied())?;
        }
        self.numbers.put([frame.number])?;
        self.times.put([frame.board_us])?;
        self.host_times.put([frame.host_us])?;
        if let Some([activations, _]) = &mut self.intent {
            activations.put(frame.activations.iter().map(|activation| activation.to_f64()))?;
        }
        self.of.put(frame.contacts.iter().map(|_| frame.number))?;
        for (array, (_, value)) in self.whole.iter_mut().zip(WHOLE) {
            array.put(frame.contacts.iter().map(value))?;
        }
        for (array, (_, value)) in self.real.iter_mut().zip(REAL) {
            array.put(frame.contacts.iter().map(value))?;
        }
        Ok(())
    }

    fn finish(self, archive: &mut Archive<impl Write + Seek>) -> Result<()> {
        let Arrays { panels, numbers, times, host_times, intent, of, whole, real } = self;
        let first = panels.into_iter().chain([numbers, times, host_times]);
        let second = intent.into_iter().flatten().chain([of]).chain(whole).chain(real);
        first.chain(second).try_for_each(|array| array.finish(archive))
    }
}

/// Names of the concepts as NumPy texts: all of one length, four bytes per character.
fn names(output: &Path, recorded: &RecordedGarment) -> Result<Array> {
    let names = recorded.concepts.iter().map(|name| name.chars().map(u32::from).collect::<Vec<_>>());
    let longest = names.clone().map(|name| name.len()).max().unwrap_or(0).max(1);
    let mut array =
        Array::begin(output, "concepts", &format!("<U{longest}"), &[recorded.concepts.len() as u64])?;
    for mut name in names {
        name.resize(longest, 0);
        array.put(name)?;
    }
    Ok(array)
}
