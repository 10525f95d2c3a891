//! The composed data path: from the codes of one scan to everything that is perceived.

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
