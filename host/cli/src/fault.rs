//! Assigns blame for an error, which decides the exit status of the program.
//!
//! | status | when | how an error says so |
//! |---|---|---|
//! | 0 | done | |
//! | 1 | failed: a file, the disk, a result that is not good enough | anything else |
//! | 2 | wrong use: another command line is needed | [`Fault::usage`], [`Blame::usage`] |
//! | 3 | the board is at fault: no answer, a refusal, faulty lines or taxels | [`Fault::board`], [`Blame::board`] |
//!
//! An error of the library says so by its kind ([`ErrorKind::Usage`], [`SourceError::blames_board`]), one of
//! the program's own by such a mark. A mark adds no words to the error, and contexts above it keep it. The
//! innermost blame counts. `anyhow!("{error:#}")` loses it; use `context`.
//!
//! ```
//! use anyhow::{Context, Result, ensure};
//! use taxel_cli::fault::{Blame, Fault, status};
//!
//! fn rate(hz: f64) -> Result<()> {
//!     ensure!(hz > 0.0, Fault::usage(format!("--rate {hz}: it must be above 0")));
//!     Ok(())
//! }
//! fn read() -> Result<()> {
//!     std::fs::File::open("/dev/no-such-board").context("no board").board()?;
//!     Ok(())
//! }
//! let error = rate(0.0).context("process").unwrap_err();
//! assert_eq!((status(&error), format!("{error:#}")), (2, "process: --rate 0: it must be above 0".into()));
//! assert_eq!(status(&read().unwrap_err()), 3);
//! ```

use anyhow::Error;
use std::fmt;
use taxel::error::{ErrorKind, SourceError};

/// An error with its blame.
#[derive(Debug)]
pub struct Fault {
    status: u8,
    error: Error,
}

impl Fault {
    /// The command line is wrong: an unknown name, options that exclude each other, a number out of range.
    pub fn usage(message: impl fmt::Display) -> Fault {
        Fault { status: 2, error: Error::msg(message.to_string()) }
    }

    /// The board, or the link to it, is at fault.
    pub fn board(message: impl fmt::Display) -> Fault {
        Fault { status: 3, error: Error::msg(message.to_string()) }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.error.fmt(f)
    }
}

impl std::error::Error for Fault {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        self.error.source()
    }
}

/// Marks the errors of a result.
pub trait Blame<T> {
    /// The command line is wrong.
    fn usage(self) -> anyhow::Result<T>;

    /// The board is at fault.
    fn board(self) -> anyhow::Result<T>;
}

impl<T, E: Into<Error>> Blame<T> for Result<T, E> {
    fn usage(self) -> anyhow::Result<T> {
        self.map_err(|error| marked(2, error.into()))
    }

    fn board(self) -> anyhow::Result<T> {
        self.map_err(|error| marked(3, error.into()))
    }
}

fn marked(status: u8, error: Error) -> Error {
    match mark(&error) {
        Some(_) => error,
        None => Fault { status, error }.into(),
    }
}

fn mark(error: &Error) -> Option<u8> {
    error.chain().find_map(|cause| match cause.downcast_ref::<Fault>() {
        Some(fault) => Some(fault.status),
        None => cause.downcast_ref::<taxel::Error>().and_then(|error| blamed(error.kind())),
    })
}

/// Whom the library blames, or an observer of the program's own.
fn blamed(kind: &ErrorKind) -> Option<u8> {
    match kind {
        ErrorKind::Usage(_) => Some(2),
        ErrorKind::Source(error) if SourceError::blames_board(error) => Some(3),
        ErrorKind::Other(error) => error.downcast_ref::<Fault>().map(|fault| fault.status),
        _ => None,
    }
}

impl From<Fault> for ErrorKind {
    fn from(fault: Fault) -> ErrorKind {
        ErrorKind::Other(Box::new(fault))
    }
}

/// The error of an observer of the program's own, as the library passes it on.
pub fn own(error: Error) -> taxel::Error {
    match error.chain().next().is_some_and(|outermost| outermost.is::<taxel::Error>()) {
        true => error.downcast().unwrap_or_else(taxel::Error::other),
        false => taxel::Error::other(error.reallocate_into_boxed_dyn_error_without_backtrace()),
    }
}

/// Exit status for this error.
pub fn status(error: &Error) -> u8 {
    mark(error).unwrap_or(1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use anyhow::{Context, anyhow};

    #[test]
    fn the_kind_of_a_library_s_error_blames() {
        let of = |source: &str| status(&Error::from(taxel::open(source).err().unwrap()).context("record"));
        assert_eq!((of("sim:no-such"), of("replay:no/such.mcap"), of("serial:/dev/none")), (2, 1, 3));
    }

    #[test]
    fn a_mark_adds_no_words_and_the_first_counts() {
        assert_eq!(status(&anyhow!("the disk is full")), 1);
        let deep: anyhow::Result<()> = Err(std::io::Error::other("cut off").into());
        let error = deep.context("serial:x is gone").board().context("record").usage().unwrap_err();
        assert_eq!((status(&error), format!("{error:#}")), (3, "record: serial:x is gone: cut off".into()));
    }
}
