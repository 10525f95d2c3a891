//! Writes one recording as one file of rows.

use super::features::Features;
use super::parquet::{Table, Values};
use super::sampler::Sampler;
use super::stats;
use crate::commands::recordings::export::frames::Frame;
use anyhow::{Result, ensure};
use std::num::NonZeroU16;
use taxel::files::output::Folder;

/// Rows written at once.
const ROWS: usize = 256;

/// An episode being written.
pub struct Episode<'a> {
    folder: &'a Folder,
    path: String,
    number: u64,
    /// First row in the data set.
    first: u64,
    fps: f64,
    sampler: Sampler,
    open: Option<EpisodeState>,
    length: u64,
}

/// State from the first image on.
struct EpisodeState {
    table: Table,
    names: Vec<String>,
    /// Values of each feature of the last image, and its time.
    last: (Vec<Vec<f32>>, u64),
    waiting: Vec<Values>,
    rows: usize,
}

impl Episode<'_> {
    /// Begins an episode with its number and its first row in the data set.
    pub fn begin(folder: &Folder, path: String, [number, first]: [u64; 2], fps: NonZeroU16) -> Episode<'_> {
        let sampler = Sampler::new(fps);
        Episode { folder, path, number, first, fps: fps.get().into(), sampler, open: None, length: 0 }
    }

    /// Handles an image. All recordings must have the `known` features.
    pub fn take(
        &mut self,
        frame: &Frame,
        known: &mut Option<Features>,
        stats: &mut stats::Statistics,
    ) -> Result<()> {
        let rows = self.sampler.passed(frame.board_us, false);
        self.put(rows, stats)?;
        if self.open.is_none() {
            let features = Features::of(&frame.worn)?;
            let first = known.get_or_insert_with(|| features.clone());
            ensure!(
                *first == features,
                "its garment, units or concepts differ from those of the first recording"
            );
            let columns = features.columns();
            self.open = Some(EpisodeState {
                names: columns.iter().map(|column| column.name.clone()).collect(),
                waiting: columns.iter().map(|column| column.kind.none()).collect(),
                table: Table::create(self.folder, &self.path, columns, None)?,
                last: (Vec::new(), 0),
                rows: 0,
            });
        }
        if let (Some(open), Some(features)) = (&mut self.open, known) {
            open.last = (features.values(frame), frame.board_us);
        }
        Ok(())
    }

    /// Writes the last image to these rows.
    fn put(&mut self, rows: std::ops::Range<u64>, stats: &mut stats::Statistics) -> Result<()> {
        let Some(open) = &mut self.open else { return Ok(()) };
        for row in rows {
            let time = (row as f64 / self.fps) as f32;
            // In the order of the columns; there is one task.
            let own = [row, self.number, self.first + row, 0];
            let own = own.map(|number| Values::Whole(vec![number as i64]));
            let features = open.last.0.iter().cloned().chain([vec![time]]).map(Values::Floats);
            for ((name, waiting), values) in open.names.iter().zip(&mut open.waiting).zip(features.chain(own))
            {
                stats.take(name, values.numbers());
                waiting.append(values);
            }
            self.length += 1;
            open.rows += 1;
            if open.rows == ROWS {
                open.flush()?;
            }
        }
        Ok(())
    }

    /// Writes the rest. Returns the number of rows, and of leaps in time.
    pub fn finish(mut self, stats: &mut stats::Statistics) -> Result<[u64; 2]> {
        let end = self.open.as_ref().map_or(0, |open| open.last.1);
        let rows = self.sampler.passed(end, true);
        self.put(rows, stats)?;
        if let Some(mut open) = self.open {
            open.flush()?;
            open.table.finish()?;
        }
        Ok([self.length, self.sampler.leaps()])
    }
}

impl EpisodeState {
    fn flush(&mut self) -> Result<()> {
        if self.rows > 0 {
            self.table.rows(&self.waiting)?;
            self.waiting.iter_mut().for_each(Values::clear);
            self.rows = 0;
        }
        Ok(())
    }
}
