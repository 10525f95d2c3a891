//! Models of touches over time: made of planes that a program has fitted, saved, and judged.

use crate::array;
use crate::error::{raised, usage};
use numpy::{PyReadonlyArray1, PyReadonlyArray2, PyReadonlyArray3, PyUntypedArrayMethods};
use pyo3::prelude::*;
use std::path::PathBuf;
use taxel::files::input;
use taxel::files::output::{Force, Output};
use taxel::learn::model::{LinearExpert, ModelHead, encode};
use taxel_core::format::{Name, Q15};
use taxel_core::gesture::{CLASSES, FEATURES, Model, ShippedModel, TouchClassifier, TouchState};

/// A score of 1.
const ONE: f64 = 262_144.0;

/// A model of touches in the arithmetic of the board.
#[pyclass(frozen, module = "taxel")]
pub struct TouchModel {
    bytes: Vec<u8>,
}

/// Decision of a model about a touch.
#[pyclass(frozen, get_all, module = "taxel")]
pub struct TouchDecision {
    /// Name of the class with the greatest score.
    name: String,
    /// Share of such touches that are classified correctly, 0 to 1; None if the model does not know.
    confidence: Option<f64>,
    /// Score of each class, in the order of the model's classes.
    scores: Py<PyAny>,
}

#[pymethods]
impl TouchDecision {
    fn __repr__(&self) -> String {
        let sure = self.confidence.map_or(String::new(), |share| format!(", confidence={share:.2}"));
        format!("TouchDecision(name={:?}{sure})", self.name)
    }
}

impl TouchModel {
    /// Checks the bytes.
    fn of(bytes: Vec<u8>, what: &str) -> PyResult<TouchModel> {
        Model::read(&bytes).map_err(|error| raised(anyhow::anyhow!("{what}: {error}")))?;
        Ok(TouchModel { bytes })
    }

    fn model(&self) -> Model<'_> {
        Model::read(&self.bytes).expect("its bytes were checked")
    }
}

#[pymethods]
impl TouchModel {
    /// A model of one plane for each class over the standardised features.
    #[staticmethod]
    #[pyo3(signature = (classes, *, mean, scale, weights, offsets, pressed=0, notes="{}"))]
    fn linear(
        classes: Vec<String>,
        mean: PyReadonlyArray1<'_, f64>,
        scale: PyReadonlyArray1<'_, f64>,
        weights: PyReadonlyArray2<'_, f64>,
        offsets: PyReadonlyArray1<'_, f64>,
        pressed: u16,
        notes: &str,
    ) -> PyResult<TouchModel> {
        let shapes = [mean.shape(), scale.shape(), weights.shape(), offsets.shape()];
        let count = classes.len();
        if shapes != [&[FEATURES][..], &[FEATURES], &[count, FEATURES], &[count]] {
            return Err(usage(format!(
                "mean, scale, weights and offsets have the shapes {shapes:?}: {count} classes need \
                 ({FEATURES},), ({FEATURES},), ({count}, {FEATURES}) and ({count},)"
            )));
        }
        let (mean, scale) = (mean.as_array().to_vec(), scale.as_array().to_vec());
        let weights: Vec<Vec<f64>> = weights.as_array().outer_iter().map(|row| row.to_vec()).collect();
        let offsets = offsets.as_array().to_vec();
        let all = mean.iter().chain(&scale).chain(weights.iter().flatten()).chain(&offsets);
        if !all.clone().all(|number| number.is_finite()) || scale.iter().any(|scale| *scale <= 0.0) {
            return Err(usage("mean, scale, weights and offsets are finite, and scale is above 0"));
        }
        let expert = LinearExpert {
            from: 0,
            middle: &mean,
            deviation: &scale,
            weights: &weights,
            offsets: &offsets,
            confidence: &[],
        };
        let head = ModelHead { names: &classes, pressed, concludes: true, notes };
        Ok(TouchModel { bytes: encode(&[expert], head).map_err(raised)? })
    }

    /// Loads a model of the firmware, or a file.
    #[staticmethod]
    fn load(model: PathBuf) -> PyResult<TouchModel> {
        let bytes = match model.to_str() {
            Some("gestures") => ShippedModel::Gestures.bytes().to_vec(),
            Some("intent") => ShippedModel::Intent.bytes().to_vec(),
            _ => input::bytes(&model).map_err(raised)?,
        };
        TouchModel::of(bytes, &model.display().to_string())
    }

    /// Saves the model as a file.
    #[pyo3(signature = (path, overwrite=false))]
    fn save(&self, path: PathBuf, overwrite: bool) -> PyResult<()> {
        let inputs: [&PathBuf; 0] = [];
        let output = Output::file(&path, Force { force: overwrite }, inputs).map_err(raised)?;
        output.write(&self.bytes).map_err(raised)
    }

    /// Names of the classes.
    #[getter]
    fn classes(&self) -> Vec<String> {
        let model = self.model();
        (0..model.classes()).filter_map(|class| model.name(class)).map(|name| name.to_string()).collect()
    }

    /// Cells above this count as touched.
    #[getter]
    fn pressed(&self) -> u16 {
        self.model().pressed()
    }

    /// Classifies a whole touch.
    fn decide(&self, py: Python<'_>, frames: PyReadonlyArray3<'_, u16>) -> PyResult<TouchDecision> {
        let [_, rows, columns] = *frames.shape() else { return Err(usage("frames are [n, rows, columns]")) };
        let (Ok(tall), Ok(wide)) = (u16::try_from(rows), u16::try_from(columns)) else {
            return Err(usage("a sheet has at most 65535 rows and columns"));
        };
        let values = frames.as_slice().map_err(|_| usage("the frames must lie one after the other"))?;
        let model = self.model();
        let decision = py.detach(|| {
            let (classifier, mut state) = (TouchClassifier::new(model, tall, wide), TouchState::default());
            values.chunks((rows * columns).max(1)).for_each(|frame| classifier.process(&mut state, frame));
            classifier.conclude(&state)
        });
        let scores = decision.scores.iter().take(model.classes().min(CLASSES));
        let scores: Vec<f64> = scores.map(|score| f64::from(*score) / ONE).collect();
        Ok(TouchDecision {
            name: model.name(decision.class).map_or_else(String::new, |name: Name| name.to_string()),
            confidence: decision.confidence.map(Q15::to_f64),
            scores: array::frozen(py, scores)?.unbind(),
        })
    }

    fn __repr__(&self) -> String {
        format!("TouchModel(classes={:?}, {} bytes)", self.classes(), self.bytes.len())
    }
}
