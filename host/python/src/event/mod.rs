//! Events as Python objects. An event holds its message, the JSON object of `taxel live --json`, and what
//! belongs to it: the image of a frame, the codes of a scan. Its class is in Python, made from the message's struct.
//!
//! | file | holds |
//! |---|---|
//! | `fact.rs` | [`Fact`]: an event as it leaves the client, without Python |
//! | `base.rs` | [`Event`]: what all have |
//! | `arrays.rs` | [`Frame`], [`Contacts`], [`Raw`]: events with arrays |

mod arrays;
mod base;
mod fact;

pub use arrays::{Contacts, Frame, Raw};
pub use base::{Event, EventParts};
pub use fact::{Fact, FactReader};

use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyDict;

/// Classes of events by their types.
static CLASSES: PyOnceLock<Py<PyDict>> = PyOnceLock::new();

/// Sets the classes of events: by their types, and how a class is made of an event's parts.
#[pyfunction]
#[pyo3(name = "_set_event_classes")]
fn set_classes(py: Python<'_>, classes: Py<PyDict>) {
    // The package does this once.
    let _ = CLASSES.set(py, classes);
}

/// The Python object of an event.
pub fn object(py: Python<'_>, fact: Fact) -> PyResult<Py<PyAny>> {
    let kind = fact.line["type"].as_str().unwrap_or_default();
    let classes = CLASSES.get(py).map(|classes| classes.bind(py));
    let class = classes.map(|classes| classes.get_item(kind)).transpose()?.flatten();
    let class = class.unwrap_or_else(|| py.get_type::<Event>().into_any());
    Ok(class.call1((EventParts::new(fact),))?.unbind())
}

/// Adds the classes to the module.
pub fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<Event>()?;
    module.add_class::<Frame>()?;
    module.add_class::<Contacts>()?;
    module.add_class::<Raw>()?;
    module.add_function(wrap_pyfunction!(set_classes, module)?)
}
