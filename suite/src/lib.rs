//! What is measured, once for the emulated board (`cargo xtask cycles`) and for this machine (`taxel bench`): the scenes of
//! [`pattern`], the whole [`chain`] from codes to encoded messages.
#![no_std]
#![forbid(unsafe_code)]

pub mod chain;
pub mod pattern;
