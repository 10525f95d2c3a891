//! `taxel-core`: everything between the converter's codes and the meaning of a touch.
#![no_std]
#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod acquire;
pub mod condition;
pub mod contact;
pub mod format;
pub mod garment;
pub mod intent;
pub mod shape;
