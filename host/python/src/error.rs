//! Errors of the library as Python exceptions, one sentence each.

use pyo3::exceptions::PyException;
use pyo3::prelude::*;
use pyo3::{PyErr, create_exception};
use taxel::error::{ErrorKind, UsageError as WrongUse};
use taxel::text::words;

create_exception!(
    taxel,
    Error,
    PyException,
    "Something failed: a file, the disk, a result that is not there."
);
create_exception!(taxel, UsageError, Error, "Wrong use: an unknown name, or a value that is out of range.");
create_exception!(taxel, BoardError, Error, "The board, or the link to it, is at fault.");

/// The exception for an error, by its kind.
pub fn raised(error: impl Into<anyhow::Error>) -> PyErr {
    let error = error.into();
    let sentence = words::sentence(error.as_ref());
    match kind(&error) {
        Some(ErrorKind::Usage(_)) => UsageError::new_err(sentence),
        Some(ErrorKind::Source(error)) if error.blames_board() => BoardError::new_err(sentence),
        _ => Error::new_err(sentence),
    }
}

/// True if the board, or the link to it, is at fault.
pub fn blames_board(error: &anyhow::Error) -> bool {
    matches!(kind(error), Some(ErrorKind::Source(error)) if error.blames_board())
}

fn kind(error: &anyhow::Error) -> Option<&ErrorKind> {
    error.chain().find_map(|cause| cause.downcast_ref::<taxel::Error>()).map(taxel::Error::kind)
}

/// An error of wrong use, for [`raised`].
pub fn argument(sentence: impl Into<String>) -> taxel::Error {
    WrongUse::Argument(sentence.into()).into()
}

/// An error of wrong use.
pub fn usage(sentence: impl Into<String>) -> PyErr {
    UsageError::new_err(sentence.into())
}

/// Adds the classes to the module.
pub fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
    let py = module.py();
    module.add("Error", py.get_type::<Error>())?;
    module.add("UsageError", py.get_type::<UsageError>())?;
    module.add("BoardError", py.get_type::<BoardError>())
}
