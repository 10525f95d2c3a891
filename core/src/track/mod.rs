//! Contacts from frame to frame.
//!
//! [`assign`] pairs this frame's components with the last frame's contacts by the distances of [`point`];
//! [`reunite`] keeps what has hardly parted together; [`tracks`] updates, merges, splits and releases.
//! [`motion`] follows the centroid, [`slip`] reports when it slips. [`slot`] is an entry of the table of
//! contacts.

pub(crate) mod assign;
pub(crate) mod motion;
pub(crate) mod point;
pub(crate) mod reunite;
pub(crate) mod slip;
pub(crate) mod slot;
pub(crate) mod tracks;
