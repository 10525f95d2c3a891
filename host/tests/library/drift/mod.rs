//! Drift is followed and a touch is kept: the limits of docs/bounds.md, on garments of all kinds and at all rates.

mod chart;
mod limits;
mod rig;
mod told;
