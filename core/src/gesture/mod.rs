//! Touch over time: recognition of touches by a model that was trained on recordings.
//!
//! Each frame of a sheet of any size becomes eight by eight cells, and the cells become eight signals. While
//! the touch goes on, sums of each signal and of the cells are kept, from which 127 features follow: levels,
//! rise and fall, change over six lags, the share of the cells in it, correlation of neighbours' changes, and
//! the octaves of the touch's rhythm. A linear expert for touches of that age scores the classes, and its
//! table gives the confidence for the lead of the best class.
//!
//! | | |
//! |---|---|
//! | input | images of rows of pressures, `u16` |
//! | output | [`Decision`]: class, scores in Q18, confidence in Q15 |
//! | saturation | a cell at 65,535, logarithms at 4095 / 256 in histograms; see [`Sheet`] |
//! | latency | none: a decision is available after every frame; the sums start again after [`LONGEST`] frames |
//! | RAM | [`TouchState`]: 3,712 bytes |
//! | flash | the model, at most [`LARGEST`]; that of seven gestures takes 8.6 KB |
//!
//! On a garment, [`Gestures`] maps the touched panel to the model's sheet, cell by cell as in [`Sheet`], takes
//! frames at the model's rate, and announces a decision once it has lasted.

mod announce;
mod bands;
mod cells;
mod certainty;
mod config;
mod course;
mod expert;
mod gestures;
mod grid;
mod histogram;
mod history;
mod model;
mod model_error;
mod motion;
mod signal;
mod stage;
mod state;

pub use announce::{Announced, Demand};
pub use bands::BANDS;
pub use cells::{CELLS, Cells, SIDE, Sheet};
pub use certainty::Certainty;
pub use config::{GestureConfig, GestureError, ShippedModel};
pub use course::{COURSE, LAGS};
pub use expert::{Expert, LEADS, LIMIT, Scores};
pub use gestures::{Gesture, GestureState, Gestures};
pub use grid::GRID;
pub use model::{MAGIC, Model};
pub use model_error::{CLASSES, EXPERTS, LARGEST, ModelError};
pub use motion::MOTION;
pub use signal::{NAMES, SIGNALS, Signals};
pub use stage::{Decision, TouchClassifier};
pub use state::{FEATURES, Features, LONGEST, TouchState};
