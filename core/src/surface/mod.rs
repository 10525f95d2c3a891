//! Place of the garment on the robot: place and normal of each taxel on a link, and what follows from them:
//! place and force of a contact, and the force and moment on each link.
//!
//! | | |
//! |---|---|
//! | input | a [`Table`] of taxels, which stays where it is (in flash), the image and its contacts |
//! | output | a [`SurfacePoint`] and a force for each contact, a [`Wrench`] for each link |
//! | latency | none |
//! | RAM | [`SurfaceState`] |
//!
//! A host makes the table from a body file (`taxel body table`). Places are in metres in the frame of the
//! link, right-handed. Taxels feel only what presses along their normals: friction is not part of any force.
//! Forces are in counts, as pressure is; a calibration makes newtons of both.

mod frames;
mod motion;
mod place;
mod pose;
mod press;
mod regions;
mod stage;
mod table;
mod taxel;
mod uncertainty;

pub use frames::{LinkFrames, LinkPose, SurfaceState};
pub use motion::{CARRIED_US, LinkMotion};
pub use place::SurfacePoint;
pub use pose::{Pose, Quaternion};
pub use regions::{BodyDirection, ONSET_MS, RELEASED_MS, RegionPhase, RegionStates, RegionSymbol};
pub use stage::{InBase, Landed, Pressing, TaxelLimits, Wrench};
pub use table::{Table, table_bytes, write_table};
pub use taxel::{NO_REGION, TaxelRecord};
pub use uncertainty::Uncertainty;

use crate::garment::PANELS;

/// Most links that a garment lies on: each panel lies on one. None without the feature `surface`.
pub const LINKS: usize = if cfg!(feature = "surface") { PANELS } else { 0 };

/// Most regions of a body. None without the feature `surface`.
pub const REGIONS: usize = if cfg!(feature = "surface") { 24 } else { 0 };

/// Most bytes of the name of a link or of a region: the longest in robots' descriptions have about 30.
pub const LINK_NAME: usize = 40;

/// Name of a link or of a region, UTF-8.
pub type LinkName = heapless::String<LINK_NAME>;

/// Micrometres, in a frame of the robot.
pub type Micrometres = [i32; 3];

/// A direction: its components in units of 2^-14.
pub type UnitVector = [i16; 3];

/// 1.0 of a [`UnitVector`], and one metre of a [`TaxelRecord`].
pub const ONE: i16 = 1 << 14;
