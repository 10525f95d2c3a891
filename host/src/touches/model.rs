//! Training a model of touches.

use super::data::{Data, Source};
use super::experts::{Example, train_experts};
use super::export::{Head, export};
use super::windows::Windows;
use crate::date::today;
use anyhow::{Context, Result, ensure};
use serde::{Deserialize, Serialize};
use std::path::Path;
use taxel_core::gesture::{EXPERTS, Model};

/// Most experts beside the one that learns from whole touches.
pub const EARLY: usize = EXPERTS - 1;

/// How a model is trained; a task's own, chosen by cross-validation.
#[derive(Debug, Default, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Settings {
    /// A cell above this counts as touched.
    pub pressed: u16,
    /// Also train on each half of a touch.
    pub halves: bool,
    /// Draws weights towards 0.
    pub penalty: f64,
    /// 1: every class counts alike, 0: every example.
    pub balance: f64,
    /// Whether is learnt from the mirror images of a touch, too.
    pub mirrored: bool,
    /// What the experts for early touches learn from, by age.
    #[serde(default)]
    pub early: [Option<Windows>; EARLY],
    /// What is learnt from are touches from their beginning to their end, so that the last expert tells what a
    /// touch was, however short; else they are cut, and the expert of its age does.
    #[serde(default)]
    pub concludes: bool,
}

/// What a model says of itself.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Provenance {
    /// Day of the training.
    pub date: String,
    /// The files it was trained on.
    pub data: Vec<Source>,
    /// Touches it was trained on.
    pub touches: usize,
    /// How it was trained.
    pub settings: Settings,
}

impl Provenance {
    /// Of a model.
    pub fn of(model: &Model<'_>) -> Result<Provenance> {
        serde_json::from_slice(model.notes()).context("the notes of the model cannot be read")
    }

    /// Whether one of the files is one it was trained on.
    pub fn knows(&self, sources: &[Source]) -> bool {
        sources.iter().any(|source| self.data.iter().any(|known| known.fnv1a == source.fnv1a))
    }
}

/// Trains on touches; the bytes of a model.
pub fn train(data: &Data, examples: &[Example<'_>], settings: &Settings) -> Result<Vec<u8>> {
    ensure!(data.classes.len() >= 2, "touches of one class only: nothing can be told apart");
    let experts = train_experts(examples, data.classes.len(), settings);
    let notes = Provenance {
        date: today(),
        data: data.sources.clone(),
        touches: examples.len(),
        settings: *settings,
    };
    let notes = serde_json::to_string(&notes)?;
    let Settings { pressed, concludes, .. } = *settings;
    export(&experts, Head { names: &data.classes, pressed, concludes, notes: &notes })
}

/// Reads the bytes of a model; the error names the file.
pub fn read(path: &Path) -> Result<Vec<u8>> {
    crate::verbose::reads(path);
    let bytes = std::fs::read(path).with_context(|| format!("{}: cannot be read", path.display()))?;
    Model::read(&bytes).with_context(|| path.display().to_string())?;
    Ok(bytes)
}
