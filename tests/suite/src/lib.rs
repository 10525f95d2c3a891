//! Benchmarks, shared by the emulated board (`cargo xtask cycles`) and this machine (`cargo xtask bench`):
//! the scenes of [`pattern`], the whole [`chain`] from codes to encoded messages, and [`kernel`]s: reading
//! alone, the [`dense`] chain, number formats to [`measure`] the contacts of [`windows`] or for the
//! [`activation`] of concepts, and [`copies`]. [`surface`] and [`folds`] are tables for the
//! reference garment.
#![no_std]
#![forbid(unsafe_code)]

pub mod activation;
pub mod chain;
pub mod copies;
pub mod dense;
pub mod folds;
pub mod kernel;
pub mod measure;
pub mod pattern;
pub mod surface;
pub mod windows;
