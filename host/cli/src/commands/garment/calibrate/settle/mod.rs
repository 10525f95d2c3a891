//! `taxel calibrate settle`: finds the shortest settling time of a real garment at which its codes agree with a
//! slow scan.
//!
//! The residue of the previous taxel on a line is measured from an image. With an object on the garment,
//! taxels that are neighbours in scan order differ, and a scan that does not wait long enough shows a share
//! of each such step. This share is fitted by least squares over all steps of a converter input, against slow
//! scans before and after. It does not depend on the height of the steps, so a light press gives the residue
//! of a full-scale step. The time is found by bisection over the board's actual settling times, in whole
//! slots or not.

mod command;
mod residue;
mod search;

pub use command::{SettleArgs, run};
pub use residue::{Residue, Steps, steps};
pub use search::{Scanner, Settled, settle};
