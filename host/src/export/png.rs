//! Images: one of 16 bits for each frame and panel, whose grey is the pressure in counts.

use super::frames::{self, Frames};
use anyhow::{Context, Result};
use png::{BitDepth, ColorType, Encoder};
use std::fs::{self, File};
use std::io::BufWriter;
use std::path::Path;

/// Writes `FOLDER/PANEL/FRAME.png`; the number of frames.
pub fn write(frames: &Frames<'_>, folder: &Path) -> Result<u64> {
    frames.each(|frame| {
        for area in frame.worn.layout.areas() {
            let folder = folder.join(name(&area.name));
            fs::create_dir_all(&folder).with_context(|| format!("{} cannot be made", folder.display()))?;
            let path = folder.join(format!("{:08}.png", frame.number));
            let file =
                File::create(&path).with_context(|| format!("{} cannot be written", path.display()))?;
            let mut encoder = Encoder::new(BufWriter::new(file), area.columns.into(), area.rows.into());
            encoder.set_color(ColorType::Grayscale);
            encoder.set_depth(BitDepth::Sixteen);
            let grey = frames::panel(area, &frame.values).iter().flat_map(|value| value.to_be_bytes());
            encoder.write_header()?.write_image_data(&grey.collect::<Vec<u8>>())?;
        }
        Ok(())
    })
}

/// A panel's name as that of a folder.
fn name(panel: &str) -> String {
    panel.chars().map(|c| if c.is_alphanumeric() || c == '-' { c } else { '_' }).collect()
}
