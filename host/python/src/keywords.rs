//! The keywords of `open` that say what a board is asked.

use crate::error::argument;
use pyo3::FromPyObject;
use std::collections::BTreeMap;
use std::path::PathBuf;
use taxel::robot::{BoardConfig, GestureModel};
use taxel::source::SourceSpec;
use taxel_core::format::{Q15, name};
use taxel_core::intent::Feed;

/// The keywords, by name.
#[derive(Debug, Clone, FromPyObject)]
#[pyo3(from_item_all)]
pub struct Keywords {
    garment: Option<PathBuf>,
    scene: Option<PathBuf>,
    calibration: Option<PathBuf>,
    tare: Option<u16>,
    budget: Option<u16>,
    raw: bool,
    gestures: Option<String>,
    gesture_gain: Option<f64>,
    gesture_certainty: Option<f64>,
    forms: Option<String>,
    feed: BTreeMap<String, f64>,
    shapes: Option<PathBuf>,
    body: Option<PathBuf>,
    folds: Option<PathBuf>,
    pressing: Option<u16>,
}

impl Keywords {
    /// The board at a source. Error if the source or a keyword's value is none.
    pub fn config(self, source: &str) -> anyhow::Result<BoardConfig> {
        let source: SourceSpec = source.parse().map_err(|why| argument(format!("source {source}: {why}")))?;
        let named = |path: PathBuf| path.display().to_string();
        let gestures = match self.gestures.as_deref() {
            None => None,
            Some("gestures") => Some(GestureModel::Gestures),
            Some("intent") => Some(GestureModel::Intent),
            Some(other) => anyhow::bail!(argument(format!(
                "there is no gesture model {other}; known are gestures and intent"
            ))),
        };
        let forms = self.forms.map(|forms| forms.parse().map_err(|why| argument(format!("forms: {why}"))));
        Ok(BoardConfig {
            garment: self.garment.map(named),
            scene: self.scene,
            calibration: self.calibration,
            tare: self.tare,
            budget: self.budget,
            raw: self.raw,
            gestures,
            gesture_gain: self.gesture_gain,
            gesture_certainty: self.gesture_certainty,
            forms: forms.transpose()?,
            feed: self.feed.iter().map(|(concept, value)| feed(concept, *value)).collect::<Result<_, _>>()?,
            shapes: self.shapes,
            body: self.body.map(named),
            folds: self.folds,
            pressing: self.pressing,
            ..BoardConfig::of(source)
        })
    }
}

/// A concept's value, which counts until the next one.
fn feed(concept: &str, value: f64) -> anyhow::Result<Feed> {
    let short = name(concept);
    anyhow::ensure!(
        short == concept && !short.is_empty(),
        argument(format!("feed: {concept:?} is not a concept's name: 1 to 16 bytes"))
    );
    anyhow::ensure!(
        (-1.0..=1.0).contains(&value),
        argument(format!("feed: {concept}: {value} is not in -1 to 1"))
    );
    let value = Q15((value * f64::from(Q15::ONE.0)).round() as i32);
    Ok(Feed { concept: short, value, age_ms: 0, timeout_ms: 0, default: Q15(0) })
}
