//! `taxel._taxel`: what the Python package `taxel` takes from Rust.
//!
//! In the order in which they build on each other; a module imports only modules before it:
//!
//! | module | holds |
//! |---|---|
//! | `logger` | warnings of the library, for Python's `logging` |
//! | `error` | errors as exceptions |
//! | `value` | JSON values as Python objects |
//! | `array` | NumPy arrays that own their buffer and that nobody can write |
//! | `contact` | contacts as a structured array |
//! | `event` | events as Python objects |
//! | `request` | requests to a board |
//! | `keywords` | keywords as a board's configuration |
//! | `garment` | `Garment`: panels of taxels |
//! | `board` | `Board`: a board's stream |
//! | `moments` | `Moment`: what the boards of a robot have said lately, by the time that they share |
//! | `robot` | `Robot`: all boards of a robot as one stream |
//! | `virtual_board` | `VirtualBoard`: a board's own code, stepped by hand |
//! | `virtual_robot` | `VirtualRobot`: the very boards of a robot and its mind, stepped by hand |
//! | `motion` | `Motion`: from touch to motion |
//! | `recording` | recordings: contents, events, messages |
//! | `features` | features of a touch, moments of an image |
//! | `touch_model` | `TouchModel`: models of touches, made, judged and saved |
//! | `folds` | what the garment's folds press |
//! | `map` | fuzzy cognitive maps |
//! | `program` | the command `taxel` (feature `cli`) |
#![forbid(unsafe_code)]

mod logger;

mod error;

mod value;

mod array;

mod contact;

mod event;

mod request;

mod keywords;

mod garment;

mod board;

mod moments;

mod robot;

mod virtual_board;

mod virtual_robot;

mod motion;

mod recording;

mod features;

mod touch_model;

mod folds;

mod map;

#[cfg(feature = "cli")]
mod program;

use pyo3::prelude::*;

/// The extension module.
#[pymodule]
fn _taxel(module: &Bound<'_, PyModule>) -> PyResult<()> {
    logger::begin();
    error::add(module)?;
    event::add(module)?;
    module.add("CONTACT", contact::dtype(module.py())?)?;
    module.add("MOMENT", contact::moment_dtype(module.py())?)?;
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    #[cfg(feature = "cli")]
    module.add_function(wrap_pyfunction!(program::run_program, module)?)?;
    module.add_class::<garment::Garment>()?;
    module.add_class::<board::Board>()?;
    module.add_class::<moments::Moment>()?;
    module.add_class::<robot::Robot>()?;
    module.add_class::<virtual_board::VirtualBoard>()?;
    module.add_class::<virtual_robot::VirtualRobot>()?;
    module.add_class::<motion::Motion>()?;
    module.add_class::<motion::MotionTouch>()?;
    module.add_class::<motion::MotionCommand>()?;
    module.add_class::<touch_model::TouchModel>()?;
    module.add_class::<touch_model::TouchDecision>()?;
    module.add_class::<recording::RecordedEvents>()?;
    module.add_class::<recording::RecordedMessages>()?;
    module.add_function(wrap_pyfunction!(recording::overview, module)?)?;
    module.add_function(wrap_pyfunction!(recording::attachment, module)?)?;
    module.add_function(wrap_pyfunction!(recording::images, module)?)?;
    module.add_function(wrap_pyfunction!(features::features, module)?)?;
    module.add_function(wrap_pyfunction!(features::moments, module)?)?;
    module.add_function(wrap_pyfunction!(folds::learn_folds, module)?)?;
    module.add_class::<map::Map>()
}
