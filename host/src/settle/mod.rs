//! `taxel settle`: the shortest settling of a real garment whose codes agree with a slow scan.
//!
//! What a line keeps of the taxel before is found from the picture itself: with something on the garment,
//! neighbours in the order of the scan differ, and a scan that does not wait long enough shows a part of each
//! such step. That part is measured by least squares over all steps of a converter input, against slow scans
//! before and after, and does not depend on how high the steps are: so a light press tells what a full-scale
//! step would leave. The time is found by bisection over what the board really does, in whole slots or not.

mod command;
mod residue;
mod search;

pub use command::{SettleArgs, run};
pub use residue::{Residue, Steps, steps};
pub use search::{Scanner, Settled, settle};
