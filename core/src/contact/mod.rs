//! Contacts: what touches, where, how, since when, and where it is going.
//!
//! | | |
//! |---|---|
//! | input | [`Image`](crate::condition::Image) (counts), time of the frame |
//! | output | [`Touches`]: contacts with integer and fixed-point fields, those just released, exact [`Moments`] |
//! | saturation | none in the moments; each field says its own |
//! | latency | none; slip needs three frames |
//! | RAM | 540 + 4 C bytes for each of C contacts, 20 per run, and 4 KB |
//! | M0+ cycles | reference garment: 1.2 k where nothing touches; about 19 k for each contact of 4 to 9 taxels, 25 k of 29; 350 k if all 2,048 taxels are touched, 1.5 M as a checkerboard of 1,024 runs |
//!
//! A taxel belongs to a component if it reaches the low threshold and touches (corners included) another of it, in its
//! panel or across a seam. A component is a contact if its peak reaches the high threshold, or if it comes within
//! one taxel of where a contact was one frame ago and goes on as that contact; a faint one begins nothing. A contact
//! keeps its id from onset to release.
//!
//! The stage makes four passes: runs of each active row and their union (`run`, `label`); joins across seams
//! (`join`); the choice of contacts; and the measures of the chosen ones only (`component`, `contour`). Then
//! they are matched to those of the last frame (`track`).

mod axis;
mod component;
mod config;
mod contour;
mod join;
mod label;
mod matching;
mod moments;
mod point;
mod record;
mod run;
mod stage;
mod track;

pub use axis::{ASSUMED_PITCH_UM, Axis, axis, breadth};
pub use config::ContactConfig;
pub use moments::{Central, Moments};
pub use record::{Contact, Phase};
pub use stage::{ContactState, Contacts, Touches};
