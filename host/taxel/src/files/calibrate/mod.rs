//! Calibration: from counts to newtons, by known weights on a plate.
//!
//! The board gets a gain for each taxel, which makes the taxels of a panel alike ([`fit()`]). The panel's
//! [`Curve`], from counts to newtons on a taxel, stays on the host in a [`Calibration`] file, with author,
//! date, method and quality of the fit. The board sends the file's id in each `Hello`, so that a stream names
//! its calibration. The weight of a plate is spread evenly over the taxels that it covers. Loading and
//! unloading are measured alike, and their mean is used.

mod basis;
mod curve;
mod drift;
mod file;
mod fit;
mod force;
mod force_scale;
mod install;
mod newtons;
mod plates;
mod reading;
mod residuals;

pub use basis::ForceBasis;
pub use curve::{Curve, Knot, PARTS};
pub use drift::{Reason, Seen, judge};
pub use file::{Calibration, PanelCurve};
pub use fit::{Fitted, fit};
pub use force::Forces;
pub use force_scale::ForceScale;
pub use newtons::Newtons;
pub use plates::{Over, Plate, plates};
pub use reading::{Reading, Rest, mean};
pub use residuals::{OfWeight, Residuals};
