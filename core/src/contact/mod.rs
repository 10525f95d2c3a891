//! Contacts: what touches, where, how, since when, and where it is going.
//!
//! | | |
//! |---|---|
//! | input | [`Image`](crate::condition::Image) (counts), time of the frame |
//! | output | [`Touches`]: contacts with integer and fixed-point fields, those just released, exact [`Moments`] |
//! | saturation | none in the moments; each field says its own |
//! | latency | none; slip is told with the third frame of a motion |
//! | RAM | 800 bytes per contact, 36 per run, 20 per part, and 3.6 KB |
//! | M0+ cycles | reference garment: 2 k where nothing touches; 18 k with one contact of 29 taxels, 59 k with five, 233 k with forty of 4 to 9; 179 k if all 2,048 taxels are touched, 223 k as a checkerboard of 1,024 runs |
//!
//! A taxel belongs to a component if it reaches the low threshold and touches (corners included) another of
//! it, in its panel or across a seam. A component is a contact if its peak reaches the high threshold, or if
//! it comes within one taxel of where a contact was one frame ago and goes on as that contact; a faint one
//! begins nothing. A contact keeps its id from onset to release.
//!
//! Contacts and components are paired by distance, the nearest first, from where each contact should be by
//! its velocity. Of two contacts that become one, that with the greater total goes on and the other is
//! released; of equals the one that is nearer. Of one that comes apart, the part nearest to where it should
//! be goes on, which is the greater one, and the other begins anew; but as long as at most a row and a column
//! of taxels lie between two parts, they stay one. One that has lost its component goes on as the one that
//! covers its peak, if that is nobody else's. When contacts merge or part, or a quarter of the total comes or
//! goes at once, the centroid leaps, and that counts neither as way nor as velocity.
//!
//! Motion is that of the centroid, or that of the pattern of pressure inside a contact where there is one
//! (`pattern`): a flat thing that slides under a constant outline moves and slips. It takes 36 taxels that
//! are two taxels clear of the outline (a contact of 10 x 10), structures of at least five taxels, and a step
//! of less than half of one (in an outline just as large, less than one taxel). A slip begins when three
//! steps in a row go the same way, together at the slip speed at least and three times the contact's own
//! jitter (`slip`), and lasts as long as the velocity is above the slip speed. A scene that does not ask for
//! slip sets `slip_speed` to [`NO_SLIP`] and does not pay for it: up to 16 k M0+ cycles for each contact with
//! a pattern, 400 for any other.
//!
//! The stage makes four passes: each active row as bits (`touched`), its runs summed up and joined to the
//! parts above (`piece`, `sums`, `part`, `label`; `sixteens` and `runs` in rows of one word, `words` in
//! others); joins across seams (`side`, `join`); the choice of contacts (`near`); and the moments of the
//! chosen ones only (`strip`, `component`). So far goes [`Contacts::segment`]; then they are matched to those
//! of the last frame (`track`), and one of them is looked at closely (`form`, `contour`, `axis`): what a
//! contact's form is costs as much as all the rest of it, and changes slowly.

mod axis;
mod bits;
mod component;
mod config;
mod contour;
mod flow;
mod form;
mod forms;
pub mod hardness;
mod join;
mod label;
mod matching;
mod moments;
mod near;
mod part;
mod pattern;
mod piece;
mod place;
mod point;
mod record;
mod reunite;
mod runs;
mod side;
mod sixteens;
mod slip;
mod slopes;
mod stage;
mod strip;
mod sums;
mod touched;
mod track;
mod trail;
mod words;

pub(crate) use axis::tenths;
pub use axis::{Axis, axis, breadth};
pub use component::Component;
pub use config::{ContactConfig, NO_SLIP};
pub use forms::Forms;
pub use hardness::{Growth, Hardness};
pub use moments::{Central, Moments};
pub use record::{Contact, Phase};
pub use stage::{ContactState, Contacts, Touches};
