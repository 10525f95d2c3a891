//! NumPy arrays that own their buffer and that nobody can write.

use numpy::{Element, PyArray1, PyArrayDescr, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PySlice;
use std::sync::Arc;
use taxel_core::garment::{Area, Layout};

/// A read-only array of these values, without a copy.
pub fn frozen<T: Element>(py: Python<'_>, values: Vec<T>) -> PyResult<Bound<'_, PyAny>> {
    let array = PyArray1::from_vec(py, values);
    // Whether it can be written is a flag of the array; it cannot be set again, because the buffer is ours.
    drop(array.try_readwrite()?.make_nonwriteable());
    Ok(array.into_any())
}

/// A read-only array of records, whose fields this type describes, from the bytes of them all.
pub fn records<'py>(
    py: Python<'py>,
    bytes: Vec<u8>,
    dtype: &Bound<'py, PyArrayDescr>,
) -> PyResult<Bound<'py, PyAny>> {
    frozen(py, bytes)?.call_method1("view", (dtype,))
}

/// Place and size of a panel in an image of all taxels.
#[derive(Debug, Clone)]
pub struct Panel {
    /// Name of the panel.
    pub name: String,
    first: usize,
    rows: usize,
    columns: usize,
}

/// The panels of a garment.
pub type Panels = Arc<[Panel]>;

/// Panels of a garment of this layout.
pub fn panels(layout: &Layout) -> Panels {
    let panel = |area: &Area| Panel {
        name: area.name.to_string(),
        first: area.base.into(),
        rows: area.rows.into(),
        columns: area.columns.into(),
    };
    layout.areas().iter().map(panel).collect()
}

impl Panel {
    /// The panel's rows in an image of all taxels: a view, not a copy.
    pub fn of<'py>(&self, image: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let end = self.first + self.rows * self.columns;
        // `PySlice::new` never frees its numbers.
        let part = image.py().get_type::<PySlice>().call1((self.first, end))?;
        image.get_item(part)?.call_method1("reshape", (self.rows, self.columns))
    }
}
