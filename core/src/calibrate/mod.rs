//! From codes to pressure.
//!
//! [`calibration`] holds baseline, gain and limit of each taxel; the [`terms`] say how far a limit is from
//! its baseline. [`dispatch`] calibrates the taxels of a [`panel`] beyond their limits, in [`chunks`] on any
//! machine and in whole rows by SIMD, and [`marks`] where they are. [`levels`] sets the limits of taxels on
//! which folds press. [`scale`] is the formula. [`sampled`] is the input of a frame, [`certificate`] names the
//! source of the gains.

#[cfg(target_pointer_width = "64")]
pub(crate) mod calibrate_simd;
pub(crate) mod calibration;
pub(crate) mod certificate;
pub(crate) mod chunks;
pub(crate) mod dispatch;
mod levels;
pub(crate) mod marks;
pub(crate) mod panel;
pub(crate) mod sampled;
pub(crate) mod scale;
pub(crate) mod terms;
