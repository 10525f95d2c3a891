//! The surface in force, and the poses of its links as the host gives them.

use super::refusal::Refusal;
use super::{Board, reading};
use crate::format::Micros;
use crate::surface::{LINKS, LinkName, MovingPose, Pose, Table};
use heapless::Vec;

/// Refusal without a table.
const NO_SURFACE: &str = "no surface is in force";

impl<const TAXELS: usize, const RUNS: usize, const PARTS: usize> Board<TAXELS, RUNS, PARTS> {
    /// The surface in force.
    pub fn surface(&self) -> Option<Table<'static>> {
        self.surface.table()
    }

    /// Takes poses of links.
    #[inline(never)]
    pub(super) fn take_poses(&mut self, bytes: &[u8], now: Micros) -> Result<(), Refusal> {
        let table = self.surface.table().ok_or_else(|| Refusal::of(NO_SURFACE))?;
        let mut poses = Vec::<(LinkName, Pose), LINKS>::new();
        reading::list("poses", bytes, &mut poses)?;
        self.surface.poses.accept(&poses, &table, now).map_err(Refusal::of)
    }

    /// Takes poses of links that move.
    #[inline(never)]
    pub(super) fn take_moving(&mut self, bytes: &[u8]) -> Result<(), Refusal> {
        let table = self.surface.table().ok_or_else(|| Refusal::of(NO_SURFACE))?;
        let (at, poses) = reading::value::<(Micros, Vec<MovingPose, LINKS>)>("poses", bytes)?;
        self.surface.poses.accept_moving(&poses, &table, at).map_err(Refusal::of)
    }

    /// Sets the rate of reports of what presses on the robot.
    #[inline(never)]
    pub(super) fn tell_pressing(&mut self, hz: u16) -> Result<(), Refusal> {
        if hz > 0 && self.surface.table().is_none() {
            return Err(Refusal::of(NO_SURFACE));
        }
        self.surface.tell(hz);
        Ok(())
    }
}
