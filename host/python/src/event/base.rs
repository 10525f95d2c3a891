//! Base of all events.

use super::fact::Fact;
use crate::error::{argument, raised};
use crate::value;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde_json::Value;
use std::sync::{Mutex, PoisonError};

/// Parts of which an event is made, once.
#[pyclass(frozen, module = "taxel")]
pub struct EventParts(Mutex<Option<Fact>>);

impl EventParts {
    /// Makes the parts of an event.
    pub fn new(fact: Fact) -> EventParts {
        EventParts(Mutex::new(Some(fact)))
    }

    /// Takes them. Error if they were taken before.
    pub fn take(&self) -> PyResult<Fact> {
        let fact = self.0.lock().unwrap_or_else(PoisonError::into_inner).take();
        fact.ok_or_else(|| raised(argument("only a board makes events")))
    }
}

/// Something that a board has said. Its attributes are the keys of its message, `to_dict()` is the message.
#[pyclass(frozen, subclass, module = "taxel")]
pub struct Event {
    line: Value,
    host_ns: u64,
}

impl Event {
    /// An event of this message, at this time of the host, ns.
    pub fn of(line: Value, host_ns: u64) -> Event {
        Event { line, host_ns }
    }

    /// A value of the line; null if it has none of this name.
    pub fn value(&self, name: &str) -> &Value {
        self.line.get(name).unwrap_or(&Value::Null)
    }
}

#[pymethods]
impl Event {
    #[new]
    fn new(parts: &EventParts) -> PyResult<Event> {
        let Fact { line, host_ns, .. } = parts.take()?;
        Ok(Event { line, host_ns })
    }

    /// A value of the message; None if it has none of this name.
    #[pyo3(name = "_value")]
    fn python_value<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        value::object(py, self.value(name))
    }

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
