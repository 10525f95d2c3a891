//! Measures of a frame's contacts.
//!
//! [`component`] picks the connected touches that are contacts and sums their exact [`moments`], those beyond
//! a seam by [`carried`]. [`form`] measures what is costly and changes slowly, in a [`frame_view`]: the
//! [`contour`], whose slope is a [`sobel`], the [`axis`] and the [`quartic`]; [`forms`] sets how many contacts
//! have their turn in a frame. [`contact`] is the record of a contact, [`hardness`] estimates that of the
//! object from its growth.

pub(crate) mod axis;
pub(crate) mod carried;
pub(crate) mod component;
pub(crate) mod contact;
pub(crate) mod contour;
pub(crate) mod form;
pub(crate) mod forms;
pub(crate) mod frame_view;
pub mod hardness;
pub(crate) mod moments;
pub(crate) mod quartic;
mod ratios;
pub(crate) mod sobel;
