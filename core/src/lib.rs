//! `taxel-core`: everything between the converter's codes and the meaning of a touch.
#![no_std]
#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod acquire;
pub mod format;
pub mod garment;
