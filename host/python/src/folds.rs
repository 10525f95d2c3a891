//! Pressure of the garment's folds: learned, and as a board expects it.

use crate::error::{raised, usage};
use crate::value;
use numpy::{PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use serde_json::json;
use taxel::files::garments;
use taxel::learn::folds::{FoldSettings, FoldSweep, LearnedFold, learn};
use taxel_core::capacity::TAXELS;
use taxel_core::garment::Layout;

/// A day's sweep: names of joints, their angles [n, joints] in degrees, pressures [n, taxels] in counts.
type Swept<'py> = (Vec<String>, PyReadonlyArray2<'py, f32>, PyReadonlyArray2<'py, u16>);

/// The table of folds for a board, and what is reported of each.
#[pyfunction]
pub fn learn_folds<'py>(
    py: Python<'py>,
    garment: &str,
    sweeps: Vec<Swept<'py>>,
    folds: Vec<Vec<String>>,
    step_deg: f32,
    shift_mm: f32,
    shift_deg: f32,
) -> PyResult<(Bound<'py, PyBytes>, Vec<Bound<'py, PyDict>>)> {
    if !(step_deg.is_finite() && (0.5..=90.0).contains(&step_deg)) {
        return Err(usage("step_deg must be 0.5 to 90"));
    }
    if !(shift_mm.is_finite() && (0.0..=100.0).contains(&shift_mm)) {
        return Err(usage("shift_mm must be 0 to 100"));
    }
    if !(shift_deg.is_finite() && (0.0..=90.0).contains(&shift_deg)) {
        return Err(usage("shift_deg must be 0 to 90"));
    }
    let garment = garments::load(garment).map_err(raised)?;
    let layout = Layout::build(&garment, TAXELS, u16::MAX).map_err(raised)?;
    let mut read = Vec::new();
    for (joints, angles, felt) in &sweeps {
        let (&[frames, reported], &[scans, taxels]) = (angles.shape(), felt.shape()) else {
            return Err(usage("a sweep has angles [n, joints] and pressures [n, taxels]"));
        };
        if frames != scans || reported != joints.len() || joints.is_empty() {
            return Err(usage("a sweep has angles [n, joints] and pressures [n, taxels]"));
        }
        let (angles, felt) = (angles.as_slice(), felt.as_slice());
        let (Ok(angles), Ok(felt)) = (angles, felt) else {
            return Err(usage("the frames must lie one after the other"));
        };
        let mut sweep = FoldSweep::new(joints.clone(), taxels);
        for (angles, felt) in angles.chunks(reported).zip(felt.chunks(taxels.max(1))) {
            sweep.push(angles, felt).map_err(raised)?;
        }
        read.push(sweep);
    }
    let settings = FoldSettings { folds, step_deg, shift_mm, shift_deg };
    let learned = py.detach(|| learn(&layout, &read, &settings)).map_err(raised)?;
    let reported = learned.folds.iter().map(|fold| value::dict(py, &about(fold))).collect::<PyResult<_>>()?;
    Ok((PyBytes::new(py, &learned.table), reported))
}

fn about(fold: &LearnedFold) -> serde_json::Value {
    let [pressed, beside] = fold.taxels;
    let [flash, ram] = fold.bytes;
    json!({
        "joints": fold.joints, "pressed": pressed, "beside": beside, "knots": fold.knots,
        "step_deg": fold.step_deg, "play_deg": fold.play_deg, "strongest": fold.strongest,
        "explained": fold.explained, "flash_bytes": flash, "ram_bytes": ram,
    })
}
