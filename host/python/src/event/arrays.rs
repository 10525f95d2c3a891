//! Events with arrays.

use super::base::{Event, EventParts};
use super::fact::Fact;
use crate::array::{self, Panels};
use crate::contact;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyDict;
use serde_json::Value;

/// Values of all taxels: by taxel, and by panel.
struct ByTaxel {
    all: Option<Py<PyAny>>,
    panels: Panels,
}

impl ByTaxel {
    fn new(py: Python<'_>, values: Option<Vec<u16>>, panels: Panels) -> PyResult<ByTaxel> {
        let all = values.map(|values| array::frozen(py, values)).transpose()?;
        Ok(ByTaxel { all: all.map(Bound::unbind), panels })
    }

    fn all<'py>(&self, py: Python<'py>) -> Option<Bound<'py, PyAny>> {
        self.all.as_ref().map(|all| all.bind(py).clone())
    }

    fn by_panel<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let dict = PyDict::new(py);
        if let Some(all) = self.all(py) {
            self.panels.iter().try_for_each(|panel| dict.set_item(&panel.name, panel.of(&all)?))?;
        }
        Ok(dict)
    }
}

/// A conditioned image: the pressure of every taxel in counts, and what touches.
#[pyclass(frozen, subclass, extends = Event, module = "taxel")]
pub struct Frame {
    values: ByTaxel,
    contacts: PyOnceLock<Py<PyAny>>,
}

#[pymethods]
impl Frame {
    #[new]
    fn new(py: Python<'_>, parts: &EventParts) -> PyResult<PyClassInitializer<Frame>> {
        let Fact { line, host_ns, values, panels } = parts.take()?;
        let frame = Frame { values: ByTaxel::new(py, values, panels)?, contacts: PyOnceLock::new() };
        Ok(PyClassInitializer::from(Event::of(line, host_ns)).add_subclass(frame))
    }

    /// Pressure by taxel number: read-only `uint16`, never changed once it is there; None if the image could
    /// not be decoded.
    #[getter]
    fn image<'py>(&self, py: Python<'py>) -> Option<Bound<'py, PyAny>> {
        self.values.all(py)
    }

    /// The image by panel: views of (rows, columns) by the panel's name.
    #[getter]
    fn panels<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        self.values.by_panel(py)
    }

    /// Present contacts, of dtype `taxel.CONTACT`.
    #[getter]
    fn contacts<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        let list = slf.as_super().get().value("contacts");
        listed(slf.py(), &slf.get().contacts, list)
    }

    /// Ids of the contacts that ended with this frame.
    #[getter]
    fn released(slf: &Bound<'_, Self>) -> Vec<u64> {
        let ids = slf.as_super().get().value("released").as_array();
        ids.into_iter().flatten().filter_map(Value::as_u64).collect()
    }
}

/// Raw codes of a scan.
#[pyclass(frozen, subclass, extends = Event, module = "taxel")]
pub struct Raw {
    values: ByTaxel,
}

#[pymethods]
impl Raw {
    #[new]
    fn new(py: Python<'_>, parts: &EventParts) -> PyResult<PyClassInitializer<Raw>> {
        let Fact { line, host_ns, values, panels } = parts.take()?;
        let raw = Raw { values: ByTaxel::new(py, values, panels)? };
        Ok(PyClassInitializer::from(Event::of(line, host_ns)).add_subclass(raw))
    }

    /// Codes of the converter by taxel number: read-only `uint16`; None if they could not be decoded.
    #[getter]
    fn codes<'py>(&self, py: Python<'py>) -> Option<Bound<'py, PyAny>> {
        self.values.all(py)
    }

    /// The codes by panel: views of (rows, columns) by the panel's name.
    #[getter]
    fn panels<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        self.values.by_panel(py)
    }
}

/// Contacts of a frame.
#[pyclass(frozen, subclass, extends = Event, module = "taxel")]
pub struct Contacts {
    contacts: PyOnceLock<Py<PyAny>>,
    released: PyOnceLock<Py<PyAny>>,
}

#[pymethods]
impl Contacts {
    #[new]
    fn new(parts: &EventParts) -> PyResult<PyClassInitializer<Contacts>> {
        let Fact { line, host_ns, .. } = parts.take()?;
        let contacts = Contacts { contacts: PyOnceLock::new(), released: PyOnceLock::new() };
        Ok(PyClassInitializer::from(Event::of(line, host_ns)).add_subclass(contacts))
    }

    /// Present contacts, of dtype `taxel.CONTACT`.
    #[getter]
    fn contacts<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        listed(slf.py(), &slf.get().contacts, slf.as_super().get().value("contacts"))
    }

    /// Contacts that have ended since the last list, with their last values.
    #[getter]
    fn released<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        listed(slf.py(), &slf.get().released, slf.as_super().get().value("released"))
    }
}

/// The array of a list of contacts, made once.
fn listed<'py>(py: Python<'py>, made: &PyOnceLock<Py<PyAny>>, list: &Value) -> PyResult<Bound<'py, PyAny>> {
    let array = made.get_or_try_init(py, || contact::contacts(py, list).map(Bound::unbind))?;
    Ok(array.bind(py).clone())
}
