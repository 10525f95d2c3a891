//! Features of a touch, and moments of an image.

use crate::array;
use crate::error::{raised, usage};
use crate::value;
use numpy::{PyReadonlyArray2, PyReadonlyArray3, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use taxel::moments::Features;
use taxel_core::gesture::{Sheet, TouchState};

/// The 127 features of a touch, from its frames of one panel.
#[pyfunction]
#[pyo3(signature = (frames, pressed=0))]
pub fn features<'py>(
    py: Python<'py>,
    frames: PyReadonlyArray3<'_, u16>,
    pressed: u16,
) -> PyResult<Bound<'py, PyAny>> {
    let [_, rows, columns] = *frames.shape() else { return Err(usage("frames are [n, rows, columns]")) };
    let (Ok(rows), Ok(wide)) = (u16::try_from(rows), u16::try_from(columns)) else {
        return Err(usage("a sheet has at most 65535 rows and columns"));
    };
    let values = frames.as_slice().map_err(|_| usage("the frames must lie one after the other"))?;
    let found = py.detach(|| {
        let (sheet, mut state) = (Sheet::new(rows, wide), TouchState::new());
        let size = (usize::from(rows) * columns).max(1);
        values.chunks(size).for_each(|frame| state.add(&sheet.cells(frame), pressed));
        state.features()
    });
    array::frozen(py, found.to_vec())
}

/// Moments, NMI and axis of one image.
#[pyfunction]
pub fn moments<'py>(py: Python<'py>, image: PyReadonlyArray2<'_, u16>) -> PyResult<Bound<'py, PyDict>> {
    let columns = image.shape().last().copied().unwrap_or(0);
    let values = image.as_slice().map_err(|_| usage("the rows must lie one after the other"))?;
    if columns == 0 {
        return Err(usage("an image has at least one column"));
    }
    let found = py.detach(|| Features::of(values, columns)).map_err(raised)?;
    let found = serde_json::to_value(&found).map_err(raised)?;
    value::dict(py, &found)
}
