//! Contacts: segmentation, moments, form, and tracking from frame to frame.
//!
//! | | |
//! |---|---|
//! | input | [`Image`](crate::condition::Image) (counts), time of the frame |
//! | output | [`Touches`]: contacts in integers and fixed point, those just released, exact [`Moments`] |
//! | saturation | none in the moments; each field says its own |
//! | latency | none; a slip is reported in the third frame of a motion |
//! | RAM | [`ContactState`]: 58,040 bytes |
//! | M0+ cycles | 2 k where nothing touches, 21 k with a contact of 29 taxels, 61 k with five |
//!
//! The RAM is that of the [capacities](crate::capacity) that ship, with what later stages keep in the table of
//! contacts. The cycles are of the reference garment, where forty contacts of 4 to 9 taxels take 226 k, all
//! 2,048 taxels 149 k, and a checkerboard of 1,024 runs 220 k.
//!
//! A taxel belongs to a component if it reaches the low threshold and touches (corners included) another
//! taxel of the component, in its panel or across a seam. A component is a contact if its peak reaches the
//! high threshold, which is a pressure ([`ContactConfig::high`]). A fainter component is one only if it has at
//! least half of that pressure, comes within one taxel of a contact of the previous frame and continues it: it
//! never begins a contact. A contact keeps its id from onset to release.
//!
//! Contacts and components are paired by distance, the nearest first, from where each contact should be by
//! its velocity. When two contacts merge, the one with the greater total goes on and the other is released;
//! if the totals are equal, the nearer one goes on. When a contact splits, the part nearest to its expected
//! position goes on, which is the greater part, and the other begins a new contact. As long as at most a row
//! and a column of taxels lie between two parts, they stay one contact. A contact that has lost its component
//! takes the component that covers its peak, if no other contact has it. When contacts merge or split, or a
//! quarter of the total comes or goes at once, the centroid jumps, and the jump counts neither as
//! displacement nor as velocity.
//!
//! Motion is that of the centroid. A slip begins when three steps in a row go the same way, and together are
//! at least as fast as the slip speed and three times the contact's own jitter (`track::slip`). It lasts as
//! long as the velocity is above the slip speed. A scene without slip sets `slip_speed` to [`NO_SLIP`].
//!
//! The stage makes four passes: each active row as bits (`segment::threshold`), its runs summed up and joined
//! to the labels above (`segment::scan`); joins across seams (`segment::seams`); the choice of contacts
//! (`segment::near`, `measure::component`); and the moments of the chosen ones only. [`Contacts::segment`]
//! ends here. Then the components are matched to the contacts of the last frame (`track::assign`,
//! `track::tracks`), and the form of one contact is measured (`measure::form`, `measure::quartic`): it costs
//! as much as the rest of a contact together, and changes slowly.

mod stage;

pub(crate) use crate::measure::axis::tenths;
pub use crate::measure::axis::{Axis, axis, breadth};
pub use crate::measure::component::Component;
pub use crate::measure::contact::{Contact, Phase};
pub use crate::measure::forms::Forms;
pub use crate::measure::hardness::{self, Hardness, HardnessCue};
pub use crate::measure::moments::{Central, Moments};
pub use crate::measure::quartic::Quartic;
pub use crate::segment::config::{ContactConfig, NO_SLIP};
pub use crate::track::slot::Slot;
pub(crate) use stage::PressedRuns;
pub use stage::{ContactState, Contacts, Touches};
