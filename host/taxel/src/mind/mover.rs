//! Cause of a touch: the robot's own motion, or that of what touches it.
//!
//! Before its onset, the touched surface moves along its normal if the robot bumps into something, and does
//! not if it is touched. The velocity follows from the joints that are sent. If both move, the robot's motion
//! shows and the other's does not: such a touch is taken for the robot's own from its speed on.

use super::speeds::{LinkSpeeds, LinksAt};
use crate::body::DVec3;
use serde::{Deserialize, Serialize};

/// Speed along the normal from which on the robot itself has moved into what it touches, m/s.
const OWN_M_S: f64 = 0.02;
/// Speed up to which the surface has not moved, m/s: what servos and encoders leave.
const STILL_M_S: f64 = 0.008;
/// Share of its whole speed that a surface has along its normal if it moves into something, and up to which
/// it moves along what touches it: contacts lie beside the taxels that meet something first, where the normal
/// is another.
const INTO: f64 = 0.3;
const ALONG: f64 = 0.25;
/// Time before the onset within which the greatest speed counts, us: a bump stops the link, and a board reports
/// a contact some frames later.
const BEFORE_US: u64 = 80_000;
/// Time over which a speed is taken, us.
const OVER_US: u64 = 20_000;
/// Distance within which two of the robot's own contacts touch each other, m.
const NEAR_M: f64 = 0.06;
/// Distance within which a contact belongs to a bump that has just begun, m: it has stopped the link.
const BESIDE_M: f64 = 0.12;
/// Distance beyond which neither is true, m.
pub(super) const REACH_M: f64 = BESIDE_M;
/// Cosine of the angle of their normals up to which they face each other.
const FACING: f64 = -0.5;

/// Motion that has caused a touch.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Mover {
    /// Motion of the robot.
    Own,
    /// Motion of what touches it.
    Other,
    /// Motion that was too slow to be sure, or nothing is known of it or of the surface.
    Unsure,
}

/// Motion of the robot's surface shortly before a contact.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Approach {
    /// Speed along the normal, m/s; positive outwards.
    pub normal_m_s: f64,
    /// Whole speed, m/s.
    pub speed_m_s: f64,
}

impl Approach {
    /// Returns whose motion it was.
    pub fn mover(self) -> Mover {
        let Approach { normal_m_s, speed_m_s } = self;
        if normal_m_s >= OWN_M_S && normal_m_s >= INTO * speed_m_s {
            Mover::Own
        } else if normal_m_s <= STILL_M_S || normal_m_s <= ALONG * speed_m_s {
            Mover::Other
        } else {
            Mover::Unsure
        }
    }
}

/// Place and normal of a spot in the base.
pub type BasePlace = (DVec3, DVec3);

/// A point of the robot's surface.
#[derive(Debug, Clone, PartialEq)]
pub struct SurfaceSpot {
    /// Name of its link.
    pub link: String,
    /// Place in the link's frame, m.
    pub at: DVec3,
    /// Direction away from the robot there, of length 1.
    pub normal: DVec3,
}

impl SurfaceSpot {
    /// The motion with the greatest speed along the normal shortly before an onset at a time of the host, us.
    /// None if nothing is known of the robot's motion then.
    pub fn approach(&self, speeds: &LinkSpeeds, onset_us: u64) -> Option<Approach> {
        let times = (0..=BEFORE_US / OVER_US).map(|step| onset_us.saturating_sub(step * OVER_US));
        let places: Vec<_> = times.map(|us| self.in_base(&speeds.at(us)?)).collect();
        let motion = |pair: &[Option<BasePlace>]| {
            let ((after, normal), (before, _)) = (pair[0]?, pair[1]?);
            let velocity = (after - before) / (OVER_US as f64 * 1e-6);
            Some(Approach { normal_m_s: velocity.dot(normal), speed_m_s: velocity.length() })
        };
        places.windows(2).filter_map(motion).max_by(|a, b| a.normal_m_s.total_cmp(&b.normal_m_s))
    }

    /// Returns its place and its normal in the base; none if its link is unknown.
    pub fn in_base(&self, links: &LinksAt<'_>) -> Option<BasePlace> {
        links.point(&self.link, self.at, self.normal)
    }

    /// True if they are beside each other on one side of a link: of one bump, if they begin together.
    pub fn is_beside(&self, other: &SurfaceSpot) -> bool {
        let is_near = self.link == other.link && self.at.distance(other.at) <= BESIDE_M;
        is_near && self.normal.dot(other.normal) > 0.0
    }

    /// True if the robot's own surface touches itself at these two spots, where the links are now.
    pub fn meets(&self, other: &SurfaceSpot, links: &LinksAt<'_>) -> bool {
        if self.link == other.link {
            return false;
        }
        let both = self.in_base(links).zip(other.in_base(links));
        both.is_some_and(|((a, normal), (b, facing))| a.distance(b) <= NEAR_M && normal.dot(facing) <= FACING)
    }
}
