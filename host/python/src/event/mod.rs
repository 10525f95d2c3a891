//! Events as Python objects. An event holds its line, the JSON object of `taxel live --json`, and what
//! belongs to it: the image of a frame, the codes of a scan. Its attributes are the line's keys.
//!
//! | file | holds |
//! |---|---|
//! | `fact.rs` | [`Fact`]: an event as it leaves the client, without Python |
//! | `base.rs` | [`Event`]: the attributes that all have |
//! | `arrays.rs` | [`Frame`], [`Contacts`], [`Raw`]: events with arrays |
//! | `plain.rs` | all others, of one line each |

mod arrays;
mod base;
mod fact;
mod plain;

pub use arrays::{Contacts, Frame, Raw};
pub use base::Event;
pub use fact::{Fact, FactReader};

use pyo3::prelude::*;

/// The Python object of an event.
pub fn object(py: Python<'_>, fact: Fact) -> PyResult<Py<PyAny>> {
    let Fact { line, host_ns, values, panels } = fact;
    let kind = line["type"].as_str().unwrap_or_default().to_string();
    let event = Event::new(line, host_ns);
    match kind.as_str() {
        "frame" => Frame::object(py, event, values, panels),
        "raw" => Raw::object(py, event, values, panels),
        "contacts" => Contacts::object(py, event),
        kind => plain::object(py, kind, event),
    }
}

/// Adds the classes to the module.
pub fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<Event>()?;
    module.add_class::<Frame>()?;
    module.add_class::<Contacts>()?;
    module.add_class::<Raw>()?;
    plain::add(module)
}
