//! The images of a recording, with what belongs to each.

use crate::client::{Client, Event, ImageNews};
use crate::record::Play;
use anyhow::{Result, bail};
use std::num::NonZeroU64;
use std::path::Path;
use taxel_core::garment::{Area, Layout};

/// Which images of which recording.
#[derive(Debug, Clone, Copy)]
pub struct Frames<'a> {
    file: &'a Path,
    every: NonZeroU64,
}

/// One image.
#[derive(Debug)]
pub struct Frame<'a> {
    /// Number of the scan.
    pub number: u32,
    /// Start of the scan, the board's time, us.
    pub board_us: u64,
    /// The host's time of it, us since 1970.
    pub host_us: u64,
    /// What is known after it.
    pub client: &'a Client,
    /// The garment's geometry.
    pub layout: &'a Layout,
    /// Pressure by taxel number, counts.
    pub values: &'a [u16],
}

impl<'a> Frames<'a> {
    /// Each N-th image of a file.
    pub fn new(file: &'a Path, every: NonZeroU64) -> Frames<'a> {
        Frames { file, every }
    }

    /// Goes through them; their number. A garment that is changed on the way is refused: the forms have one.
    pub fn each(&self, mut take: impl FnMut(&Frame<'_>) -> Result<()>) -> Result<u64> {
        let mut play = Play::open(self.file)?;
        let (mut seen, mut count) = (0u64, 0);
        let mut known: Option<Layout> = None;
        while let Some((header, event)) = play.next_event()? {
            let Event::Frame { frame, time, image: ImageNews::Whole, .. } = event else { continue };
            let client = play.client();
            let (Some(layout), Some((_, values))) = (client.layout(), client.image()) else { continue };
            if known.get_or_insert_with(|| layout.clone()) != layout {
                bail!("the garment changes at frame {frame}");
            }
            seen += 1;
            if (seen - 1) % self.every != 0 {
                continue;
            }
            count += 1;
            let host_us = header.log_time / 1000;
            take(&Frame { number: frame, board_us: time.0, host_us, client, layout, values })?;
        }
        if count == 0 {
            bail!("{} holds no image", self.file.display());
        }
        Ok(count)
    }
}

/// The values of a panel, row by row.
pub fn panel<'v>(area: &Area, values: &'v [u16]) -> &'v [u16] {
    let start = usize::from(area.base);
    values.get(start..start + usize::from(area.rows) * usize::from(area.columns)).unwrap_or(&[])
}
