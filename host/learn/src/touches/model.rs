//! Trains a model of touches.

use super::data::{Data, TouchesFile};
use super::experts::{TouchExample, Trained, train_experts};
use super::settings::TrainSettings;
use anyhow::{Context, Result, ensure};
use serde::{Deserialize, Serialize};
use std::path::Path;
use taxel::files::input;
use taxel::learn::model::{ModelHead, encode};
use taxel::text::date::today;
use taxel_core::gesture::Model;

/// Origin of a model.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Provenance {
    /// Date of the training.
    pub date: String,
    /// Training files.
    pub data: Vec<TouchesFile>,
    /// Number of training touches.
    pub touches: usize,
    /// Training settings.
    pub settings: TrainSettings,
}

impl Provenance {
    /// Reads the provenance of a model.
    pub fn of(model: &Model<'_>) -> Result<Provenance> {
        serde_json::from_slice(model.notes()).context("the notes of the model cannot be read")
    }

    /// True if one of the files is a training file.
    pub fn knows(&self, sources: &[TouchesFile]) -> bool {
        sources.iter().any(|source| self.data.iter().any(|known| known.fnv1a == source.fnv1a))
    }
}

/// Trains on touches. Returns the bytes of a model.
pub fn train(data: &Data, examples: &[TouchExample<'_>], settings: &TrainSettings) -> Result<Vec<u8>> {
    ensure!(data.classes.len() >= 2, "touches of one class only: at least two are needed");
    let experts = train_experts(examples, data.classes.len(), settings);
    let notes = Provenance {
        date: today(),
        data: data.sources.clone(),
        touches: examples.len(),
        settings: *settings,
    };
    let notes = serde_json::to_string(&notes)?;
    let TrainSettings { pressed, concludes, .. } = *settings;
    let experts: Vec<_> = experts.iter().map(Trained::expert).collect();
    Ok(encode(&experts, ModelHead { names: &data.classes, pressed, concludes, notes: &notes })?)
}

/// Reads the bytes of a model. Errors name the file.
pub fn read(path: &Path) -> Result<Vec<u8>> {
    let bytes = input::bytes(path).with_context(|| format!("{}: cannot be read", path.display()))?;
    Model::read(&bytes).with_context(|| path.display().to_string())?;
    Ok(bytes)
}
