//! Poses of the links in the frame in which contacts are reported, as the host says.

use super::motion::{LinkMotion, between};
use super::pose::{Pose, Rigid};
use super::table::Table;
use super::{LINKS, LinkName};
use crate::format::{Invalid, Micros};

/// Poses of the links, by the table's order, and the time at which they are or were received.
#[derive(Debug, Default, Clone, PartialEq, Eq)]
pub struct SurfaceState {
    poses: [Option<(Pose, Option<LinkMotion>)>; LINKS],
    updated: Option<Micros>,
}

/// A link of the table by its name, its pose and, if it is known, its motion.
pub type LinkPose = (LinkName, Pose, Option<LinkMotion>);

/// The links in the frame of the poses at a time.
#[derive(Debug, Clone, Copy)]
pub struct LinkFrames {
    /// By link, with the most by which places on it are off, um, if its pose says it.
    frames: [Option<(Rigid, Option<u32>)>; LINKS],
}

impl SurfaceState {
    /// No pose.
    pub const fn new() -> SurfaceState {
        SurfaceState { poses: [None; LINKS], updated: None }
    }

    /// Takes poses of links at the time `at`: they stand still from then on, or move as they say. A refused
    /// list changes nothing.
    pub fn accept(&mut self, poses: &[LinkPose], table: &Table<'_>, at: Micros) -> Result<(), Invalid> {
        let mut taken = self.poses;
        for (called, pose, motion) in poses {
            pose.check()?;
            if let Some(motion) = motion {
                motion.check()?;
            }
            let to = table.find_link(called).and_then(|link| taken.get_mut(link));
            let must = "must be a link of the surface";
            *to.ok_or(Invalid { parameter: "pose.link", must })? = Some((*pose, *motion));
        }
        *self = SurfaceState { poses: taken, updated: Some(at) };
        Ok(())
    }

    /// Time of the last poses.
    pub fn updated(&self) -> Option<Micros> {
        self.updated
    }

    /// Returns the frames of the links at a time: carried on by their motion, if it is known.
    #[inline(never)] // M0+: out of line
    pub fn at(&self, time: Micros) -> LinkFrames {
        let us = self.updated.and_then(|updated| between(updated, time));
        let mut frames = [None; LINKS];
        for (frame, pose) in frames.iter_mut().zip(&self.poses) {
            *frame = match pose {
                Some((pose, Some(motion))) => {
                    us.and_then(|us| motion.carry(pose, us)).map(|(frame, off)| (frame, Some(off)))
                }
                Some((pose, None)) => Some((pose.matrix(), None)),
                None => None,
            };
        }
        LinkFrames { frames }
    }
}

impl LinkFrames {
    /// No pose.
    pub const NONE: LinkFrames = LinkFrames { frames: [None; LINKS] };

    /// The frame of a link.
    pub(super) fn of(&self, link: u8) -> Option<&Rigid> {
        Some(&self.frames.get(usize::from(link))?.as_ref()?.0)
    }

    /// A vector of a link in the frame of the poses, or as it is without one.
    pub(super) fn turned(&self, link: u8, vector: [i32; 3]) -> [i32; 3] {
        self.of(link).map_or(vector, |frame| frame.turned(vector))
    }

    /// The most by which places on a link are off in the frame of the poses, um, by its index: of those whose
    /// poses say it.
    pub fn errors(&self) -> impl Iterator<Item = (u8, u32)> + Clone + '_ {
        let of = |(link, frame): (u8, &Option<(Rigid, Option<u32>)>)| Some((link, frame.as_ref()?.1?));
        (0..).zip(&self.frames).filter_map(of)
    }
}
