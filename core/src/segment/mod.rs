//! Segmentation: the connected touched taxels of a frame.
//!
//! Each active row becomes bits ([`threshold`]), whose runs ([`run`]) are summed up ([`sums`]) and joined to
//! the parts above ([`union_find`], [`labels`], [`scan`]): rows of sixteen columns in [`row16`], rows of any
//! length in [`rows`]. [`seams`] joins parts across panels along their [`borders`]. [`near`] marks faint parts
//! that continue a contact, and [`query`] finds pieces by position.

pub(crate) mod bits;
pub(crate) mod borders;
pub(crate) mod config;
pub(crate) mod labels;
pub(crate) mod near;
pub(crate) mod query;
pub(crate) mod row16;
pub(crate) mod rows;
pub(crate) mod run;
pub(crate) mod runs;
pub(crate) mod scan;
pub(crate) mod seams;
pub(crate) mod strip;
pub(crate) mod sums;
pub(crate) mod threshold;
pub(crate) mod union_find;
