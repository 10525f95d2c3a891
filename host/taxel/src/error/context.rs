//! Contexts of results.

use super::chain::{Error, Result};
use std::fmt::Display;

/// Adds what was being done to the error of a result.
pub trait Context<T> {
    /// A sentence that is known.
    fn context(self, text: impl Display) -> Result<T>;

    /// A sentence that is made only for an error.
    fn with_context<D: Display>(self, text: impl FnOnce() -> D) -> Result<T>;
}

impl<T, E: Into<Error>> Context<T> for Result<T, E> {
    fn context(self, text: impl Display) -> Result<T> {
        self.with_context(|| text)
    }

    fn with_context<D: Display>(self, text: impl FnOnce() -> D) -> Result<T> {
        self.map_err(|error| error.into().context(text()))
    }
}
