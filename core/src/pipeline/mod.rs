//! The data path, composed: codes of one scan in, everything that was perceived out.

mod compose;
mod error;
mod percept;
mod probe;
mod process;
mod state;

pub use compose::Pipeline;
pub use error::SceneError;
pub use percept::Percept;
pub use probe::{Probe, Stage};
pub use state::{CONTACTS, PipelineState};
