//! Images: a 16-bit image for each frame, `FOLDER/THOUSAND/FRAME.png`, and `FOLDER/scale.json`.
//!
//! The panels are side by side in the order of the garment, at places listed in `scale.json`. Separate images
//! of panels would be four times as many files, whose number determines the time. A folder holds the images
//! of 1,000 scans: few programs can open one with 350,000.
//!
//! Grey is counts times an integer, which is the same in all images of a recording: the largest for which the
//! greatest pressure fits, so that images are bright without rounding. `scale.json` and each image's comment
//! contain it; with `--counts` it is 1.

use super::frames::{self, Frames};
use anyhow::{Context, Result, anyhow};
use png::{BitDepth, ColorType, Compression, Encoder};
use serde_json::json;
use std::io::Write;
use std::path::Path;
use std::sync::mpsc::sync_channel;
use taxel::files::output::Folder;
use taxel_core::garment::Area;

/// Scans per folder.
const THOUSAND: u32 = 1000;
/// Most images queued for a thread: while it writes to one folder, the next can be read for another.
const WAITING: usize = THOUSAND as usize;
/// Writing threads: the system admits one at a time to a folder, and a disk is not faster with more.
const THREADS: usize = 4;
/// The file with the scale of grey, and the places of the panels.
const SCALE: &str = "scale.json";

/// Writes the images. Returns the number of frames. Reads the recording twice, because the scale depends on
/// all of it.
pub fn write(frames: &Frames<'_>, counts: bool, folder: &Folder) -> Result<u64> {
    let (mut greatest, mut areas) = (0, Vec::new());
    frames.each("measuring", |frame| {
        greatest = frame.values.iter().copied().fold(greatest, u16::max);
        if areas.is_empty() {
            areas = frame.recorded.layout.areas().to_vec();
        }
        Ok(())
    })?;
    let factor = if counts { 1 } else { u16::MAX / greatest.max(1) };
    let sheet = Sheet::of(&areas);
    let mut file = folder.file(SCALE)?;
    writeln!(file, "{:#}", sheet.legend(factor, greatest))?;
    file.flush()?;
    let threads = std::thread::available_parallelism().map_or(1, usize::from).min(THREADS);
    std::thread::scope(|scope| {
        let worker = |_| {
            let (queue, waiting) = sync_channel::<(u32, Vec<u16>)>(WAITING);
            let sheet = &sheet;
            let work = scope.spawn(move || {
                let mut image = Image { factor, grey: Vec::new(), file: Vec::new() };
                let mut last = None;
                waiting.into_iter().try_for_each(|(number, values)| {
                    let place = format!("{:05}", number / THOUSAND);
                    if last.replace(number / THOUSAND) != Some(number / THOUSAND) {
                        folder.folder(&place)?;
                    }
                    let bytes = image.of(&values, sheet)?;
                    anyhow::Ok(folder.small_file(format!("{place}/{number:08}.png"), bytes)?)
                })
            });
            (queue, work)
        };
        let (queues, work): (Vec<_>, Vec<_>) = (0..threads).map(worker).unzip();
        let count = frames.each("exporting", |frame| {
            let queue = &queues[(frame.number / THOUSAND) as usize % threads];
            queue.send((frame.number, frame.values.clone())).context("an image could not be written")
        });
        drop(queues);
        for work in work {
            // The thread's error is the reason why it takes no more images.
            work.join().map_err(|_| anyhow!("a thread has panicked"))??;
        }
        count
    })
}

/// True if a file in an output folder is of such an export.
pub fn is_ours(inside: &Path) -> bool {
    inside == Path::new(SCALE) || inside.extension().is_some_and(|extension| extension == "png")
}

/// Places of the panels in an image.
struct Sheet {
    /// Each panel, and its first column.
    panels: Vec<(Area, usize)>,
    columns: usize,
    rows: usize,
}

impl Sheet {
    fn of(areas: &[Area]) -> Sheet {
        let mut columns = 0;
        let mut panel = |area: &Area| {
            let left = columns;
            columns += usize::from(area.columns);
            (area.clone(), left)
        };
        let panels = areas.iter().map(&mut panel).collect();
        Sheet { panels, columns, rows: areas.iter().map(|area| area.rows.into()).max().unwrap_or(0) }
    }

    fn legend(&self, factor: u16, greatest: u16) -> serde_json::Value {
        let panel = |(area, left): &(Area, usize)| json!({ "name": area.name, "left": left, "top": 0, "rows": area.rows, "columns": area.columns });
        json!({
            "grey_per_count": factor,
            "greatest_counts": greatest,
            "panels": self.panels.iter().map(panel).collect::<Vec<_>>(),
        })
    }
}

/// Memory reused for all images.
struct Image {
    factor: u16,
    grey: Vec<u8>,
    file: Vec<u8>,
}

impl Image {
    fn of(&mut self, values: &[u16], sheet: &Sheet) -> Result<&[u8]> {
        let Image { factor, grey, file } = self;
        grey.clear();
        grey.resize(2 * sheet.rows * sheet.columns, 0);
        for (area, left) in &sheet.panels {
            let rows = frames::panel(area, values).chunks(usize::from(area.columns).max(1));
            for (line, row) in grey.chunks_mut(2 * sheet.columns).zip(rows) {
                let places = line[2 * left..].as_chunks_mut().0;
                places.iter_mut().zip(row).for_each(|(place, value)| {
                    *place = value.saturating_mul(*factor).to_be_bytes();
                });
            }
        }
        file.clear();
        let mut encoder = Encoder::new(&mut *file, sheet.columns as u32, sheet.rows as u32);
        encoder.set_color(ColorType::Grayscale);
        encoder.set_depth(BitDepth::Sixteen);
        encoder.set_compression(Compression::Fastest);
        encoder.add_text_chunk("Comment".into(), format!("grey = {factor} x counts"))?;
        encoder.write_header()?.write_image_data(grey)?;
        Ok(file)
    }
}
