//! Features of a data set: the contents of a row.

use super::parquet::{Column, ColumnType};
use crate::commands::recordings::export::frames::{self, Frame, RecordedGarment};
use anyhow::{Result, ensure};
use serde_json::{Value, json};
use taxel_core::garment::Area;

/// LeRobot's own features, each one number per row, and whether it is an integer.
pub const OWN: [(&str, bool); 5] = [
    ("timestamp", false),
    ("frame_index", true),
    ("episode_index", true),
    ("index", true),
    ("task_index", true),
];

/// Features of touch: panels, then the intention.
#[derive(Debug, Clone, PartialEq)]
pub struct Features {
    areas: Vec<Area>,
    units: Vec<&'static str>,
    concepts: Vec<String>,
    simulated: bool,
}

impl Features {
    /// Features of a garment with its scene. Error if two panels' features would have the same name.
    pub fn of(worn: &RecordedGarment) -> Result<Features> {
        let areas = worn.layout.areas().to_vec();
        let units = (0..areas.len()).map(|panel| worn.units.name(panel)).collect();
        let concepts = worn.concepts.iter().map(ToString::to_string).collect();
        let features = Features { areas, units, concepts, simulated: worn.simulated };
        let mut names: Vec<_> = features.shapes().into_iter().map(|(name, _)| name).collect();
        names.sort();
        ensure!(names.is_sorted_by(|a, b| a != b), "two panels have names that LeRobot cannot tell apart");
        Ok(features)
    }

    /// Name and shape of each feature.
    pub fn shapes(&self) -> Vec<(String, Vec<usize>)> {
        let panel = |area: &Area| {
            let shape = [area.rows, area.columns].map(usize::from).to_vec();
            (format!("observation.tactile.{}", word(&area.name)), shape)
        };
        let mut all: Vec<_> = self.areas.iter().map(panel).collect();
        if !self.concepts.is_empty() {
            all.push(("observation.tactile.intent".into(), vec![self.concepts.len()]));
        }
        all
    }

    /// Columns of a file, with LeRobot's own at the end.
    pub fn columns(&self) -> Vec<Column> {
        let ours =
            self.shapes().into_iter().map(|(name, shape)| Column { name, kind: ColumnType::Floats(shape) });
        let own = OWN.map(|(name, whole)| {
            let kind = if whole { ColumnType::Whole } else { ColumnType::Floats(vec![1]) };
            Column { name: name.into(), kind }
        });
        ours.chain(own).collect()
    }

    /// Values of each feature in a frame.
    pub fn values(&self, frame: &Frame) -> Vec<Vec<f32>> {
        let units = &frame.worn.units;
        let panel = |(panel, area): (usize, &Area)| {
            let counts = frames::panel(area, &frame.values).iter();
            counts.map(|counts| units.value(panel, *counts) as f32).collect()
        };
        let mut all: Vec<Vec<f32>> = self.areas.iter().enumerate().map(panel).collect();
        if !self.concepts.is_empty() {
            all.push(frame.activations.iter().map(|activation| activation.to_f64() as f32).collect());
        }
        all
    }

    /// Descriptions for `info.json`.
    pub fn described(&self) -> Value {
        let mut all = serde_json::Map::new();
        for (index, (name, shape)) in self.shapes().into_iter().enumerate() {
            let mut feature = json!({ "dtype": "float32", "shape": shape, "names": self.concepts });
            if let (Some(area), Some(unit)) = (self.areas.get(index), self.units.get(index)) {
                let pitch = area.pitch_um.map(|um| f64::from(um) / 1000.0);
                feature["names"] = json!(["row", "column"]);
                feature["info"] = json!({
                    "unit": unit, "link": area.link, "pitch_mm": pitch, "simulated": self.simulated,
                });
            }
            all.insert(name, feature);
        }
        for (name, whole) in OWN {
            let kind = if whole { "int64" } else { "float32" };
            all.insert(name.into(), json!({ "dtype": kind, "shape": [1], "names": null }));
        }
        Value::Object(all)
    }
}

/// A name as part of a feature's name.
fn word(name: &str) -> String {
    name.chars().map(|c| if c.is_alphanumeric() { c } else { '_' }).collect()
}
