//! Segmentation: the connected touched taxels of a frame.
//!
//! Each active row becomes bits ([`threshold`]), whose runs ([`run`]) are summed up ([`sums`]) and joined to
//! the labels above ([`union_find`], [`labeller`], [`scan`]): rows of sixteen columns in [`row16`] and
//! [`groups`], rows of any length in [`rows`]. [`seams`] joins labels across panels along their [`borders`].
//! [`near`] marks faint labels that continue a contact, and [`query`] finds runs by position.

pub(crate) mod bits;
pub(crate) mod borders;
pub(crate) mod config;
pub(crate) mod groups;
pub(crate) mod labeller;
pub(crate) mod near;
pub(crate) mod query;
pub(crate) mod row16;
pub(crate) mod rows;
pub(crate) mod run;
pub(crate) mod scan;
pub(crate) mod seams;
pub(crate) mod strip;
pub(crate) mod sums;
pub(crate) mod threshold;
pub(crate) mod union_find;
