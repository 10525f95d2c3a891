//! What all events have.

use crate::value;
use pyo3::exceptions::PyAttributeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde_json::Value;

/// Something that a board has said. Its attributes are the keys of its JSON line; `to_dict()` is the line.
#[pyclass(frozen, subclass, module = "taxel")]
pub struct Event {
    line: Value,
    host_ns: u64,
}

impl Event {
    /// An event of this line, at this time of the host.
    pub fn new(line: Value, host_ns: u64) -> Event {
        Event { line, host_ns }
    }

    /// A value of the line; null if it has none of this name.
    pub fn value(&self, name: &str) -> &Value {
        self.line.get(name).unwrap_or(&Value::Null)
    }
}

#[pymethods]
impl Event {
    /// Type of the line, `frame` say.
    #[getter]
    fn r#type(&self) -> &str {
        self.value("type").as_str().unwrap_or_default()
    }

    /// Name of the board of a robot; None of a board that is opened alone, and of the whole robot.
    #[getter]
    fn board(&self) -> Option<&str> {
        self.value("board").as_str()
    }

    /// The board's time, microseconds since its start; None for events without one.
    #[getter]
    fn time_us(&self) -> Option<u64> {
        self.value("time_us").as_u64()
    }

    /// The host's time, nanoseconds since 1970: that of the event itself if the board's clock is known
    /// (`host_time_uncertainty_us` is then the bound of its error), else that of its arrival.
    #[getter]
    fn host_ns(&self) -> u64 {
        self.host_ns
    }

    /// Bound of the error of `host_ns`, microseconds; None if the board's clock is not known.
    #[getter]
    fn host_time_uncertainty_us(&self) -> Option<u64> {
        self.value("host_time_uncertainty_us").as_u64()
    }

    /// The line as a dict, as `taxel live --json` prints it.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        value::dict(py, &self.line)
    }

    /// The line as text.
    fn json(&self) -> String {
        self.line.to_string()
    }

    fn __getattr__<'py>(slf: &Bound<'py, Self>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        match slf.get().line.get(name) {
            Some(found) => value::object(slf.py(), found),
            None => Err(PyAttributeError::new_err(format!("{} has no {name}", slf.get_type().name()?))),
        }
    }

    fn __dir__(slf: &Bound<'_, Self>) -> PyResult<Vec<String>> {
        let own = slf.get_type().call_method0("mro")?.try_iter()?.map(|class| {
            class?.getattr("__dict__")?.try_iter()?.map(|name| name?.extract::<String>()).collect()
        });
        let own: Vec<Vec<String>> = own.collect::<PyResult<_>>()?;
        let keys = slf.get().line.as_object().into_iter().flatten().map(|(key, _)| key.clone());
        Ok(own.into_iter().flatten().chain(keys).collect())
    }

    fn __eq__(&self, other: &Bound<'_, PyAny>) -> bool {
        other.cast::<Event>().is_ok_and(|other| other.get().line == self.line)
    }

    fn __repr__(slf: &Bound<'_, Self>) -> PyResult<String> {
        let each = |(key, value): (&String, &Value)| match value {
            Value::Array(items) => format!("{key}=<{} items>", items.len()),
            Value::Object(items) => format!("{key}=<{} items>", items.len()),
            value => format!("{key}={value}"),
        };
        let keys = slf.get().line.as_object().into_iter().flatten().filter(|(key, _)| *key != "type");
        Ok(format!("{}({})", slf.get_type().name()?, keys.map(each).collect::<Vec<_>>().join(", ")))
    }
}
