//! Images: one of 16 bits for each frame and panel, `FOLDER/PANEL/FRAME.png`, and `FOLDER/scale.json`.
//!
//! Grey is counts times a whole number, the same in all images of a recording: the greatest that leaves room for the
//! greatest pressure in it, so that images are bright and nothing is rounded. `scale.json` and each image's comment tell it;
//! with `--counts` it is 1.

use super::frames::{self, Frames};
use crate::output::Folder;
use anyhow::{Context, Result, anyhow};
use png::{BitDepth, ColorType, Compression, Encoder};
use serde_json::json;
use std::io::Write;
use std::path::Path;
use std::sync::mpsc::sync_channel;
use taxel_core::garment::Area;

/// Images that wait for a thread at most.
const WAITING: usize = 64;
/// The file that tells what grey means.
const SCALE: &str = "scale.json";

/// Writes the images; the number of frames. It goes through the recording twice: the scale is that of the whole.
pub fn write(frames: &Frames<'_>, counts: bool, folder: &Folder) -> Result<u64> {
    let (mut greatest, mut areas) = (0, Vec::new());
    frames.each("measuring", |frame| {
        greatest = frame.values.iter().copied().fold(greatest, u16::max);
        if areas.is_empty() {
            areas = frame.worn.layout.areas().to_vec();
        }
        Ok(())
    })?;
    let factor = if counts { 1 } else { u16::MAX / greatest.max(1) };
    let panel = |area: &Area| json!({ "name": area.name, "folder": name(&area.name), "rows": area.rows, "columns": area.columns });
    let legend = json!({
        "grey_per_count": factor,
        "greatest_counts": greatest,
        "panels": areas.iter().map(panel).collect::<Vec<_>>(),
    });
    let mut file = folder.file(SCALE)?;
    writeln!(file, "{legend:#}")?;
    file.flush()?;
    let folders: Vec<String> = areas.iter().map(|area| name(&area.name)).collect();
    folders.iter().try_for_each(|name| folder.folder(name))?;
    let threads = std::thread::available_parallelism().map_or(1, usize::from).min(areas.len()).max(1);
    std::thread::scope(|scope| {
        let worker = |_| {
            let (queue, waiting) = sync_channel::<Waiting>(WAITING);
            let (areas, folders) = (&areas, &folders);
            let work = scope.spawn(move || {
                let mut image = Image { factor, grey: Vec::new(), file: Vec::new() };
                waiting.into_iter().try_for_each(|Waiting { number, panel, values }| {
                    let inside = format!("{}/{number:08}.png", folders[panel]);
                    folder.small_file(inside, image.of(&values, &areas[panel])?)
                })
            });
            (queue, work)
        };
        // A panel's images are all written by one thread: the system lets nobody else into a folder that is changed.
        let (queues, work): (Vec<_>, Vec<_>) = (0..threads).map(worker).unzip();
        let count = frames.each("exporting", |frame| {
            for (panel, area) in frame.worn.layout.areas().iter().enumerate() {
                let values = frames::panel(area, &frame.values).to_vec();
                let image = Waiting { number: frame.number, panel, values };
                queues[panel % threads].send(image).context("an image could not be written")?;
            }
            Ok(())
        });
        drop(queues);
        for work in work {
            // What a thread has to say is why nobody takes its images any more.
            work.join().map_err(|_| anyhow!("a thread has panicked"))??;
        }
        count
    })
}

/// An image that waits for a thread that writes it.
struct Waiting {
    number: u32,
    panel: usize,
    values: Vec<u16>,
}

/// Whether a file in an output folder is one of ours.
pub fn is_ours(inside: &Path) -> bool {
    inside == Path::new(SCALE) || inside.extension().is_some_and(|extension| extension == "png")
}

/// Memory that serves all images.
struct Image {
    factor: u16,
    grey: Vec<u8>,
    file: Vec<u8>,
}

impl Image {
    fn of(&mut self, values: &[u16], area: &Area) -> Result<&[u8]> {
        let Image { factor, grey, file } = self;
        grey.clear();
        grey.extend(values.iter().flat_map(|value| value.saturating_mul(*factor).to_be_bytes()));
        file.clear();
        let mut encoder = Encoder::new(&mut *file, area.columns.into(), area.rows.into());
        encoder.set_color(ColorType::Grayscale);
        encoder.set_depth(BitDepth::Sixteen);
        encoder.set_compression(Compression::Fastest);
        encoder.add_text_chunk("Comment".into(), format!("grey = {factor} x counts"))?;
        encoder.write_header()?.write_image_data(grey)?;
        Ok(file)
    }
}

/// A panel's name as that of a folder.
fn name(panel: &str) -> String {
    panel.chars().map(|c| if c.is_alphanumeric() || c == '-' { c } else { '_' }).collect()
}
