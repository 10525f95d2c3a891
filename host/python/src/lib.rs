//! `taxel._taxel`: what the Python package `taxel` takes from Rust.
//!
//! | file | holds |
//! |---|---|
//! | `error.rs` | errors as exceptions |
//! | `value.rs` | JSON values as Python objects |
//! | `array.rs` | NumPy arrays that own their buffer and that nobody can write |
//! | `contact.rs` | contacts as a structured array |
//! | `event/` | events as Python objects |
//! | `board.rs` | `Board`: the very board, stepped by hand |
//! | `recording.rs` | recordings: contents, events, messages |
//! | `features.rs` | features of a touch, moments of an image |
//! | `map.rs` | fuzzy cognitive maps |
//! | `program.rs` | the command `taxel` (feature `cli`) |
//! | `request.rs` | requests to a board |
//! | `stream.rs` | `Stream`: a board's stream |
#![forbid(unsafe_code)]

mod array;
mod board;
mod contact;
mod error;
mod event;
mod features;
mod map;
#[cfg(feature = "cli")]
mod program;
mod recording;
mod request;
mod stream;
mod value;

use pyo3::prelude::*;

/// The extension module.
#[pymodule]
fn _taxel(module: &Bound<'_, PyModule>) -> PyResult<()> {
    error::add(module)?;
    event::add(module)?;
    module.add("CONTACT", contact::dtype(module.py())?)?;
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    #[cfg(feature = "cli")]
    module.add_function(wrap_pyfunction!(program::run_program, module)?)?;
    module.add_class::<stream::Stream>()?;
    module.add_class::<board::Board>()?;
    module.add_class::<recording::RecordedEvents>()?;
    module.add_class::<recording::RecordedMessages>()?;
    module.add_function(wrap_pyfunction!(recording::overview, module)?)?;
    module.add_function(wrap_pyfunction!(recording::attachment, module)?)?;
    module.add_function(wrap_pyfunction!(features::features, module)?)?;
    module.add_function(wrap_pyfunction!(features::moments, module)?)?;
    module.add_class::<map::Map>()
}
