//! The error: its kind, and the sentences around it.

use super::kind::ErrorKind;
use std::error::Error as StdError;
use std::fmt;
use std::io;

/// Result of functions of this library.
pub type Result<T, E = Error> = std::result::Result<T, E>;

/// An error of this library, see the [module](super).
pub struct Error(Box<Node>);

/// A chain from the outermost sentence to the kind, and on to what has led to it.
enum Node {
    Kind(ErrorKind, Option<Error>),
    Context { text: String, cause: Error },
}

impl Error {
    /// Returns what has happened, below all contexts.
    pub fn kind(&self) -> &ErrorKind {
        match &*self.0 {
            Node::Kind(kind, _) => kind,
            Node::Context { cause, .. } => cause.kind(),
        }
    }

    /// The error that has led to this one: why a board is gone, what is damaged in a recording.
    pub fn cause(&self) -> Option<&Error> {
        match &*self.0 {
            Node::Kind(_, cause) => cause.as_ref(),
            Node::Context { cause, .. } => cause.cause(),
        }
    }

    /// The kind, without its contexts.
    pub fn into_kind(self) -> ErrorKind {
        match *self.0 {
            Node::Kind(kind, _) => kind,
            Node::Context { cause, .. } => cause.into_kind(),
        }
    }

    /// An error of the caller's own: from a callback, or from a link or a source that the caller implements.
    pub fn other(error: impl Into<Box<dyn StdError + Send + Sync>>) -> Error {
        ErrorKind::Other(error.into()).into()
    }

    /// Adds a sentence about what was being done.
    pub fn context(self, text: impl fmt::Display) -> Error {
        Error(Box::new(Node::Context { text: text.to_string(), cause: self }))
    }

    /// An error of this kind that another has led to.
    pub fn caused(kind: impl Into<ErrorKind>, cause: Error) -> Error {
        Error(Box::new(Node::Kind(kind.into(), Some(cause))))
    }

    /// The system's error, if it is the kind of this one.
    pub fn io(&self) -> Option<&io::Error> {
        self.kind().io()
    }

    /// The error of another library or of the caller, if this one is nothing else: without a context.
    pub fn bare(&self) -> Option<&(dyn StdError + 'static)> {
        match &*self.0 {
            Node::Kind(ErrorKind::Other(error), None) => Some(&**error),
            _ => None,
        }
    }
}

impl<K: Into<ErrorKind>> From<K> for Error {
    fn from(kind: K) -> Error {
        Error(Box::new(Node::Kind(kind.into(), None)))
    }
}

/// The outermost sentence; with `#` all of them, joined by `: `.
impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &*self.0 {
            Node::Kind(kind, _) => write!(f, "{kind}")?,
            Node::Context { text, .. } => f.write_str(text)?,
        }
        let mut cause = self.source().filter(|_| f.alternate());
        while let Some(error) = cause {
            write!(f, ": {error}")?;
            cause = error.source();
        }
        Ok(())
    }
}

/// The sentences as with `{:#}`, and the kind: what `unwrap` and a test print.
impl fmt::Debug for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{self:#} ({:?})", self.kind())
    }
}

impl StdError for Error {
    fn source(&self) -> Option<&(dyn StdError + 'static)> {
        match &*self.0 {
            Node::Kind(_, Some(cause)) | Node::Context { cause, .. } => Some(cause),
            Node::Kind(kind, None) => kind.source(),
        }
    }
}
