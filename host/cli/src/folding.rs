//! Folds of the garment, for what shows them: a table of folds, and the angles that a board was sent.

use anyhow::Result;
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use taxel::client::{BoardDescription, Client};
use taxel::files::folds;
#[cfg(feature = "schema")]
use taxel::json::schema::TypeIs;
use taxel::learn::folds::expected;
use taxel::record::Angles;
use taxel::recording::BoardRecording;
use taxel_core::fold::{FoldTable, STALE_US};
use taxel_core::wire::{self, Request};

/// Folds of the garment at its posture. The docs of the fields are the descriptions in `view/page/messages.d.ts`.
#[derive(Debug, Default, Clone, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = TypeIs("folding")))]
#[serde(tag = "type", rename = "folding")]
pub struct FoldingLine {
    /// True if the posture is known.
    pub followed: bool,
    /// Taxels on which the folds press at this posture, as they were learned; if it is not known, all on which
    /// they may.
    pub taxels: Vec<u16>,
}

/// A table of folds, and the posture.
#[derive(Debug)]
pub struct Folding {
    file: PathBuf,
    table: Vec<u8>,
    /// Counts from which on a taxel shows pressure; none before a garment is known that the table fits.
    floor: Option<u16>,
    posture: SentPosture,
    /// The line that was handed over last.
    line: Option<FoldingLine>,
}

/// The angles that a board was sent, degrees.
#[derive(Debug)]
enum SentPosture {
    /// By joint, and when the last one was sent.
    Live(BTreeMap<String, f32>, Option<u64>),
    /// All of a recording.
    Recorded(Angles),
}

impl Folding {
    /// Reads a table, for a board that is sent its posture from now on.
    pub fn read(file: &Path) -> Result<Folding> {
        let posture = SentPosture::Live(BTreeMap::new(), None);
        Ok(Folding { file: file.into(), table: folds::read(file)?, floor: None, posture, line: None })
    }

    /// Reads a table for a recording. Error if no angles are in it.
    pub fn recorded(file: &Path, recording: &BoardRecording) -> Result<Folding> {
        let angles = Angles::read(recording)?;
        Ok(Folding { posture: SentPosture::Recorded(angles), ..Folding::read(file)? })
    }

    /// The board has this garment. The error says that the table is not for it.
    pub fn use_garment(&mut self, description: &BoardDescription) -> Result<()> {
        self.floor = None;
        folds::check(&self.file, &self.table, &description.layout)?;
        self.floor = Some(description.scene.condition.floor.max(1));
        Ok(())
    }

    /// Takes postures among requests to the board.
    pub fn asked(&mut self, client: &Client, requests: &[u8]) {
        let (SentPosture::Live(angles, sent_us), Some(description)) =
            (&mut self.posture, client.description())
        else {
            return;
        };
        for frame in requests.split(|byte| *byte == 0) {
            let mut frame = frame.to_vec();
            let Ok(Request::Posture(posture)) = wire::open(&mut frame).and_then(wire::decode) else {
                continue;
            };
            for sent in &posture.joints {
                if let Some(joint) = description.scene.joints.get(usize::from(sent.joint)) {
                    angles.insert(joint.to_string(), f32::from(sent.centidegrees) / 100.0);
                }
            }
            *sent_us = client.board_time().map(|time| time.0);
        }
    }

    /// Returns where the garment folds at a time of the board, us; none if that is known already, or no garment is.
    pub fn news(&mut self, time_us: u64) -> Option<&FoldingLine> {
        let line = self.at(time_us)?;
        if self.line.as_ref() == Some(&line) {
            return None;
        }
        Some(self.line.insert(line))
    }

    /// Returns where the garment folds at a time of the board, us; none before a garment is known.
    pub fn at(&self, time_us: u64) -> Option<FoldingLine> {
        let (floor, table) = (self.floor?, FoldTable::view(&self.table)?);
        let of_recording;
        let (angles, sent_us) = match &self.posture {
            SentPosture::Live(angles, sent_us) => (angles, *sent_us),
            SentPosture::Recorded(all) => {
                of_recording = all.at(time_us);
                (&of_recording.0, of_recording.1)
            }
        };
        let followed = sent_us.is_some_and(|sent| time_us.saturating_sub(sent) < STALE_US);
        let all = expected(&table, |joint| angles.get(joint).copied().filter(|_| followed));
        let presses = |counts: Option<f32>| counts.is_none_or(|counts| counts >= f32::from(floor));
        let taxels = all.into_iter().filter(|(_, counts)| presses(*counts)).map(|(taxel, _)| taxel).collect();
        Some(FoldingLine { followed, taxels })
    }
}
