//! Segmentation: the connected touched taxels of a frame.
//!
//! [`scan`] turns each active row into bits ([`threshold`]), and those into runs ([`run`]), which are summed
//! up ([`sums`]) and joined to the labels above ([`union_find`]); [`labeller`] holds both. [`seams`] joins
//! labels across panels along their [`borders`]. [`strip`] groups the runs of a label.

pub(crate) mod borders;
pub(crate) mod config;
pub(crate) mod labeller;
pub(crate) mod run;
pub(crate) mod scan;
pub(crate) mod seams;
pub(crate) mod strip;
pub(crate) mod sums;
pub(crate) mod threshold;
pub(crate) mod union_find;
